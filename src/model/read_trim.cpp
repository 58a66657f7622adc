#include "model/readers.hpp"

#include <algorithm>
#include <numeric>

#include "core/texts.hpp"
#include "eigentrail/core/text.hpp"

namespace eigentrail {
namespace {

/// A condition in parts: "force(wing, z) = weight".
struct ConditionText {
  std::string quantity;                ///< "force"
  std::vector<std::string> arguments;  ///< "wing", "z"
  std::string target;                  ///< "weight"
};

struct QuantityKind {
  std::string_view name, arguments, unit;
};
constexpr std::array<QuantityKind, 5> quantity_kinds = {
    {{"thrust", "inflow, or strips on the blade of [rotor]", "N"},
     {"force", "strips or joint, axis", "N"},
     {"moment", "joint, axis, or torsional spring", "N m"},
     {"angle", "joint", "rad"},
     {"position", "place, axis", "m"}}};

std::string list_of_quantities() {
  return joined(quantity_kinds, ", ", [](const QuantityKind& kind) {
    return std::string(kind.name) + "(" + std::string(kind.arguments) + ")";
  });
}

ConditionText parts_of_condition(const TableReader& table, std::string_view text) {
  const std::size_t equals = text.find('='), open = text.find('('), close = text.find(')');
  const bool in_order = open < close && close < equals && equals != std::string_view::npos &&
                        trimmed(text.substr(close + 1, equals - close - 1)).empty();
  if (!in_order)
    table.fail("condition", "expected \"quantity(name) = expression\", found \"" + std::string(text) +
                                "\"; quantities are " + list_of_quantities());
  ConditionText parts{
      std::string(trimmed(text.substr(0, open))), {}, std::string(trimmed(text.substr(equals + 1)))};
  for (const std::string& argument : split(std::string(text.substr(open + 1, close - open - 1)), ','))
    parts.arguments.emplace_back(trimmed(argument));
  return parts;
}

class TrimReader {
 public:
  TrimReader(Draft& draft, const std::vector<InflowDraft>& inflows) : draft_(draft), inflows_(inflows) {}

  TrimCondition read(TableReader& table) {
    TrimCondition trim;
    const std::string name = table.text("unknown");
    trim.parameter = unknown(table, name);
    trim.text = printable(table.text("condition"));
    const ConditionText parts = parts_of_condition(table, trim.text);
    const auto kind = std::find_if(quantity_kinds.begin(), quantity_kinds.end(),
                                   [&](const QuantityKind& k) { return k.name == parts.quantity; });
    if (kind == quantity_kinds.end())
      table.fail("condition",
                 "no quantity is called '" + parts.quantity + "'; there are " + list_of_quantities());
    trim.quantity = quantity(table, parts);
    trim.target = draft_.quantity(target(table, parts.target, kind->unit));
    if (auto* row = std::get_if<ConstraintRow>(&trim.quantity)) row->offset = trim.target;
    table.finish();
    return trim;
  }

 private:
  int unknown(TableReader& table, const std::string& name) {
    const auto index = draft_.scene.parameters.index(name);
    if (!index) {
      table.fail("unknown", "no parameter is called '" + name +
                                "'; declare it in [parameters] with a guess; " +
                                suggestion(name, draft_.scene.parameters.names()));
    }
    const Parameter& parameter = draft_.scene.parameters[static_cast<std::size_t>(*index)];
    if (parameter.definition)
      table.fail("unknown",
                 "'" + name + "' is defined by other parameters; declare it with a number, its guess");
    for (const TrimCondition& other : draft_.data.trims) {
      if (other.parameter == *index)
        table.fail("unknown", "'" + name + "' is the unknown of another [[trim]] already");
    }
    return *index;
  }

  /// Lets read(reader, "condition") read a part of the condition, with its place in the file.
  auto read_part(const TableReader& table, const std::string& text, auto read) {
    Table part;
    part.where = draft_.begun_where;
    part.entries.emplace_back("condition", Value{text, draft_.begun_where});
    TableReader reader(draft_.scene, part, table.label(), draft_.used);
    return read(reader, "condition");
  }

  Expression target(TableReader& table, const std::string& text, std::string_view unit) {
    return read_part(table, text,
                     [&](TableReader& part, const char* key) { return part.expression(key, unit); });
  }

  std::variant<TrimLoad, ConstraintRow> quantity(TableReader& table, const ConditionText& parts) {
    const std::string& name = parts.arguments[0];
    const bool spring = parts.quantity == "moment" && has_label<TorsionalSpring>(name);
    const bool has_axis =
        parts.quantity == "force" || parts.quantity == "position" || (parts.quantity == "moment" && !spring);
    if (parts.arguments.size() != (has_axis ? 2u : 1u))
      table.fail("condition", parts.quantity + (has_axis ? ": expected a name and an axis, x, y or z"
                                                         : ": expected one name in the brackets"));
    if (parts.quantity == "thrust")
      return draft_.rotor && !is_inflow(name) ? thrust_of_blades(table, name) : thrust(table, name);
    if (parts.quantity == "angle") return angle(table, name);
    if (spring) return spring_moment(name);
    const int axis = read_axis(table, parts.arguments[1]);
    if (parts.quantity == "position") return ConstraintRow{{place(table, name), {}}, {}, axis, {}};
    return load(table, name, axis, parts.quantity == "moment");
  }

  /// 0 x, 1 y, 2 z.
  static int read_axis(TableReader& table, const std::string& name) {
    const std::size_t axis = std::string_view("xyz").find(name);
    if (name.size() != 1 || axis == std::string_view::npos)
      table.fail("condition", "expected the axis x, y or z, found \"" + name + "\"");
    return static_cast<int>(axis);
  }

  Place place(TableReader& table, const std::string& name) {
    return read_part(table, name,
                     [&](TableReader& part, const char* key) { return draft_.read_moving_place(part, key); });
  }

  /// Names of all tables of a kind, also if it is left out.
  std::vector<std::string> names_of_tables(std::string_view kind) {
    const std::vector<const Table*> all = tables(draft_.scene, std::string(kind));
    std::vector<std::string> names;
    for (std::size_t i = 0; i < all.size(); ++i) {
      TableReader table(draft_.scene, *all[i], "", draft_.used);
      names.push_back(label_of(table, kind, i));
    }
    return names;
  }

  bool is_inflow(const std::string& name) {
    const std::vector<std::string> names = names_of_tables(Inflow::name);
    return std::find(names.begin(), names.end(), name) != names.end();
  }

  /// What the thrust does on the coordinate of the mean inflow; the air answers it.
  TrimLoad thrust(TableReader& table, const std::string& name) {
    if (draft_.is_left_out(Inflow::name) && is_inflow(name))
      table.fail("condition", "the inflow '" + name + "' is left out; leave out the condition, too");
    TrimLoad load;
    for (const InflowDraft& inflow : inflows_) {
      if (inflow.name != name) continue;
      if (!inflow.annular) load.motion.places = {inflow.element.velocity.terms.front().triple};
      for (const Inflow& annulus : inflow.annuli)
        load.motion.places.push_back(annulus.velocity.terms.front().triple);
    }
    if (load.motion.places.empty()) {
      const std::vector<std::string> names = names_of_tables(Inflow::name);
      table.fail("condition",
                 "no [[inflow]] is called '" + name + "'" +
                     (names.empty() ? "; force(strips, axis) needs none" : "; " + suggestion(name, names)));
    }
    take<Inflow>(name, load);
    load.motion.axis = fixed_axis(0);
    load.motion.factor = -1.0;
    return load;
  }

  /// The force of the air on all blades of a [rotor] along its axis. Across it their forces cancel.
  TrimLoad thrust_of_blades(TableReader& table, const std::string& name) {
    TrimLoad load;
    if (!take_strips(name, load)) {
      std::vector<std::string> names = names_of_strips(table, name);
      for (std::string& inflow : names_of_tables(Inflow::name)) names.push_back(std::move(inflow));
      index_of(name, names, table, "condition", "strips or inflow");
    }
    if (!on_blade(load))
      table.fail("condition", "thrust: the strips '" + name +
                                  "' are not on the blade of [rotor]; expected force(" + name +
                                  ", z), of the support");
    move_all(load.motion);
    load.motion.axis = fixed_axis(2);
    load.motion.factor = draft_.rotor->blades;
    return load;
  }

  /// Whether strips are on the blade of a [rotor].
  bool on_blade(TrimLoad& load) const {
    const auto moves_with_blade = [&](const auto& placed) {
      return std::any_of(placed.arguments.begin(), placed.arguments.end(), [&](const Place& place) {
        return std::any_of(place.terms.begin(), place.terms.end(),
                           [&](const Term& term) { return !draft_.stands(term.triple); });
      });
    };
    const auto& strips = load.elements.list<Strip>();
    const auto& elements = load.elements.list<BladeElement>();
    return std::any_of(strips.begin(), strips.end(), moves_with_blade) ||
           std::any_of(elements.begin(), elements.end(), moves_with_blade);
  }

  /// A translation of everything.
  void move_all(VirtualMotion& motion) const {
    motion.places.resize(draft_.points.size());
    std::iota(motion.places.begin(), motion.places.end(), 0);
    for (const BodyDraft& body : draft_.bodies) motion.places.push_back(body.triple);
  }

  /// Within half a turn of the angle of the guess.
  ConstraintRow angle(TableReader& table, const std::string& name) {
    index_of(name, draft_.joints_with_angles(1), table, "condition",
             "joint with one angle (revolute, cylindrical)");
    ConstraintRow row;
    row.coupled = {{draft_.quantity(1.0), draft_.joints.at(name).angles.front(), false}};
    return row;
  }

  /// The moment of a torsional spring in the direction of growing angles, on the side that turns.
  TrimLoad spring_moment(const std::string& name) {
    TrimLoad load;
    take<TorsionalSpring>(name, load);
    const HingeAngle& angle = load.elements.list<TorsionalSpring>().front().element.angle;
    load.motion.axis = angle.axis;
    load.motion.about = draft_.fixed_place({});
    load.motion.factor = angle.to.moves() ? 1.0 : -1.0;
    for (const Term& term : (angle.to.moves() ? angle.to : angle.from).terms)
      load.motion.directions.push_back(term.triple);
    return load;
  }

  TrimLoad load(TableReader& table, const std::string& name, int axis, bool moment) {
    TrimLoad load;
    load.motion.axis = fixed_axis(axis);
    if (!moment && take_strips(name, load)) {
      move_all(load.motion);
      return load;
    }
    for (const Constraint& constraint : draft_.data.constraints) {
      if (constraint.label == name && draft_.constraint_labels.contains(name))
        load.constraints.push_back(constraint);
    }
    if (load.constraints.empty()) {
      std::vector<std::string> names(draft_.constraint_labels.begin(), draft_.constraint_labels.end());
      const auto& springs = draft_.data.elements.list<TorsionalSpring>();
      for (std::string& other :
           moment ? names_of(springs, &Placed<TorsionalSpring>::label) : names_of_strips(table, name))
        names.push_back(std::move(other));
      index_of(name, names, table, "condition", moment ? "joint or torsional spring" : "joint or strips");
    }
    move_one_side(table, name, moment, load.motion);
    return load;
  }

  /// The motion of the second side of a joint; of the first side, reversed, if the second one is the frame.
  void move_one_side(TableReader& table, const std::string& name, bool moment, VirtualMotion& motion) {
    TableReader joint = table_of_constraint(name);
    std::vector<std::string> keys = {"to", "from"};
    if (joint.has("point")) keys = {"point"};
    for (const std::string& key : keys) {
      Carrier carrier;
      const Place at = draft_.read_place(joint, key, &carrier);
      if (carrier.is_frame()) {
        motion.factor = -motion.factor;
        continue;
      }
      if (carrier.body < 0) {
        if (moment) table.fail("condition", "'" + name + "' holds a point, on which it has no moment");
        motion.places = {carrier.point};
        return;
      }
      const int origin = draft_.bodies[static_cast<std::size_t>(carrier.body)].triple;
      motion.places = {origin};
      if (!moment) return;
      motion.about = at;
      motion.directions = {origin + 1, origin + 2, origin + 3};
      return;
    }
  }

  TableReader table_of_constraint(const std::string& name) {
    for (const ConstraintKind& kind : constraint_kinds()) {
      const std::vector<const Table*> all = tables(draft_.scene, std::string(kind.name));
      for (std::size_t i = 0; i < all.size(); ++i) {
        TableReader table(draft_.scene, *all[i], "[[" + std::string(kind.name) + "]]", draft_.used);
        if (label_of(table, kind.name, i) == name) return table;
      }
    }
    throw std::logic_error("a constraint without table: " + name);
  }

  /// Names of all strips. Those whose effect is left out have no force.
  std::vector<std::string> names_of_strips(TableReader& table, const std::string& name) {
    std::vector<std::string> names;
    for (const std::string_view kind : {Strip::name, BladeElement::name}) {
      for (std::string& strips : names_of_tables(kind)) names.push_back(std::move(strips));
      if (draft_.is_left_out(kind) && std::find(names.begin(), names.end(), name) != names.end())
        table.fail("condition",
                   "the " + std::string(kind) + " '" + name + "' is left out; leave out the condition, too");
    }
    return names;
  }

  template <class Element>
  bool has_label(const std::string& name) {
    const auto& all = draft_.data.elements.list<Element>();
    return std::any_of(all.begin(), all.end(), [&](const auto& placed) { return placed.label == name; });
  }

  /// Copies the elements of that label, or of the strips of that name, to the load.
  template <class Element>
  void take(const std::string& name, TrimLoad& load) {
    for (const auto& placed : draft_.data.elements.list<Element>()) {
      const bool is_part =
          placed.label.starts_with(name + ", strip ") || placed.label.starts_with(name + ", annulus ");
      if (placed.label == name || is_part) load.elements.list<Element>().push_back(placed);
    }
  }

  bool take_strips(const std::string& name, TrimLoad& load) {
    take<Strip>(name, load);
    take<BladeElement>(name, load);
    if (load.elements.list<Strip>().empty() && load.elements.list<BladeElement>().empty()) return false;
    take<LiftLag>(name, load);
    take<ApparentMass>(name, load);
    return true;
  }

  Place fixed_axis(int axis) { return draft_.fixed_place(unit_vector(static_cast<std::size_t>(axis))); }

  Draft& draft_;
  const std::vector<InflowDraft>& inflows_;
};

}  // namespace

void read_trims(Draft& draft, const std::vector<InflowDraft>& inflows) {
  TrimReader reader(draft, inflows);
  draft.for_each_table(
      "trim", [&](TableReader& table, std::size_t) { draft.data.trims.push_back(reader.read(table)); });
}

std::vector<FieldHelp> trim_fields() {
  return {{"unknown", "name of a parameter",
           "what is solved for; its value in [parameters] is the guess, and in the motion it is constant"},
          {"condition", "text",
           "\"quantity = expression\", what holds at the equilibrium; quantities are " +
               list_of_quantities() + ", along axes x, y, z of the frame"}};
}

}  // namespace eigentrail
