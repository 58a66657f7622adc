// All kinds of constraints: their keys, and the rows that they consist of.
#include <algorithm>
#include <cmath>

#include "eigentrail/core/text.hpp"
#include "model/draft.hpp"

namespace eigentrail {
namespace {

using Rows = std::vector<ConstraintRow>;
using Angles = std::vector<HingeAngle>;

/// A joint: the places that it connects, and what they move with.
struct Joint {
  Carrier from_carrier, to_carrier;
  Place from, to;
};

Joint read_sides(Draft& draft, TableReader& table, bool needs_axes) {
  Joint joint;
  joint.from = draft.read_place(table, "from", &joint.from_carrier);
  joint.to = draft.read_place(table, "to", &joint.to_carrier);
  const auto check = [&](const Carrier& carrier, const char* key) {
    if (needs_axes && carrier.point >= 0)
      table.fail(key, "a point has no orientation; this joint needs a body or a fixed place");
  };
  check(joint.from_carrier, "from");
  check(joint.to_carrier, "to");
  const bool same_body = joint.from_carrier.body >= 0 && joint.from_carrier.body == joint.to_carrier.body;
  const bool same_point = joint.from_carrier.point >= 0 && joint.from_carrier.point == joint.to_carrier.point;
  if (same_body || same_point) table.fail("to", "joins a body with itself; 'from' and 'to' must differ");
  if (joint.from_carrier.is_frame() && joint.to_carrier.is_frame())
    table.fail("to", "joins no moving point or body; name one in 'from' or 'to'");
  return joint;
}

/// A direction that is fixed on both sides of a joint and the same at the starting guess.
struct SharedDirection {
  ExpressionVector from, to;  ///< components in the axes of either side
};

SharedDirection shared(const Draft& draft, const Joint& joint, const ExpressionVector& from) {
  return {from, draft.in_axes_of(joint.to_carrier, draft.in_frame(joint.from_carrier, from))};
}

/// An axis and two directions normal to it, right-handed, on both sides of a joint.
struct JointAxes {
  SharedDirection axis, first, second;
};

JointAxes read_axes(Draft& draft, TableReader& table, const Joint& joint, const std::string& key) {
  Carrier carrier;
  const ExpressionVector along = draft.read_direction(table, key, carrier);
  if (!carrier.is_frame() && carrier.body != joint.from_carrier.body && carrier.body != joint.to_carrier.body)
    table.fail(key, "must be a direction of one of the joined bodies, or [x, y, z] in the frame");
  const ExpressionVector in_frame = draft.in_frame(carrier, along);
  const ExpressionVector axis = draft.in_axes_of(joint.from_carrier, in_frame);
  // Any direction that is not close to the axis serves, as long as the choice is the same along the whole
  // trace.
  Eigen::Index least = 0;
  draft.vector_at(axis, 0).cwiseAbs().minCoeff(&least);
  const ExpressionVector first = normalized(cross(axis, unit_vector(static_cast<std::size_t>(least))));
  JointAxes axes{shared(draft, joint, axis), shared(draft, joint, first),
                 shared(draft, joint, cross(axis, first))};
  // If the scene gives the axis on the second body, its components there are used exactly.
  if (carrier.body >= 0 && carrier.body == joint.to_carrier.body) axes.axis.to = along;
  return axes;
}

class RowBuilder {
 public:
  RowBuilder(Draft& draft, const Joint& joint) : draft_(draft), joint_(joint) {}

  /// The places coincide.
  void coincide() {
    for (int i = 0; i < 3; ++i) rows.push_back({{joint_.to, joint_.from}, {}, i, draft_.quantity(0.0)});
  }

  /// A direction of one side is normal to a direction of the other side.
  void normal(const ExpressionVector& on_from, const ExpressionVector& on_to) {
    rows.push_back({{draft_.direction_on(joint_.from_carrier, on_from), {}},
                    Difference{draft_.direction_on(joint_.to_carrier, on_to), {}},
                    0,
                    draft_.quantity(0.0)});
  }

  /// The distance from -> to, along a direction of the first side.
  void along(const ExpressionVector& on_from, const Expression& distance = 0.0) {
    rows.push_back({{draft_.direction_on(joint_.from_carrier, on_from), {}},
                    Difference{joint_.to, joint_.from},
                    0,
                    draft_.quantity(distance)});
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

  Rows rows;

 private:
  Draft& draft_;
  const Joint& joint_;
};

HingeAngle angle_about(Draft& draft, const Joint& joint, const JointAxes& axes) {
  return {draft.direction_on(joint.from_carrier, axes.axis.from),
          draft.direction_on(joint.from_carrier, axes.first.from),
          draft.direction_on(joint.to_carrier, axes.first.to)};
}

Rows read_rod(Draft& draft, TableReader& table, Angles&) {
  const Joint joint = read_sides(draft, table, false);
  const Expression length = draft.read_number(table, "length", "m", Range::positive);
  const Difference d{joint.to, joint.from};
  return {{d, d, 0, draft.quantity(length * length)}};
}

Rows read_plane(Draft& draft, TableReader& table, Angles&) {
  const Place point = draft.read_moving_place(table, "point");
  const ExpressionVector normal = draft.read_vector(table, "normal", any_unit, Range::positive);
  const Expression offset = draft.read_number(table, "offset", "m", Range::any, 0.0);
  return {{{draft.fixed_place(normal), {}}, Difference{point, {}}, 0, draft.quantity(offset)}};
}

Rows read_fixed(Draft& draft, TableReader& table, Angles&) {
  const Place point = draft.read_moving_place(table, "point");
  const std::string name = table.text("coordinate");
  const std::size_t axis = std::string_view("xyz").find(name);
  if (name.size() != 1 || axis == std::string_view::npos) {
    table.fail("coordinate", "expected \"x\", \"y\" or \"z\", found \"" + name + "\"");
  }
  const Expression value = draft.read_number(table, "value", "m", Range::any, 0.0);
  return {{{point, {}}, {}, static_cast<int>(axis), draft.quantity(value)}};
}

Rows read_ball(Draft& draft, TableReader& table, Angles&) {
  const Joint joint = read_sides(draft, table, false);
  RowBuilder builder(draft, joint);
  builder.coincide();
  return builder.rows;
}

Rows read_revolute(Draft& draft, TableReader& table, Angles& angles) {
  const Joint joint = read_sides(draft, table, true);
  const JointAxes axes = read_axes(draft, table, joint, "axis");
  RowBuilder builder(draft, joint);
  builder.coincide();
  builder.parallel(axes);
  if (table.has("angle")) builder.turned_by(axes, draft.read_number(table, "angle", "rad", Range::any));
  angles.push_back(angle_about(draft, joint, axes));
  return builder.rows;
}

Rows read_universal(Draft& draft, TableReader& table, Angles& angles) {
  const Joint joint = read_sides(draft, table, true);
  const JointAxes axes = read_axes(draft, table, joint, "axis");
  const JointAxes cross = read_axes(draft, table, joint, "cross_axis");
  for (std::size_t i = 0; i < draft.request.check_at.size(); ++i) {
    const double cosine = draft.vector_at(axes.axis.from, i).dot(draft.vector_at(cross.axis.from, i));
    if (std::abs(cosine) > 1e-9) {
      table.fail("cross_axis", "must be at a right angle to axis at the starting guess; the cosine is " +
                                   exact_text(cosine) + Draft::where_on_trace(i));
    }
  }
  RowBuilder builder(draft, joint);
  builder.coincide();
  builder.normal(axes.axis.from, cross.axis.to);
  // For each of the two axes, the other axis shows the angle, because it stays normal to the first.
  const Place first = draft.direction_on(joint.from_carrier, axes.axis.from);
  const Place second = draft.direction_on(joint.to_carrier, cross.axis.to);
  angles.push_back({first, draft.direction_on(joint.from_carrier, cross.axis.from), second});
  angles.push_back({second, first, draft.direction_on(joint.to_carrier, axes.axis.to)});
  return builder.rows;
}

Rows read_cylindrical(Draft& draft, TableReader& table, Angles& angles) {
  const Joint joint = read_sides(draft, table, true);
  const JointAxes axes = read_axes(draft, table, joint, "axis");
  RowBuilder builder(draft, joint);
  builder.parallel(axes);
  builder.on_axis(axes);
  angles.push_back(angle_about(draft, joint, axes));
  return builder.rows;
}

Rows read_prismatic(Draft& draft, TableReader& table, Angles&) {
  const Joint joint = read_sides(draft, table, true);
  const JointAxes axes = read_axes(draft, table, joint, "axis");
  RowBuilder builder(draft, joint);
  builder.parallel(axes);
  builder.turned_by(axes, 0.0);
  builder.on_axis(axes);
  if (table.has("length")) builder.along(axes.axis.from, draft.read_number(table, "length", "m", Range::any));
  return builder.rows;
}

Rows read_weld(Draft& draft, TableReader& table, Angles&) {
  const Joint joint = read_sides(draft, table, true);
  RowBuilder builder(draft, joint);
  builder.coincide();
  for (std::size_t i = 0; i < 3; ++i) {
    const SharedDirection e = shared(draft, joint, unit_vector(i));
    const SharedDirection next = shared(draft, joint, unit_vector((i + 1) % 3));
    builder.normal(e.from, next.to);
  }
  return builder.rows;
}

Rows read_point_on_line(Draft& draft, TableReader& table, Angles&) {
  const Joint joint = read_sides(draft, table, false);
  if (joint.from_carrier.point >= 0)
    table.fail("from", "a point has no orientation; the line needs a body or a fixed place");
  const JointAxes axes = read_axes(draft, table, joint, "axis");
  RowBuilder builder(draft, joint);
  builder.on_axis(axes);
  return builder.rows;
}

Rows read_point_on_plane(Draft& draft, TableReader& table, Angles&) {
  const Joint joint = read_sides(draft, table, false);
  if (joint.from_carrier.point >= 0)
    table.fail("from", "a point has no orientation; the plane needs a body or a fixed place");
  const JointAxes axes = read_axes(draft, table, joint, "normal");
  RowBuilder builder(draft, joint);
  builder.along(axes.axis.from, draft.read_number(table, "distance", "m", Range::any, 0.0));
  return builder.rows;
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
       read_point_on_plane}};
  return kinds;
}

void read_constraints(Draft& draft) {
  for (const ConstraintKind& kind : constraint_kinds()) {
    if (kind.read == nullptr) continue;
    draft.for_each_table(kind.name, [&](TableReader& table, std::size_t i) {
      std::vector<HingeAngle> angles;
      Rows rows = kind.read(draft, table, angles);
      const std::string label = label_of(table, kind.name, i);
      table.finish();
      const bool taken = !draft.constraint_labels.insert(label).second;
      if (taken) table.fail("name", "another constraint is called '" + label + "' already");
      if (!angles.empty()) draft.joint_angles[label] = std::move(angles);
      draft.add_constraint(kind.name, label, std::move(rows));
    });
  }
}

}  // namespace eigentrail
