// Parts of an element (one effect of the scene), and the interface through which it is evaluated.
//
// An element is a struct with
//   name, description, contribution        from these `explain` and the structure flags are derived
//   depends                                which of position, velocity, acceleration the force depends on
//   fields(self, visit)                    its data, listed once: scene keys, units, roles, help
//   force(at)                              its force, written once for every scalar type
//   states                                 optional: unknowns of its own, of first order (see OwnState)
// The force acts on moving vectors: positions of points and places on bodies, and directions that rotate with
// bodies. All are linear in the coordinates. Differentiation therefore takes three directions per vector,
// independent of the number of coordinates that form it. A new effect needs one file in elements/ and one
// line in registry.hpp.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "eigentrail/core/series.hpp"
#include "eigentrail/model/model.hpp"

namespace eigentrail {

template <class Scalar>
using Vec3 = Eigen::Matrix<Scalar, 3, 1>;

/// Largest number of moving vectors of one element.
inline constexpr int max_arguments = 7;

/// A number that may depend on the parameters. `slot` is its index in the table of values of an evaluation.
struct Quantity {
  Expression expression;
  int slot = -1;
};

/// One term of a moving vector: a weight times a triple of coordinates. A weight without slot is one.
struct Term {
  int triple = -1;
  Quantity weight;
};

/// A vector of the scene: fixed in the frame, or moving with a point or a body. The position of a point is
/// its triple; a place on a body is origin + sum a_i director_i; a direction on a body is sum b_i director_i.
/// All are linear in the coordinates.
struct Place {
  std::vector<Term> terms;  ///< empty if the vector is fixed
  std::array<Quantity, 3> fixed;
  int argument = -1;  ///< index into the moving vectors of its element; -1 if fixed

  bool moves() const { return !terms.empty(); }
};

/// A coordinate axis: 0 x, 1 y, 2 z.
struct Axis {
  int index = 0;
};

/// Where a quantity enters the equations; determines what is constant along a path.
struct Enters {
  bool mass = false;
  bool damping = false;
  bool force = false;       ///< steady force, and therefore the stiffness
  bool constraint = false;  ///< c, and therefore A
};
inline constexpr Enters enters_mass{.mass = true};
inline constexpr Enters enters_damping{.damping = true};
inline constexpr Enters enters_force{.force = true};
inline constexpr Enters enters_damping_and_force{.damping = true, .force = true};
inline constexpr Enters enters_constraint{.constraint = true};

/// An unknown u that belongs to an element, of first order: elongation of a dashpot, lag of the air. An
/// element lists them in `static constexpr std::array states`. Its force() reads at.state(i) and
/// at.state_rate(i), and adds with at.add_to_state(i, r) the right side of the equation 0 = r(x, u, u') of
/// that state. The state has no mass, so u'' must not occur. In K, C and the pencil it is a coordinate
/// without mass: it adds one eigenvalue. r must depend on u' (else the eigenvalue is infinite); if r is the
/// force that does work on u, K and C stay symmetric. At the starting guess, u solves r = 0 by Newton's
/// method, at once if r is linear in u.
struct OwnState {
  std::string_view name;  ///< of the coordinate: "dashpot" gives "maxwell_damper 1.dashpot"
  std::string_view unit;
  std::string_view help;  ///< what it is, in a few words
};

/// Number of states of its own that an element has.
template <class Element>
constexpr int number_of_states() {
  if constexpr (requires { Element::states; }) {
    return static_cast<int>(Element::states.size());
  } else {
    return 0;
  }
}

/// Allowed values of a quantity. For a vector, positive means of nonzero length.
enum class Range { any, non_negative, positive };

/// Entry of a quantity in the list of fields of an element.
struct QuantityField {
  std::string_view key;
  std::string_view unit;
  Enters enters;
  std::string_view help;
  Range range = Range::any;
  std::optional<double> otherwise = std::nullopt;  ///< default value; absent: the key is required
};

/// Kinematic quantities on which a force depends. It is differentiated only with respect to these, and to
/// the states of the element and their rates.
struct Dependence {
  bool position = false;
  bool velocity = false;
  bool acceleration = false;
  bool turning = false;       ///< C depends on positions and thus changes with the equilibrium
  bool turning_mass = false;  ///< likewise M
};

enum class Motion { position, velocity, acceleration };

/// A direction of differentiation: a component of the position, velocity or acceleration of a moving vector.
/// After the components of all moving vectors come the states of the element.
struct Seed {
  Motion motion = Motion::position;
  int component = -1;  ///< 3 * argument + axis, or 3 * (number of arguments) + state; -1: none
};

namespace detail {

/// The series along the path on which a scalar with a derivative is built.
template <class Scalar>
struct BaseOf {
  using type = Scalar;
};
template <class Real, int Q>
struct BaseOf<Series<Series<Real, Q>, 1>> {
  using type = Series<Real, Q>;
};

}  // namespace detail

/// Power series along the path of all data of an evaluation.
template <class Base>
struct PathValues {
  std::vector<Vec3<Base>> triples;  ///< coordinates of points and bodies
  std::vector<Base> states;         ///< states of elements; their coordinates follow the triples
  std::vector<Base> lambda;         ///< multipliers
  std::vector<Base> values;         ///< quantities, by slot
  std::vector<bool> constant;       ///< whether they do not change along the path, by slot

  Vec3<Base> vector(const std::array<Quantity, 3>& v) const {
    return {values[v[0].slot], values[v[1].slot], values[v[2].slot]};
  }

  Vec3<Base> vector(const Place& place) const {
    if (!place.moves()) return vector(place.fixed);
    Vec3<Base> sum = Vec3<Base>::Zero();
    for (const Term& term : place.terms) sum += times(term.weight, triples[term.triple]);
    return sum;
  }

  /// weight * value; a weight without slot is one. Most weights are constant, and a product with a number is
  /// cheaper than one of series.
  template <class Value>
  Value times(const Quantity& weight, const Value& value) const {
    if (weight.slot < 0) return value;
    const auto slot = static_cast<std::size_t>(weight.slot);
    if constexpr (std::is_same_v<typename Base::Coefficient, double>) {
      if (constant[slot]) return values[slot][0] * value;
    }
    return values[slot] * value;
  }
};

/// Input and output of an element during one evaluation. Scalar is Series<Real, Q> (values along the path),
/// or a series of it of order 1: with the derivative in direction `seed`.
template <class Scalar>
class ElementView {
 public:
  using Base = typename detail::BaseOf<Scalar>::type;

  /// `arguments` are the positions of the moving vectors of the element, `states` its states. Their equations
  /// are added to `state_force`, of the same size and zero at first.
  ElementView(const PathValues<Base>& path, std::span<const Vec3<Base>> arguments, Seed seed = {},
              std::span<const Base> states = {}, std::span<Scalar> state_force = {})
      : path_(path), arguments_(arguments), seed_(seed), states_(states), state_force_(state_force) {
    for (std::size_t i = 0; i < arguments.size(); ++i) force_[i].setZero();
  }

  Scalar value(const Quantity& quantity) const { return Scalar(path_.values[quantity.slot]); }

  Vec3<Scalar> value(const std::array<Quantity, 3>& vector) const {
    return {value(vector[0]), value(vector[1]), value(vector[2])};
  }

  /// Position in the frame, m; for a direction its components.
  Vec3<Scalar> position(const Place& place) const {
    if (place.argument < 0) return value(place.fixed);
    const Vec3<Base>& at = arguments_[static_cast<std::size_t>(place.argument)];
    return {seeded(at[0], Motion::position, place, 0), seeded(at[1], Motion::position, place, 1),
            seeded(at[2], Motion::position, place, 2)};
  }

  /// Velocity relative to the frame, m/s. Its value is zero at the steady state; it serves as a direction of
  /// differentiation.
  Vec3<Scalar> velocity(const Place& place) const { return rate(place, Motion::velocity); }

  /// Acceleration relative to the frame, m/s^2; likewise zero.
  Vec3<Scalar> acceleration(const Place& place) const { return rate(place, Motion::acceleration); }

  /// Adds a force (N) at a place; without effect on a fixed place. At a direction, it is the generalized
  /// force (N m) that does work on changes of the direction.
  void add_force(const Place& place, const Vec3<Scalar>& force) {
    if (place.argument >= 0) force_[static_cast<std::size_t>(place.argument)] += force;
  }

  /// Value and rate of a state of the element. The rate is zero at the steady state; it serves as a direction
  /// of differentiation.
  Scalar state(int i) const { return seeded(states_[static_cast<std::size_t>(i)], Motion::position, row(i)); }
  Scalar state_rate(int i) const { return seeded(Base(), Motion::velocity, row(i)); }

  /// Adds to the right side of the equation of a state.
  void add_to_state(int i, const Scalar& value) { state_force_[static_cast<std::size_t>(i)] += value; }

  const Vec3<Scalar>& force(std::size_t argument) const { return force_[argument]; }

  /// The force by component, numbered as in Seed.
  const Scalar& component(int i) const {
    const int of_vectors = 3 * static_cast<int>(arguments_.size());
    if (i < of_vectors) return force_[static_cast<std::size_t>(i / 3)][i % 3];
    return state_force_[static_cast<std::size_t>(i - of_vectors)];
  }

 private:
  Scalar seeded(const Base& base, Motion motion, const Place& place, int axis) const {
    return seeded(base, motion, 3 * place.argument + axis);
  }

  Scalar seeded(const Base& base, Motion motion, int component) const {
    Scalar result(base);
    if constexpr (!std::is_same_v<Scalar, Base>) {
      if (seed_.motion == motion && seed_.component == component) result[1] = Base(1.0);
    }
    return result;
  }

  /// Component of a state.
  int row(int state) const { return 3 * static_cast<int>(arguments_.size()) + state; }

  Vec3<Scalar> rate(const Place& place, Motion motion) const {
    if (place.argument < 0) return Vec3<Scalar>::Zero();
    return {seeded(Base(), motion, place, 0), seeded(Base(), motion, place, 1),
            seeded(Base(), motion, place, 2)};
  }

  const PathValues<Base>& path_;
  std::span<const Vec3<Base>> arguments_;
  Seed seed_;
  std::span<const Base> states_;
  std::span<Scalar> state_force_;
  std::array<Vec3<Scalar>, max_arguments> force_;
};

}  // namespace eigentrail
