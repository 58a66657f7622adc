// Parts of an element (one effect of the scene), and the interface through which it is evaluated.
//
// An element is a struct with
//   name, description, contribution        from these `explain` and the structure flags are derived
//   fields(self, visit)                    its data, listed once: scene keys, units, help; for those whose
//                                          tables have their own readers places and numbers alone
//   force(at)                              its force, written once for every scalar type; it is called with
//                                          Recorded scalars, once for every element (record/recorded.hpp)
//   states                                 optional: unknowns of its own, of first order (see OwnState)
// The force acts on moving vectors: positions of points and places on bodies, and directions that rotate with
// bodies. All are linear in the coordinates. Differentiation therefore takes three directions per vector,
// independent of the number of coordinates that form it. A new effect needs one file in elements/ and one
// line in registry.hpp.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "eigentrail/model/model.hpp"

namespace eigentrail {

template <class Scalar>
using Vec3 = Eigen::Matrix<Scalar, 3, 1>;

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

/// A vector divided by its length.
template <class Scalar>
Vec3<Scalar> unit(const Vec3<Scalar>& vector) {
  return (1.0 / vector.norm()) * vector;
}

/// Allowed values of a quantity. For a vector, positive means of nonzero length.
enum class Range { any, non_negative, positive };

/// Entry of a quantity in the list of fields of an element.
struct QuantityField {
  std::string_view key;
  std::string_view unit;
  std::string_view help;
  Range range = Range::any;
  std::optional<double> otherwise = std::nullopt;  ///< default value; absent: the key is required
};

/// A moving vector while the force of its element is called.
template <class Scalar>
struct MovingVector {
  Vec3<Scalar> position, velocity, acceleration;
  Vec3<Scalar> force = Vec3<Scalar>::Zero();
};

/// A state of an element, likewise.
template <class Scalar>
struct MovingState {
  Scalar value, rate;
  Scalar force = Scalar(0.0);
};

/// Input and output of an element during one call of its force.
template <class Scalar>
class ElementView {
 public:
  /// `number` gives a quantity by its slot. The moving vectors and states are those of the element in order.
  ElementView(std::function<Scalar(int slot)> number, std::vector<MovingVector<Scalar>> vectors,
              std::vector<MovingState<Scalar>> states = {})
      : number_(std::move(number)), vectors_(std::move(vectors)), states_(std::move(states)) {}

  Scalar value(const Quantity& quantity) const { return number_(quantity.slot); }

  Vec3<Scalar> value(const std::array<Quantity, 3>& vector) const {
    return {value(vector[0]), value(vector[1]), value(vector[2])};
  }

  /// Position in the frame, m; for a direction its components.
  Vec3<Scalar> position(const Place& place) const {
    return place.argument < 0 ? value(place.fixed) : moving(place).position;
  }

  /// Velocity relative to the frame, m/s. Its value is zero at the steady state; it serves as a direction of
  /// differentiation.
  Vec3<Scalar> velocity(const Place& place) const {
    return place.argument < 0 ? Vec3<Scalar>(Vec3<Scalar>::Zero()) : moving(place).velocity;
  }

  /// Acceleration relative to the frame, m/s^2; likewise zero.
  Vec3<Scalar> acceleration(const Place& place) const {
    return place.argument < 0 ? Vec3<Scalar>(Vec3<Scalar>::Zero()) : moving(place).acceleration;
  }

  /// Adds a force (N) at a place; without effect on a fixed place. At a direction, it is the generalized
  /// force (N m) that does work on changes of the direction.
  void add_force(const Place& place, const Vec3<Scalar>& force) {
    if (place.argument >= 0) vectors_[static_cast<std::size_t>(place.argument)].force += force;
  }

  /// Value and rate of a state of the element. The rate is zero at the steady state; it serves as a direction
  /// of differentiation.
  Scalar state(int i) const { return states_[static_cast<std::size_t>(i)].value; }
  Scalar state_rate(int i) const { return states_[static_cast<std::size_t>(i)].rate; }

  /// Adds to the right side of the equation of a state.
  void add_to_state(int i, const Scalar& value) { states_[static_cast<std::size_t>(i)].force += value; }

  /// What the force has added.
  const std::vector<MovingVector<Scalar>>& vectors() const { return vectors_; }
  const std::vector<MovingState<Scalar>>& states() const { return states_; }

 private:
  const MovingVector<Scalar>& moving(const Place& place) const {
    return vectors_[static_cast<std::size_t>(place.argument)];
  }

  std::function<Scalar(int slot)> number_;
  std::vector<MovingVector<Scalar>> vectors_;
  std::vector<MovingState<Scalar>> states_;
};

}  // namespace eigentrail
