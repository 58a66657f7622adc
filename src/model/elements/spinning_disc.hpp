// Gyroscopic moment of a spinning disc in a frame that does not spin. The spin is not a motion of the body
// that carries the disc, but the angular momentum h = polar_inertia speed rotates with the body's axis e.
#pragma once

#include "model/element.hpp"

namespace eigentrail {

/// Moment -h e' on the body; as a force on the direction e it is h (e x e').
struct SpinningDisc {
  static constexpr std::string_view name = "spinning_disc";
  static constexpr std::string_view description =
      "gyroscopic moment of a disc that spins about an axis of a body";
  static constexpr Contribution contribution{.gyroscopic = true};

  Place axis;
  Quantity polar_inertia, speed;

  static void fields(auto& self, auto& visit) {
    visit.direction("axis", self.axis, "axis of spin, a direction of the body that carries the disc");
    visit.quantity({"polar_inertia", "kg m^2", "moment of inertia about the axis", Range::non_negative},
                   self.polar_inertia);
    visit.quantity({"speed", "rad/s", "speed of spin"}, self.speed);
  }

  template <class Scalar>
  void force(ElementView<Scalar>& at) const {
    const Vec3<Scalar> e = at.position(axis);
    // Division by |e|^3 makes the moment on the body independent of the length of the axis.
    const Scalar size = e.norm();
    const Scalar momentum = at.value(polar_inertia) * at.value(speed) / (size * size * size);
    at.add_force(axis, momentum * e.cross(at.velocity(axis)));
  }
};

}  // namespace eigentrail
