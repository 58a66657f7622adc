// Bearing: forces between a point and its seat in two directions, linear in displacement and velocity, with
// unequal and cross-coupled coefficients (journal bearings, seals).
#pragma once

#include "model/element.hpp"

namespace eigentrail {

/// With the displacement components d = ((point - seat) . first, (point - seat) . second), first and second
/// scaled to unit length, the force components on the point are -K d - C d'. The directions are fixed in the
/// frame.
struct Bearing {
  static constexpr std::string_view name = "bearing";
  static constexpr std::string_view description =
      "bearing with 2 x 2 stiffness and damping matrices, cross-coupled where they are unsymmetric";
  static constexpr Contribution contribution{
      .conservative = true, .circulatory = true, .dissipative = true, .gyroscopic = true};

  Place point, seat;
  std::array<Quantity, 3> first, second;
  std::array<Quantity, 4> stiffness, damping;

  static void fields(auto& self, auto& visit) {
    visit.point("point", self.point, "the point it holds");
    visit.place("seat", self.seat, "where the point rests without force");
    visit.vector({"first", "", "first direction, of any length", Range::positive}, self.first);
    visit.vector({"second", "", "second direction, of any length", Range::positive}, self.second);
    visit.matrix({"stiffness", "N/m", "[[k11, k12], [k21, k22]]"}, self.stiffness);
    visit.matrix({"damping", "N s/m", "[[c11, c12], [c21, c22]]", Range::any, 0.0}, self.damping);
  }

  template <class Scalar>
  void force(ElementView<Scalar>& at) const {
    const std::array<Vec3<Scalar>, 2> axes = {unit(at.value(first)), unit(at.value(second))};
    const Vec3<Scalar> d = at.position(point) - at.position(seat);
    const Vec3<Scalar> rate = at.velocity(point) - at.velocity(seat);
    Vec3<Scalar> force = Vec3<Scalar>::Zero();
    for (std::size_t i = 0; i < 2; ++i) {
      for (std::size_t j = 0; j < 2; ++j) {
        const Scalar component = at.value(stiffness[2 * i + j]) * axes[j].dot(d) +
                                 at.value(damping[2 * i + j]) * axes[j].dot(rate);
        force -= component * axes[i];
      }
    }
    at.add_force(point, force);
    at.add_force(seat, -force);
  }
};

}  // namespace eigentrail
