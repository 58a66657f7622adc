// Intermediate data of reading a multibody scene, and the places and names to which its tables may refer.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>

#include "eigentrail/model/build.hpp"
#include "model/expression_vector.hpp"
#include "model/multibody_data.hpp"

namespace eigentrail {

/// A body as the scene describes it.
struct BodyDraft {
  std::string name;
  int triple = 0;             ///< index of the coordinate triple of the origin; those of the directors follow
  ExpressionVector position;  ///< of the origin, starting guess
  ExpressionRotation rotation;                      ///< starting guess
  std::map<std::string, ExpressionVector> markers;  ///< in body axes
};

struct BeamAxis;

/// A beam: its nodes, which are bodies, and its quadrature points in the order of the elements.
struct BeamDraft {
  std::string name;
  /// Damping of the beam's own: times by strain, s. Empty: none.
  std::vector<Expression> damping_times = {};
  std::size_t first_body = 0;                      ///< its nodes are bodies from this index on
  std::shared_ptr<const BeamAxis> axis = nullptr;  ///< nodes and elements before it is loaded
  std::vector<BeamSection> sections = {};
};

/// What a scene says of a rotor of equal blades: [rotor].
struct BladedRotorDraft {
  int blades = 0;
  int hub = 0;               ///< index of Draft::bodies
  std::vector<bool> stands;  ///< by triple: of the support or the hub, in the frame that stands
  /// Of the velocities of inflows, whose triples follow: 1 if the axis is that of rotation, -1 if it is
  /// opposite.
  std::vector<int> inflows;
  SourceLocation where;
};

/// What a place or direction moves with: a body, a point, or neither (the frame).
struct Carrier {
  int body = -1;
  int point = -1;

  friend bool operator==(const Carrier&, const Carrier&) = default;

  bool is_frame() const { return body < 0 && point < 0; }
};

/// Sum of weights times triples of coordinates: a moving vector before it is a Place.
using Combination = std::vector<std::pair<int, Expression>>;

/// What a joint can do: its angles, and the displacement along its axis as the places axis, from and to.
struct JointMotions {
  std::vector<HingeAngle> angles, slides;
  Carrier from = {}, to = {};  ///< of a joint with one angle: what its two sides move with
};

struct Draft {
  Draft(const Scene& of, const ModelRequest& asked);

  const Scene& scene;
  const ModelRequest& request;
  std::vector<Vector> check_at;  ///< SI values of the parameters at the points that the request lists
  std::set<int> used;
  /// Label of the table that is being read; used in messages about expressions formed from it.
  std::string begun;
  SourceLocation begun_where;  ///< position of this table
  std::size_t operations = 0;  ///< number of operations in all quantities
  MultibodyData data;
  std::optional<BladedRotorDraft> rotor;  ///< [rotor], if the scene has one
  std::vector<std::string> points;        ///< points by triple; the bodies follow them
  std::vector<BodyDraft> bodies;
  std::vector<BeamDraft> beams;
  std::vector<MassDistribution> masses;  ///< of points and bodies, in the order of mass_names
  std::vector<std::string> mass_names;
  std::vector<Expression> guess;         ///< starting guess, one per coordinate of points and bodies
  std::vector<std::string> state_names;  ///< coordinates of the states of elements, and their units
  std::vector<std::string> state_units;
  std::vector<std::string> inflow_names;                   ///< their triples follow those of the bodies
  std::vector<std::pair<std::string, std::string>> notes;  ///< ModelDescription::data
  std::vector<std::string> constraint_names;
  std::set<std::string> constraint_labels;
  std::map<std::string, JointMotions> joints;  ///< by label
  /// By effect, in the order of their parameters; empty unless requested.
  std::vector<std::pair<std::string, Quantity>> strengths;

  TableReader reader(const Table& table, const std::string& label);
  /// Calls read(table, i) for every table [[kind]] of the scene, i its index from 0.
  void for_each_table(std::string_view kind, auto read) {
    const std::vector<const Table*> all = tables(scene, std::string(kind));
    for (std::size_t i = 0; i < all.size(); ++i) {
      TableReader table = reader(*all[i], "[[" + std::string(kind) + "]] " + std::to_string(i + 1));
      read(table, i);
    }
  }

  Quantity quantity(const Expression& expression);
  /// The same, but without slot if it is zero for all values of the parameters.
  Quantity quantity_unless_zero(const Expression& expression) {
    return is_number(expression, 0.0) ? Quantity() : quantity(expression);
  }
  /// Whether an effect is switched off (--without).
  bool is_left_out(std::string_view effect) const;
  /// The quantity that multiplies the forces of an effect; without slot if strengths are not requested.
  Quantity strength(const std::string& effect);
  /// The parameters of the scene and those of the strengths.
  Parameters parameters() const;
  std::array<Quantity, 3> vector(const ExpressionVector& e) {
    return {quantity(e[0]), quantity(e[1]), quantity(e[2])};
  }

  // Places and directions. On return, `carrier` (if given) is what they move with.

  Place point_place(int point) const { return {{{point, {}}}, {}, -1}; }
  Place fixed_place(const ExpressionVector& at) { return {{}, vector(at), -1}; }
  Place place_of(const Combination& combination);
  /// The directors of a body times the components of a direction in its axes.
  Combination on_directors(int body, const ExpressionVector& along) const;
  /// The place with coordinates `at` in the axes of a body.
  Place on_body(int body, const ExpressionVector& at);
  /// The direction with components `along` in the axes of the carrier.
  Place direction_on(const Carrier& carrier, const ExpressionVector& along) {
    return carrier.body < 0 ? fixed_place(along) : place_of(on_directors(carrier.body, along));
  }
  std::array<Place, 3> directors(int body) const;
  /// Components of a place or a direction in the frame, at the starting guess.
  ExpressionVector at_guess(const Place& place) const;
  /// Whether what has this triple does not turn with the frame, because it is the hub, the support or the
  /// inflow of a rotor.
  bool stands(int triple) const {
    const auto i = static_cast<std::size_t>(triple);
    return rotor && (i >= rotor->stands.size() || rotor->stands[i]);
  }

  /// Reads a name ("blade", "blade.tip"), a fixed place [x, y, z], or { body = "blade", at = [x, y, z] }.
  Place read_place(TableReader& table, const std::string& key, Carrier* carrier = nullptr);
  /// The same without fixed places.
  Place read_moving_place(TableReader& table, const std::string& key);
  /// Reads a direction [x, y, z] of the frame, an axis "blade.x" of a body, or
  /// { body = "blade", along = [x, y, z] }. Returns the components of its unit vector in the axes of its
  /// carrier.
  ExpressionVector read_direction(TableReader& table, const std::string& key, Carrier& carrier);
  int read_body(TableReader& table, const std::string& key);
  /// Labels of the joints that have angles, at most so many.
  std::vector<std::string> joints_with_angles(std::size_t most) const;

  /// Components in the frame, at the starting guess, of a direction given in the axes of a carrier; and the
  /// reverse.
  ExpressionVector in_frame(const Carrier& carrier, const ExpressionVector& along) const {
    return carrier.body < 0 ? along : turned(bodies[static_cast<std::size_t>(carrier.body)].rotation, along);
  }
  ExpressionVector in_axes_of(const Carrier& carrier, const ExpressionVector& along) const {
    return carrier.body < 0 ? along
                            : turned_back(bodies[static_cast<std::size_t>(carrier.body)].rotation, along);
  }

  /// Adds the rows of a constraint; `label` names its multipliers.
  void add_constraint(std::string_view kind, const std::string& label, std::vector<ConstraintRow> rows);

  // Numbers and vectors whose dimensions and values are checked. `otherwise` is the default value; without it
  // the key is required.

  Expression read_number(TableReader& table, const std::string& key, WantedUnit unit, Range range,
                         std::optional<double> otherwise = std::nullopt) const;
  ExpressionVector read_vector(TableReader& table, const std::string& key, WantedUnit unit, Range range,
                               std::optional<ExpressionVector> otherwise = std::nullopt) const;
  /// Reads a starting position. It only has to be finite where the trace begins.
  ExpressionVector read_guess(TableReader& table, const std::string& key) const;

  // Checks at the points of the trace that the request lists.

  std::vector<double> check_values(const Expression& expression) const;
  void check_range(const TableReader& reader, const std::string& key, const Expression& expression,
                   Range range) const;
  /// All components must be finite; the length must not be zero unless `range` is Range::any.
  void check_range(const TableReader& reader, const std::string& key, const ExpressionVector& vector,
                   Range range) const;
  /// Throws InputError about a key, "message where ...", unless holds(i) for all of these points.
  void require(const TableReader& reader, const std::string& key, const std::string& message,
               auto holds) const {
    for (std::size_t i = 0; i < check_at.size(); ++i) {
      if (!holds(i)) reader.fail(key, message + where_on_trace(i));
    }
  }
  Eigen::Vector3d vector_at(const ExpressionVector& v, std::size_t i) const {
    return {v[0].value(check_at[i]), v[1].value(check_at[i]), v[2].value(check_at[i])};
  }
  /// Whether the sine of the angle between two vectors is at most `sine` at one of the points.
  bool are_parallel(const ExpressionVector& a, const ExpressionVector& b, double sine, std::size_t i) const {
    const Eigen::Vector3d u = vector_at(a, i), v = vector_at(b, i);
    return u.cross(v).norm() <= sine * u.norm() * v.norm();
  }
  static std::string where_on_trace(std::size_t i);

 private:
  std::vector<std::string> place_names() const;
  Place named_place(TableReader& table, const std::string& key, const std::string& name,
                    Carrier* carrier = nullptr);
};

/// The names of a list, or another of their texts.
template <class Named>
std::vector<std::string> names_of(const std::vector<Named>& all, std::string Named::*name = &Named::name) {
  std::vector<std::string> names;
  for (const Named& one : all) names.push_back(one.*name);
  return names;
}

/// Index of a name among those that are known. Throws InputError about the key of a table if there is none:
/// no `what` is called so.
std::size_t index_of(const std::string& name, const std::vector<std::string>& known, const TableReader& table,
                     const std::string& key, const std::string& what);

/// Refuses the name of a table if it is taken: another `what` is called so.
void check_is_new(const TableReader& table, const std::string& what, const std::string& name,
                  const std::vector<std::string>& taken);

/// The key `name` of a table, which must not be empty or taken.
std::string read_name(TableReader& table, const std::string& what, const std::vector<std::string>& taken);

/// A name for the table with index i of a kind: "spring 2" for i = 1.
std::string numbered(std::string_view name, std::size_t index);
/// What the scene calls a table: its key `name`, or the number among its kind.
std::string label_of(TableReader& table, std::string_view kind, std::size_t index);

/// Directions may be of any length, in any unit.
inline constexpr WantedUnit any_unit = std::nullopt;

/// Mass of a body and its moments about the origin, as MassDistribution has them.
struct BodyMoments {
  Expression mass;
  std::array<Expression, 3> first;
  std::array<Expression, 6> second;
};

/// Adds a body, whose triples follow those before it, with its mass and with the six constraints on the
/// products of its directors, unit vectors at right angles.
void add_body(Draft& draft, BodyDraft body, const BodyMoments& moments);

/// Read the [[body]] tables (read_bodies.cpp) and the tables of all constraints (read_constraints.cpp).
void read_bodies(Draft& draft);
void read_constraints(Draft& draft);

/// A kind of constraint with its keys. The counters of a run are in the order of constraint_kinds().
struct ConstraintKind {
  std::string_view name;
  std::string_view description;
  std::vector<FieldHelp> fields;
  std::vector<ConstraintRow> (*read)(Draft& draft, TableReader& table, JointMotions& motions);
};
const std::vector<ConstraintKind>& constraint_kinds();

}  // namespace eigentrail
