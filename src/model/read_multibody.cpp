#include "model/model_readers.hpp"

#include <algorithm>

#include "model/add_element.hpp"
#include "model/beam_axis.hpp"
#include "model/multibody.hpp"
#include "model/readers.hpp"

namespace eigentrail {
namespace {

/// Reads the fields of an element from its table.
class FieldReader {
 public:
  FieldReader(Draft& draft, TableReader& table) : draft_(draft), table_(table) {}

  void place(std::string_view key, Place& place, std::string_view) {
    place = draft_.read_place(table_, std::string(key));
  }

  void point(std::string_view key, Place& place, std::string_view) {
    place = draft_.read_moving_place(table_, std::string(key));
  }

  void direction(std::string_view key, Place& place, std::string_view) {
    Carrier carrier;
    const ExpressionVector along = draft_.read_direction(table_, std::string(key), carrier);
    place = draft_.direction_on(carrier, along);
  }

  void body(std::string_view key, std::array<Place, 3>& directors, std::string_view) {
    directors = draft_.directors(draft_.read_body(table_, std::string(key)));
  }

  /// The angle of a joint. A universal joint has two; the key `about` selects one.
  void joint(std::string_view key_view, HingeAngle& angle, std::string_view) {
    const std::string key(key_view);
    const std::string name = table_.text(key);
    index_of(name, draft_.joints_with_angles(2), table_, key,
             "joint with an angle (revolute, universal, cylindrical)");
    const std::vector<HingeAngle>& angles = draft_.joints.at(name).angles;
    std::size_t which = 0;
    if (angles.size() > 1) {
      const std::string about = table_.text("about");
      if (about != "axis" && about != "cross_axis")
        table_.fail("about", "expected \"axis\" or \"cross_axis\", found \"" + about + "\"");
      which = about == "axis" ? 0 : 1;
    }
    angle = angles[which];
  }

  void quantity(const QuantityField& field, Quantity& quantity) {
    const std::string key(field.key);
    quantity = draft_.quantity(draft_.read_number(table_, key, field.unit, field.range, field.otherwise));
  }

  void vector(const QuantityField& field, std::array<Quantity, 3>& vector) {
    const std::string key(field.key);
    std::optional<ExpressionVector> otherwise;
    if (field.otherwise) otherwise = {0.0, 0.0, *field.otherwise};
    const WantedUnit unit = field.unit.empty() ? any_unit : WantedUnit(field.unit);  // none: a direction
    vector = draft_.vector(draft_.read_vector(table_, key, unit, field.range, otherwise));
  }

  void matrix(const QuantityField& field, std::array<Quantity, 4>& entries) {
    const std::string key(field.key);
    std::vector<std::vector<Expression>> rows(2, std::vector<Expression>(2, field.otherwise.value_or(0.0)));
    if (!field.otherwise || table_.has(key)) rows = table_.matrix(key, field.unit);
    if (rows.size() != 2 || rows[0].size() != 2 || rows[1].size() != 2)
      table_.fail(key, "expected a 2 x 2 matrix " + std::string(field.help));
    for (std::size_t i = 0; i < 4; ++i) {
      draft_.check_range(table_, key, rows[i / 2][i % 2], field.range);
      entries[i] = draft_.quantity(rows[i / 2][i % 2]);
    }
  }

 private:
  Draft& draft_;
  TableReader& table_;
};

/// Reads all [[name]] tables of one element type.
template <class Element>
void read_elements(Draft& draft) {
  draft.for_each_table(Element::name, [&](TableReader& table, std::size_t i) {
    Element element;
    FieldReader fields(draft, table);
    Element::fields(element, fields);
    const std::string label = label_of(table, Element::name, i);
    // States are coordinates, which the name of the element must tell apart.
    if (number_of_states<Element>() > 0)
      check_is_new(table, std::string(Element::name), label,
                   names_of(draft.data.elements.list<Element>(), &Placed<Element>::label));
    table.finish();
    std::vector<Place> moving;
    ArgumentCollector collector(moving);
    Element::fields(element, collector);
    if (moving.empty()) {
      throw scene_error(draft.scene, draft.begun_where,
                        table.label() + ": joins no moving point; name one in it");
    }
    add_element(draft, std::move(element), label);
  });
}

/// Reads the points. They are read first because everything else refers to them.
void read_points(Draft& draft) {
  draft.for_each_table("point", [&](TableReader& table, std::size_t i) {
    const std::string name = read_name(table, "point", draft.points);
    const Expression mass = draft.read_number(table, "mass", "kg", Range::non_negative);
    for (const Expression& e : draft.read_guess(table, "position")) draft.guess.push_back(e);
    table.finish();
    draft.points.push_back(name);
    draft.mass_names.push_back(name);
    MassDistribution& masses = draft.masses.emplace_back();
    masses.carriers[0] = draft.point_place(static_cast<int>(i));
    masses.mass = draft.quantity_unless_zero(mass);
  });
}

void add_masses(Draft& draft) {
  for (std::size_t i = 0; i < draft.masses.size(); ++i) {
    if (draft.masses[i].size == 1) {
      add_element(draft, PointMass{draft.masses[i]}, draft.mass_names[i]);
    } else {
      add_element(draft, RigidBody{{draft.masses[i]}}, draft.mass_names[i]);
    }
  }
}

/// Reads [frame] or [gravity]: one vector that acts on all masses. Empty if the scene has none.
template <class Element>
std::optional<ExpressionVector> read_field(Draft& draft, const std::string& key, std::string_view unit) {
  const std::vector<const Table*> found = tables(draft.scene, std::string(Element::name));
  if (found.empty()) return std::nullopt;
  const std::string label = "[" + std::string(Element::name) + "]";
  if (found.size() > 1)
    throw scene_error(draft.scene, found[1]->where, label + ": a scene has one of these at most");
  TableReader table = draft.reader(*found[0], label);
  const ExpressionVector field = draft.read_vector(table, key, unit, Range::any);
  table.finish();
  const std::array<Quantity, 3> quantities = draft.vector(field);
  for (std::size_t i = 0; i < draft.masses.size(); ++i) {
    const bool stands = draft.stands(draft.masses[i].carriers[0].terms[0].triple);
    if (std::is_same_v<Element, RotatingFrame> && stands) continue;
    add_element(draft, Element{draft.masses[i], quantities},
                std::string(Element::name) + " on " + draft.mass_names[i]);
  }
  return field;
}

/// If the frame rotates about an axis that is not parallel to gravity, gravity rotates in the frame and there
/// is no steady state.
void check_gravity(const Draft& draft, const ExpressionVector& rotation, const ExpressionVector& gravity) {
  for (std::size_t i = 0; i < draft.request.check_at.size(); ++i) {
    if (draft.are_parallel(rotation, gravity, 1e-12, i)) continue;
    throw scene_error(draft.scene, tables(draft.scene, "gravity")[0]->find("acceleration")->where,
                      "[gravity] acceleration: must be parallel to [frame] angular_velocity, or it turns in "
                      "the frame and there is no steady state");
  }
}

/// Whether blades have the effect: they are beams, and may have damping.
bool of_blades(const Draft& draft, const std::string& name) {
  return std::any_of(draft.beams.begin(), draft.beams.end(), [&](const BeamDraft& beam) {
    return name == BeamSection::name || (name == BeamDamping::name && !beam.damping_times.empty());
  });
}

/// Checks the effects that are switched off: the scene must have them, and they must not be inertia.
void check_without(const Draft& draft) {
  std::vector<std::string> can;
  draft.data.elements.for_each([&]<class Element>(const std::vector<Placed<Element>>&, std::size_t) {
    const std::string name(Element::name);
    const bool present = !tables(draft.scene, name).empty() || of_blades(draft, name);
    if (present && !std::is_base_of_v<PointMass, Element>) can.push_back(name);
  });
  for (const std::string& name : draft.request.without) {
    if (std::find(can.begin(), can.end(), name) != can.end()) continue;
    throw without_error(draft.scene, name,
                        "is no effect of this scene that can be left out (inertia and constraints cannot); " +
                            suggestion(name, can));
  }
}

/// Direction of the rotation of the frame at the first checked point where it is not zero.
std::optional<Eigen::Vector3d> axis_of(const Draft& draft, const ExpressionVector& rotation) {
  for (std::size_t i = 0; i < draft.request.check_at.size(); ++i) {
    const Eigen::Vector3d w = draft.vector_at(rotation, i);
    if (w.norm() > 0.0) return w.normalized();
  }
  return std::nullopt;
}

/// The discs that spin about an axis of a body: a direction that is one of its directors.
std::vector<SpinningAxis> spinning_axes(const Draft& draft) {
  std::vector<SpinningAxis> result;
  for (const Placed<SpinningDisc>& disc : draft.data.elements.list<SpinningDisc>()) {
    const std::vector<Term>& terms = disc.element.axis.terms;
    if (terms.size() != 1) continue;
    for (const BodyDraft& body : draft.bodies) {
      const int director = terms.front().triple - body.triple;
      if (director >= 1 && director <= 3)
        result.push_back({3 * Eigen::Index{body.triple}, 3 * Eigen::Index{terms.front().triple},
                          disc.element.speed.expression});
    }
  }
  return result;
}

/// How dependent constraints share the load: whether by least squares.
bool read_reactions(const Scene& scene) {
  const Value* value = scene.root.find("reactions");
  if (value == nullptr) return false;
  const auto* how = std::get_if<std::string>(&value->data);
  if (how == nullptr || *how != "least squares")
    throw scene_error(scene, value->where,
                      "reactions: expected \"least squares\", found " +
                          (how == nullptr ? value->kind() : '"' + *how + '"') +
                          "; leave it out unless constraints say the same twice");
  return true;
}

ModelDescription describe(const Draft& draft) {
  ModelDescription description;
  description.shares_reactions = read_reactions(draft.scene);
  const auto add = [&](const std::string& name, const char* unit,
                       const std::array<const char*, 3>& parts = {".x", ".y", ".z"}) {
    for (const char* part : parts) {
      description.coordinate_names.push_back(name + part);
      description.coordinate_units.emplace_back(unit);
    }
  };
  for (const std::string& point : draft.points) add(point, "m");
  for (const BodyDraft& body : draft.bodies) {
    add(body.name, "m");
    for (const char* director : {".x_axis", ".y_axis", ".z_axis"}) add(body.name + director, "1");
  }
  for (const std::string& inflow : draft.inflow_names) add(inflow, "m/s", {".mean", ".x", ".y"});
  description.data = draft.notes;
  for (std::size_t i = 0; i < draft.masses.size(); ++i) {
    const MassDistribution& masses = draft.masses[i];
    description.masses.push_back(
        {draft.mass_names[i], masses.carriers[0].terms[0].triple, static_cast<Eigen::Index>(masses.size)});
  }
  for (const BeamDraft& beam : draft.beams) {
    const auto first =
        description.masses.begin() + static_cast<std::ptrdiff_t>(draft.points.size() + beam.first_body);
    std::for_each_n(first, beam.axis->nodes(), [&](MassCarrier& node) { node.name = beam.name; });
  }
  for (auto [names, of_states] : {std::pair(&description.coordinate_names, &draft.state_names),
                                  std::pair(&description.coordinate_units, &draft.state_units)})
    names->insert(names->end(), of_states->begin(), of_states->end());
  description.spins = spinning_axes(draft);
  description.constraint_names = draft.constraint_names;
  for (const TrimCondition& trim : draft.data.trims) description.trims.push_back({trim.parameter, trim.text});
  description.parameters = draft.data.parameters;
  draft.data.elements.for_each([&]<class Element>(const std::vector<Placed<Element>>& list, std::size_t) {
    Effect& effect = description.effects.emplace_back();
    effect.name = Element::name;
    effect.description = Element::description;
    effect.count = static_cast<int>(list.size());
    effect.contribution = Element::contribution;
    effect.states = number_of_states<Element>() * effect.count;
  });
  for (const ConstraintKind& kind : constraint_kinds()) {
    description.effects.push_back(
        {std::string(kind.name), std::string(kind.description), 0, Contribution{.constraint = true}});
  }
  for (const Constraint& constraint : draft.data.constraints)
    ++description.effects[Elements::kinds + static_cast<std::size_t>(constraint.kind)].count;
  return description;
}

std::unique_ptr<Model> read_into(Draft& draft) {
  const Scene& scene = draft.scene;
  read_points(draft);
  read_bodies(draft);
  read_beams(draft);
  read_blades(draft);
  if (draft.masses.empty()) {
    throw InputError(
        scene.path +
        ": a scene needs at least one [[point]], [[body]], [[beam]] or [[blade]], or a [matrix_family]");
  }
  draft.rotor = read_bladed_rotor(draft);
  check_without(draft);
  add_masses(draft);
  const auto rotation = read_field<RotatingFrame>(draft, "angular_velocity", "rad/s");
  const auto gravity = read_field<Gravity>(draft, "acceleration", "m/s^2");
  if (rotation && gravity) check_gravity(draft, *rotation, *gravity);
  read_constraints(draft);
  draft.data.elements.for_each([&]<class Element>(const std::vector<Placed<Element>>&, std::size_t) {
    if constexpr (has_own_table<Element>) read_elements<Element>(draft);
  });
  read_strips(draft, rotation);
  add_beam_sections(draft);
  read_beam_damping(draft);
  std::vector<InflowDraft> inflows = read_inflow(draft, rotation);
  read_air(draft, rotation, inflows);
  read_trims(draft, inflows);
  if (rotation && !draft.rotor && !tables(scene, "spinning_disc").empty()) {
    throw scene_error(scene, tables(scene, "spinning_disc")[0]->where,
                      "[[spinning_disc]]: not together with [frame]; in a rotating frame the gyroscopic "
                      "moments come from the inertia of the body itself");
  }
  std::vector<int> unused = unused_parameters(scene, draft.used);
  draft.data.parameters = draft.parameters();
  draft.data.n_triples = static_cast<int>(draft.guess.size()) / 3;
  draft.data.n_coordinates = static_cast<int>(draft.guess.size() + draft.state_names.size());
  ModelDescription description = describe(draft);
  description.unused_parameters = std::move(unused);
  if (rotation) description.rotation_axis = axis_of(draft, *rotation);
  if (draft.rotor) return make_bladed_rotor(draft, std::move(description), rotor_speed(draft, rotation));
  return std::make_unique<Multibody>(std::move(description), Assembly(std::move(draft.data)),
                                     std::move(draft.guess));
}

}  // namespace

std::unique_ptr<Model> read_multibody(const Scene& scene, const ModelRequest& request) {
  Draft draft(scene, request);
  try {
    return read_into(draft);
  } catch (const ExpressionError& error) {
    throw scene_error(scene, draft.begun_where, draft.begun + ": " + error.what());
  }
}

}  // namespace eigentrail
