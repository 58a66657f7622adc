// The virtual motion of the load of a trim at a point of the path, and the work of forces on it.
#pragma once

#include <vector>

#include "model/trim.hpp"

namespace eigentrail {

template <class Base>
Vec3<Base> triple_of(const std::vector<Base>& coordinates, int triple) {
  const auto first = 3 * static_cast<std::size_t>(triple);
  return {coordinates[first], coordinates[first + 1], coordinates[first + 2]};
}

/// The virtual motion of a load at a point of the path.
template <class Base>
class MovedTriples {
 public:
  MovedTriples(const VirtualMotion& motion, const PathValues<Base>& values)
      : axis_(values.vector(motion.axis)) {
    const bool turns = motion.about.has_value();
    const Vec3<Base> centre = turns ? values.vector(*motion.about) : Vec3<Base>(Vec3<Base>::Zero());
    const auto add = [&](int triple, const Vec3<Base>& arm) {
      moved_.push_back({triple, arm, turns ? Vec3<Base>(axis_.cross(arm)) : axis_});
    };
    for (const int triple : motion.places)
      add(triple, values.triples[static_cast<std::size_t>(triple)] - centre);
    if (!turns) return;
    for (const int triple : motion.directions) add(triple, values.triples[static_cast<std::size_t>(triple)]);
  }

  /// Calls visit(triple, w).
  template <class Visit>
  void for_each(Visit visit) const {
    for (const Moved& moved : moved_) visit(moved.triple, moved.w);
  }

  /// Adds the derivative of the work of constant forces on w: that of e by the arm, and that of the arm.
  void add_gradient(const VirtualMotion& motion, const PathValues<Base>& values, const Vector& force,
                    Vector& of_x) const {
    const auto add = [&of_x, &values](const Term& term, const Eigen::Vector3d& gradient) {
      for (int i = 0; i < 3; ++i)
        of_x[3 * term.triple + i] += values.times(term.weight, Base(gradient[i]))[0];
    };
    const auto number = [](const Vec3<Base>& v) { return Eigen::Vector3d(v[0][0], v[1][0], v[2][0]); };
    const Eigen::Vector3d axis = number(axis_);
    for (std::size_t j = 0; j < moved_.size(); ++j) {
      const Moved& moved = moved_[j];
      const Eigen::Vector3d f = force.segment<3>(3 * moved.triple);
      const Eigen::Vector3d of_axis = motion.about ? Eigen::Vector3d(number(moved.arm).cross(f)) : f;
      for (const Term& term : motion.axis.terms) add(term, of_axis);
      if (!motion.about) continue;
      const Eigen::Vector3d of_arm = f.cross(axis);
      add({moved.triple, {}}, of_arm);
      if (j >= motion.places.size()) continue;
      for (const Term& term : motion.about->terms) add(term, -of_arm);
    }
  }

 private:
  struct Moved {
    int triple;
    Vec3<Base> arm, w;
  };
  Vec3<Base> axis_;
  std::vector<Moved> moved_;  ///< those of places come first
};

}  // namespace eigentrail
