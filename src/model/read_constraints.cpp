// All kinds of constraints: their keys, and the rows that they consist of.
#include <cmath>

#include "eigentrail/core/text.hpp"
#include "model/readers.hpp"

namespace eigentrail {
namespace {

using Rows = std::vector<ConstraintRow>;

/// A direction that is fixed on both sides of a joint and the same at the starting guess.
struct SharedDirection {
  ExpressionVector from, to;  ///< components in the axes of either side
};

/// An axis and two directions normal to it, right-handed, on both sides of a joint.
struct JointAxes {
  SharedDirection axis, first, second;
};

/// Reads the places that a joint connects and its axes, and collects its rows.
class JointReader {
 public:
  /// `needs_axes`: whether both sides must have an orientation.
  JointReader(Draft& draft, TableReader& table, bool needs_axes) : draft_(draft), table_(table) {
    from = draft.read_place(table, "from", &from_carrier);
    to = draft.read_place(table, "to", &to_carrier);
    if (needs_axes) {
      check_has_axes("from", from_carrier, "this joint");
      check_has_axes("to", to_carrier, "this joint");
    }
    const bool same_body = from_carrier.body >= 0 && from_carrier.body == to_carrier.body;
    const bool same_point = from_carrier.point >= 0 && from_carrier.point == to_carrier.point;
    if (same_body || same_point) table.fail("to", "joins a body with itself; 'from' and 'to' must differ");
    if (from_carrier.is_frame() && to_carrier.is_frame())
      table.fail("to", "joins no moving point or body; name one in 'from' or 'to'");
  }

  Carrier from_carrier, to_carrier;  ///< what the places move with
  Place from, to;
  Rows rows;

  void check_has_axes(const char* key, const Carrier& carrier, const std::string& what) const {
    if (carrier.point >= 0)
      table_.fail(key, "a point has no orientation; " + what + " needs a body or a fixed place");
  }

  SharedDirection shared(const ExpressionVector& on_from) const {
    return {on_from, draft_.in_axes_of(to_carrier, draft_.in_frame(from_carrier, on_from))};
  }

  JointAxes read_axes(const std::string& key) {
    Carrier carrier;
    const ExpressionVector along = draft_.read_direction(table_, key, carrier);
    if (!carrier.is_frame() && carrier.body != from_carrier.body && carrier.body != to_carrier.body)
      table_.fail(key, "must be a direction of one of the joined bodies, or [x, y, z] in the frame");
    const ExpressionVector in_frame = draft_.in_frame(carrier, along);
    const ExpressionVector axis = draft_.in_axes_of(from_carrier, in_frame);
    // Any direction that is not close to the axis serves, as long as the choice is the same along the whole
    // trace.
    Eigen::Index least = 0;
    draft_.vector_at(axis, 0).cwiseAbs().minCoeff(&least);
    const ExpressionVector first = normalized(cross(axis, unit_vector(static_cast<std::size_t>(least))));
    JointAxes axes{shared(axis), shared(first), shared(cross(axis, first))};
    // If the scene gives the axis on the second body, its components there are used exactly.
    if (carrier.body >= 0 && carrier.body == to_carrier.body) axes.axis.to = along;
    return axes;
  }

  Place on_from(const ExpressionVector& direction) { return draft_.direction_on(from_carrier, direction); }
  Place on_to(const ExpressionVector& direction) { return draft_.direction_on(to_carrier, direction); }
  HingeAngle angle_about(const JointAxes& axes) {
    return {on_from(axes.axis.from), on_from(axes.first.from), on_to(axes.first.to)};
  }

  HingeAngle slide_along(const JointAxes& axes) { return {on_from(axes.axis.from), from, to}; }
  /// The joint with its angle about these axes.
  void turns_about(const JointAxes& axes, JointMotions& motions) {
    motions.from = from_carrier;
    motions.to = to_carrier;
    motions.angles.push_back(angle_about(axes));
  }

  /// The places coincide.
  void coincide() {
    for (int i = 0; i < 3; ++i) rows.push_back({{to, from}, {}, i, draft_.quantity(0.0)});
  }
  /// A direction of one side is normal to a direction of the other side.
  void normal(const ExpressionVector& of_from, const ExpressionVector& of_to) {
    const Place first = on_from(of_from);
    rows.push_back({{first, {}}, Difference{on_to(of_to), {}}, 0, draft_.quantity(0.0)});
  }
  /// The distance from -> to, along a direction of the first side.
  void along(const ExpressionVector& of_from, const Expression& distance = 0.0) {
    rows.push_back({{on_from(of_from), {}}, Difference{to, from}, 0, draft_.quantity(distance)});
  }
  /// The axes of both sides stay parallel.
  void parallel(const JointAxes& axes) {
    normal(axes.axis.from, axes.first.to);
    normal(axes.axis.from, axes.second.to);
  }
  /// The place on the second side stays on the axis of the first side.
  void on_axis(const JointAxes& axes) {
    along(axes.first.from);
    along(axes.second.from);
  }
  /// The second side is rotated about the axis by an angle from its orientation in the starting guess.
  void turned_by(const JointAxes& axes, const Expression& angle) {
    normal(cos(angle) * axes.second.from - sin(angle) * axes.first.from, axes.first.to);
  }

 private:
  Draft& draft_;
  TableReader& table_;
};

Rows read_rod(Draft& draft, TableReader& table, JointMotions&) {
  const JointReader joint(draft, table, false);
  const Expression length = draft.read_number(table, "length", "m", Range::positive);
  const Difference d{joint.to, joint.from};
  return {{d, d, 0, draft.quantity(length * length)}};
}

Rows read_plane(Draft& draft, TableReader& table, JointMotions&) {
  const Place point = draft.read_moving_place(table, "point");
  const ExpressionVector normal = draft.read_vector(table, "normal", any_unit, Range::positive);
  const Expression offset = draft.read_number(table, "offset", "m", Range::any, 0.0);
  return {{{draft.fixed_place(normal), {}}, Difference{point, {}}, 0, draft.quantity(offset)}};
}

Rows read_fixed(Draft& draft, TableReader& table, JointMotions&) {
  const Place point = draft.read_moving_place(table, "point");
  const std::string name = table.text("coordinate");
  const std::size_t axis = std::string_view("xyz").find(name);
  if (name.size() != 1 || axis == std::string_view::npos) {
    table.fail("coordinate", "expected \"x\", \"y\" or \"z\", found \"" + name + "\"");
  }
  const Expression value = draft.read_number(table, "value", "m", Range::any, 0.0);
  return {{{point, {}}, {}, static_cast<int>(axis), draft.quantity(value)}};
}

Rows read_ball(Draft& draft, TableReader& table, JointMotions&) {
  JointReader joint(draft, table, false);
  joint.coincide();
  return joint.rows;
}

Rows read_revolute(Draft& draft, TableReader& table, JointMotions& motions) {
  JointReader joint(draft, table, true);
  const JointAxes axes = joint.read_axes("axis");
  joint.coincide();
  joint.parallel(axes);
  if (table.has("angle")) joint.turned_by(axes, draft.read_number(table, "angle", "rad", Range::any));
  joint.turns_about(axes, motions);
  return joint.rows;
}

Rows read_universal(Draft& draft, TableReader& table, JointMotions& motions) {
  JointReader joint(draft, table, true);
  const JointAxes axes = joint.read_axes("axis");
  const JointAxes cross = joint.read_axes("cross_axis");
  for (std::size_t i = 0; i < draft.request.check_at.size(); ++i) {
    const double cosine = draft.vector_at(axes.axis.from, i).dot(draft.vector_at(cross.axis.from, i));
    if (std::abs(cosine) > 1e-9) {
      table.fail("cross_axis", "must be at a right angle to axis at the starting guess; the cosine is " +
                                   exact_text(cosine) + Draft::where_on_trace(i));
    }
  }
  joint.coincide();
  joint.normal(axes.axis.from, cross.axis.to);
  // For each of the two axes, the other axis shows the angle, because it stays normal to the first.
  const Place first = joint.on_from(axes.axis.from);
  const Place second = joint.on_to(cross.axis.to);
  motions.angles.push_back({first, joint.on_from(cross.axis.from), second});
  motions.angles.push_back({second, first, joint.on_to(axes.axis.to)});
  return joint.rows;
}

Rows read_cylindrical(Draft& draft, TableReader& table, JointMotions& motions) {
  JointReader joint(draft, table, true);
  const JointAxes axes = joint.read_axes("axis");
  joint.parallel(axes);
  joint.on_axis(axes);
  joint.turns_about(axes, motions);
  motions.slides.push_back(joint.slide_along(axes));
  return joint.rows;
}

Rows read_prismatic(Draft& draft, TableReader& table, JointMotions& motions) {
  JointReader joint(draft, table, true);
  const JointAxes axes = joint.read_axes("axis");
  joint.parallel(axes);
  joint.turned_by(axes, 0.0);
  joint.on_axis(axes);
  if (table.has("length")) joint.along(axes.axis.from, draft.read_number(table, "length", "m", Range::any));
  motions.slides.push_back(joint.slide_along(axes));
  return joint.rows;
}

Rows read_weld(Draft& draft, TableReader& table, JointMotions&) {
  JointReader joint(draft, table, true);
  joint.coincide();
  for (std::size_t i = 0; i < 3; ++i) joint.normal(unit_vector(i), joint.shared(unit_vector((i + 1) % 3)).to);
  return joint.rows;
}

Rows read_point_on_line(Draft& draft, TableReader& table, JointMotions&) {
  JointReader joint(draft, table, false);
  joint.check_has_axes("from", joint.from_carrier, "the line");
  joint.on_axis(joint.read_axes("axis"));
  return joint.rows;
}

Rows read_point_on_plane(Draft& draft, TableReader& table, JointMotions&) {
  JointReader joint(draft, table, false);
  joint.check_has_axes("from", joint.from_carrier, "the plane");
  const JointAxes axes = joint.read_axes("normal");
  joint.along(axes.axis.from, draft.read_number(table, "distance", "m", Range::any, 0.0));
  return joint.rows;
}

const FieldHelp from_help{"from", "place", "where it sits on one side"};
const FieldHelp to_help{"to", "place", "where it sits on the other side"};
const FieldHelp axis_help{"axis", "direction", "its axis, at the starting guess"};

}  // namespace

const std::vector<ConstraintKind>& constraint_kinds() {
  static const std::vector<ConstraintKind> kinds = {
      {"directors", "unit axes at right angles, of every body", {}, nullptr},
      {"rod",
       "massless rigid rod between two places: c = |to - from|^2 - length^2",
       {{"from", "place", "one end"},
        {"to", "place", "the other end"},
        {"length", "m", "distance of the ends"}},
       read_rod},
      {"plane",
       "keeps a point on a plane of the frame: c = normal . x - offset",
       {{"point", "moving place", "the point"},
        {"normal", "[x, y, z]", "normal of the plane, of any length"},
        {"offset", "m", "normal . x on the plane", "0"}},
       read_plane},
      {"fixed",
       "holds one coordinate of a point: c = x_i - value",
       {{"point", "moving place", "the point"},
        {"coordinate", "axis", "which coordinate: \"x\", \"y\" or \"z\""},
        {"value", "m", "what it is held at", "0"}},
       read_fixed},
      {"ball", "two places coincide", {from_help, to_help}, read_ball},
      {"revolute",
       "hinge: two places coincide, turning about one axis only",
       {from_help,
        to_help,
        axis_help,
        {"angle", "rad",
         "holds the second side turned by this angle about the axis, from the orientations that the scene "
         "gives",
         "free"}},
       read_revolute},
      {"universal",
       "two places coincide, turning about two crossed axes",
       {from_help,
        to_help,
        {"axis", "direction", "the axis fixed to the first side, at the starting guess"},
        {"cross_axis", "direction", "the axis fixed to the second side, at a right angle to it"}},
       read_universal},
      {"cylindrical",
       "turning about an axis and sliding along it",
       {from_help, to_help, axis_help},
       read_cylindrical},
      {"prismatic",
       "sliding along an axis without turning",
       {from_help, to_help, axis_help, {"length", "m", "holds the distance along the axis", "free"}},
       read_prismatic},
      {"weld", "no relative motion", {from_help, to_help}, read_weld},
      {"point_on_line",
       "keeps a place on a line",
       {{"from", "place", "a place of the line"},
        {"to", "place", "what stays on it"},
        {"axis", "direction", "direction of the line"}},
       read_point_on_line},
      {"point_on_plane",
       "keeps a place on a plane that may move",
       {{"from", "place", "a place of the plane"},
        {"to", "place", "what stays on it"},
        {"normal", "direction", "normal of the plane"},
        {"distance", "m", "distance from the plane along the normal", "0"}},
       read_point_on_plane},
      // They name joints, which are read before.
      {"coupler",
       "linear relation of joints: the sum of ratio times motion is zero",
       {{"joints", "list of joints",
         "two or more; the motion is the angle (rad) or the displacement (m) from the starting guess; "
         "NAME.slide of a cylindrical joint, NAME.axis and NAME.cross_axis of a universal one"},
        {"ratios", "list", "a number for each"}},
       read_coupler},
      {"gear",
       "two wheels that mesh: they turn in opposite directions, by angles in the inverse ratio of their "
       "teeth",
       {{"joints", "two joints", "each joins a wheel to what carries both; their axes are parallel"},
        {"teeth", "list", "of each wheel; or their radii"},
        {"internal", "true or false", "whether the second wheel is a ring around the first", "false"}},
       read_gear}};
  return kinds;
}

void read_constraints(Draft& draft) {
  for (const ConstraintKind& kind : constraint_kinds()) {
    if (kind.read == nullptr) continue;
    draft.for_each_table(kind.name, [&](TableReader& table, std::size_t i) {
      JointMotions motions;
      Rows rows = kind.read(draft, table, motions);
      const std::string label = label_of(table, kind.name, i);
      table.finish();
      const bool taken = !draft.constraint_labels.insert(label).second;
      if (taken) table.fail("name", "another constraint is called '" + label + "' already");
      if (!motions.angles.empty() || !motions.slides.empty()) draft.joints[label] = std::move(motions);
      draft.add_constraint(kind.name, label, std::move(rows));
    });
  }
}

}  // namespace eigentrail
