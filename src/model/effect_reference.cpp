// Describes the keys of all effects, collected from the registry.
#include "eigentrail/core/text.hpp"
#include "model/readers.hpp"
#include "model/registry.hpp"

namespace eigentrail {
namespace {

/// Collects the keys of an element.
class HelpCollector {
 public:
  explicit HelpCollector(std::vector<FieldHelp>& fields) : fields_(fields) {}
  void place(std::string_view key, const Place&, std::string_view help) { add(key, "place", help); }
  void point(std::string_view key, const Place&, std::string_view help) { add(key, "moving place", help); }
  void direction(std::string_view key, const Place&, std::string_view help) { add(key, "direction", help); }
  void body(std::string_view key, const std::array<Place, 3>&, std::string_view help) {
    add(key, "name of a body", help);
  }
  void joint(std::string_view key, const HingeAngle&, std::string_view help) {
    add(key, "name of a joint", help);
    add("about", "\"axis\" or \"cross_axis\"", "which angle of a universal joint", "its only angle");
  }
  void quantity(const QuantityField& field, const Quantity&) {
    add(field, "", field.otherwise ? exact_text(*field.otherwise) : "");
  }
  void vector(const QuantityField& field, const std::array<Quantity, 3>&) {
    add(field, "[x, y, z] ", field.otherwise ? "[0, 0, " + exact_text(*field.otherwise) + "]" : "");
  }
  void matrix(const QuantityField& field, const std::array<Quantity, 4>&) {
    add(field, "2 x 2 ", field.otherwise ? exact_text(*field.otherwise) : "");
  }

 private:
  void add(std::string_view key, const std::string& shape, std::string_view help,
           const std::string& otherwise = "") {
    fields_.push_back({std::string(key), shape, std::string(help), otherwise});
  }
  void add(const QuantityField& field, const std::string& shape, const std::string& otherwise) {
    add(field.key, shape + std::string(field.unit), field.help, otherwise);
  }
  std::vector<FieldHelp>& fields_;
};

/// Keys of a table that has its own reader.
template <class Element>
std::vector<FieldHelp> table_fields() {
  if constexpr (std::is_same_v<Element, PointMass>) {
    return {
        {"name", "text", "what other tables call it"},
        {"mass", "kg", "its mass"},
        {"position", "[x, y, z] m", "where it is at first: a guess, from which the equilibrium is found"}};
  }
  if constexpr (std::is_same_v<Element, RigidBody>) {
    return {{"name", "text", "what other tables call it"},
            {"mass", "kg", "its mass"},
            {"centre", "[x, y, z] m", "centre of mass in the body's axes", "[0, 0, 0]"},
            {"inertia", "kg m^2", "[Ixx, Iyy, Izz] or 3 x 3, about the centre, in the body's axes", "0"},
            {"position", "[x, y, z] m", "of the body's origin, a guess"},
            {"axis_angle", "{ axis, angle }", "the body's axes are the frame's, turned", "not turned"},
            {"euler", "{ sequence, angles }", "three turns about the body's axes: \"zyx\", [rad, rad, rad]",
             "not turned"},
            {"x_axis", "[x, y, z]", "two of the three axes; the first given is met exactly", "not turned"},
            {"y_axis", "[x, y, z]", "likewise", "not turned"},
            {"z_axis", "[x, y, z]", "likewise", "not turned"},
            {"markers", "{ name = [x, y, z] }", "named places in the body's axes, m", "none"}};
  }
  if constexpr (std::is_same_v<Element, RotatingFrame>) {
    return {{"angular_velocity", "[x, y, z] rad/s", "of the frame, about an axis through the origin"}};
  }
  if constexpr (std::is_same_v<Element, Gravity>) {
    return {{"acceleration", "[x, y, z] m/s^2", "of gravity; in a rotating frame parallel to its axis"}};
  }
  if constexpr (std::is_same_v<Element, BladeElement>) return strip_fields();
  if constexpr (std::is_same_v<Element, BeamSection>) return beam_fields();
  if constexpr (std::is_same_v<Element, BeamDamping>) return beam_damping_fields();
  if constexpr (std::is_same_v<Element, Inflow>) return inflow_fields();
  if constexpr (std::is_same_v<Element, Strip>) return strips_fields();
  if constexpr (std::is_same_v<Element, LiftLag>) return lift_lag_fields();
  if constexpr (std::is_same_v<Element, ApparentMass>) return apparent_mass_fields();
}

}  // namespace

std::vector<EffectHelp> effect_reference() {
  std::vector<EffectHelp> reference;
  Elements().for_each([&]<class Element>(const std::vector<Placed<Element>>&, std::size_t) {
    EffectHelp& help = reference.emplace_back();
    help.name = Element::name;
    help.description = Element::description;
    if constexpr (has_own_table<Element>) {
      HelpCollector collector(help.fields);
      const Element element;
      Element::fields(element, collector);
    } else {
      help.fields = table_fields<Element>();
    }
    if constexpr (number_of_states<Element>() > 0) {
      for (const OwnState& state : Element::states)
        help.states.push_back({std::string(state.name), std::string(state.unit), std::string(state.help)});
    }
  });
  reference.push_back({"rotor", "N equal blades, of which the scene describes one, on a support that stands",
                       bladed_rotor_fields()});
  reference.push_back(
      {"trim", "a condition at the equilibrium, and the parameter that it determines", trim_fields()});
  reference.push_back({"blade", "a beam on a hub, by the stations of a blade", blade_fields()});
  for (const ConstraintKind& kind : constraint_kinds()) {
    if (kind.read != nullptr)
      reference.push_back({std::string(kind.name), std::string(kind.description), kind.fields});
  }
  return reference;
}

}  // namespace eigentrail
