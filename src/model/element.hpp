// What an element (one effect of the scene) is made of, and what it sees when it is evaluated.
//
// An element is a struct with
//   name, description, contribution        facts that `explain` and the structure flags are derived from
//   depends                                which of position, velocity, acceleration its force uses
//   fields(self, visit)                    its data, listed once: scene keys, units, roles, help
//   force(at)        and / or              its physics, written once for every scalar
//   constraint(at), constraint_count, curved   (curved: A depends on x)
// Adding an effect: one file in elements/ and one line in registry.hpp.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "eigentrail/core/series.hpp"
#include "eigentrail/model/model.hpp"

namespace eigentrail {

template <class Scalar>
using Vec3 = Eigen::Matrix<Scalar, 3, 1>;

/// Most moving points that one element may join.
inline constexpr int max_points_per_element = 4;

/// A number that may depend on the parameters; `slot` is its place in the table of values of an evaluation.
struct Quantity {
  Expression expression;
  int slot = -1;
};

/// A moving point of the scene (index >= 0) or a place that is fixed in the frame.
struct Place {
  int point = -1;
  std::array<Quantity, 3> fixed;
};

/// A coordinate direction: 0 x, 1 y, 2 z.
struct Axis {
  int index = 0;
};

/// Where a quantity enters the equations; decides what is constant along a path.
struct Enters {
  bool mass = false;
  bool damping = false;
  bool force = false;       ///< steady force, and with it the stiffness
  bool constraint = false;  ///< c, and with it A
};
inline constexpr Enters enters_mass{.mass = true};
inline constexpr Enters enters_damping{.damping = true};
inline constexpr Enters enters_force{.force = true};
inline constexpr Enters enters_damping_and_force{.damping = true, .force = true};
inline constexpr Enters enters_constraint{.constraint = true};

/// Values for which a quantity makes sense. Of a vector, positive means of non-zero length.
enum class Range { any, non_negative, positive };

/// A quantity's entry in an element's list of fields.
struct QuantityField {
  std::string_view key;
  std::string_view unit;
  Enters enters;
  std::string_view help;
  Range range = Range::any;
  std::optional<double> otherwise =
      std::nullopt;  ///< value when the scene is silent; absent: the key is required
};

/// Kinematic quantities a force depends on; the others are never differentiated.
struct Dependence {
  bool position = false;
  bool velocity = false;
  bool acceleration = false;
};

enum class Motion { position, velocity, acceleration };

/// One direction of differentiation: a coordinate's position, velocity or acceleration.
struct Seed {
  Motion motion = Motion::position;
  int coordinate = -1;  ///< -1: none
};

namespace detail {

template <class Scalar>
struct SeriesOf {
  using Base = typename SeriesOf<typename Scalar::Coefficient>::Base;
  static constexpr int depth = SeriesOf<typename Scalar::Coefficient>::depth + 1;
};
template <class Real, int Q>
requires(!is_series<Real>) struct SeriesOf<Series<Real, Q>> {
  using Base = Series<Real, Q>;
  static constexpr int depth = 0;
};

}  // namespace detail

/// Series along the path that an evaluation starts from.
template <class Base>
struct PathValues {
  std::vector<Base> x;       ///< coordinates
  std::vector<Base> lambda;  ///< multipliers
  std::vector<Base> values;  ///< quantities, by slot
};

/// What an element sees and writes to during one evaluation. Scalar is Series<Real, Q> (values along the
/// path), or that nested once (with the derivative in direction `seeds[0]`) or twice (`seeds[0]` and
/// `seeds[1]`).
template <class Scalar>
class ElementView {
 public:
  using Base = typename detail::SeriesOf<Scalar>::Base;
  static constexpr int depth = detail::SeriesOf<Scalar>::depth;

  ElementView(const PathValues<Base>& path, std::span<const int> points, std::span<const Base> lambda,
              std::array<Seed, 2> seeds = {})
      : path_(path), points_(points), lambda_(lambda), seeds_(seeds) {
    for (std::size_t i = 0; i < points.size(); ++i) force_[i].setZero();
  }

  Scalar value(const Quantity& quantity) const { return Scalar(path_.values[quantity.slot]); }

  Vec3<Scalar> value(const std::array<Quantity, 3>& vector) const {
    return {value(vector[0]), value(vector[1]), value(vector[2])};
  }

  /// Position in the frame, m.
  Vec3<Scalar> position(const Place& place) const {
    if (place.point < 0) return value(place.fixed);
    return {coordinate(place, 0), coordinate(place, 1), coordinate(place, 2)};
  }

  /// Velocity relative to the frame, m/s: zero at the steady state, present as a direction of
  /// differentiation.
  Vec3<Scalar> velocity(const Place& place) const { return rate(place, Motion::velocity); }

  /// Acceleration relative to the frame, m/s^2: likewise.
  Vec3<Scalar> acceleration(const Place& place) const { return rate(place, Motion::acceleration); }

  /// Adds a force, N, on a place; on a fixed place it does nothing.
  void add_force(const Place& place, const Vec3<Scalar>& force) {
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (points_[i] == place.point) force_[i] += force;
    }
  }

  /// Sets constraint row `row` (0 <= row < constraint_count) to c.
  void set_constraint(int row, const Scalar& c) {
    constraint_[row] = c;
    lagrangian_ += Scalar(lambda_[row]) * c;
  }

  const Vec3<Scalar>& force(std::size_t point) const { return force_[point]; }  ///< index into `points`
  const Scalar& constraint(int row) const { return constraint_[row]; }
  const Scalar& lagrangian() const { return lagrangian_; }  ///< sum over rows of lambda c

 private:
  Scalar seeded(const Base& base, Motion motion, int coordinate) const {
    Scalar result(base);
    const auto is = [&](const Seed& seed) { return seed.coordinate == coordinate && seed.motion == motion; };
    if constexpr (depth == 1) {
      if (is(seeds_[0])) result[1] = Base(1.0);
    } else if constexpr (depth == 2) {
      if (is(seeds_[0])) result[0][1] = Base(1.0);
      if (is(seeds_[1])) result[1] = typename Scalar::Coefficient(1.0);
    }
    return result;
  }

  Scalar coordinate(const Place& place, int axis) const {
    const int i = 3 * place.point + axis;
    return seeded(path_.x[i], Motion::position, i);
  }

  Vec3<Scalar> rate(const Place& place, Motion motion) const {
    if (place.point < 0) return Vec3<Scalar>::Zero();
    const int i = 3 * place.point;
    return {seeded(Base(), motion, i), seeded(Base(), motion, i + 1), seeded(Base(), motion, i + 2)};
  }

  const PathValues<Base>& path_;
  std::span<const int> points_;
  std::span<const Base> lambda_;
  std::array<Seed, 2> seeds_;
  std::array<Vec3<Scalar>, max_points_per_element> force_;
  std::array<Scalar, 3> constraint_;
  Scalar lagrangian_;
};

}  // namespace eigentrail
