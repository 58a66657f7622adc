// The virtual motion of the load of a trim at a point of the path, and the work of forces on it.
#pragma once

#include <vector>

#include "model/path_values.hpp"
#include "model/trim.hpp"

namespace eigentrail {

/// The virtual motion of a load at a point of the path.
template <class Base>
class MovedTriples {
 public:
  using Values = PathValues<typename Base::Coefficient>;

  MovedTriples(const VirtualMotion& motion, const Values& values) : axis_(values.vector(motion.axis)) {
    const bool turns = motion.about.has_value();
    const Vec3<Base> centre = turns ? values.vector(*motion.about) : Vec3<Base>(Vec3<Base>::Zero());
    const auto add = [&](int triple, const Vec3<Base>& arm) {
      moved_.push_back({triple, arm, turns ? Vec3<Base>(axis_.cross(arm)) : axis_});
    };
    for (const int triple : motion.places) add(triple, values.triple(triple) - centre);
    if (!turns) return;
    for (const int triple : motion.directions) add(triple, values.triple(triple));
  }

  /// Calls visit(triple, w).
  template <class Visit>
  void for_each(Visit visit) const {
    for (const Moved& moved : moved_) visit(moved.triple, moved.w);
  }

  /// Adds the derivative of the work of constant forces on w: that of e by the arm, and that of the arm.
  void add_gradient(const VirtualMotion& motion, const Values& values, const Vector& force,
                    Vector& of_x) const {
    const auto add = [&of_x, &values](const Term& term, const Eigen::Vector3d& gradient) {
      const double weight = term.weight.slot < 0 ? 1.0 : values.number(term.weight.slot)[0];
      of_x.segment<3>(3 * term.triple) += weight * gradient;
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
