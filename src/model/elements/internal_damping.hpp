// Internal damping of a rotating shaft in a frame that does not rotate. The damping acts on velocities
// relative to the shaft, which rotates with speed w about the axis e: f = -c (d' - w e x d) with
// d = point - about. The second term is circulatory and makes the shaft unstable at high speed.
#pragma once

#include "model/element.hpp"

namespace eigentrail {

struct InternalDamping {
  static constexpr std::string_view name = "internal_damping";
  static constexpr std::string_view description = "damping within a rotating shaft";
  static constexpr Contribution contribution{.circulatory = true, .dissipative = true};

  Place point, about;
  std::array<Quantity, 3> axis;
  Quantity coefficient, speed;

  static void fields(auto& self, auto& visit) {
    visit.point("point", self.point, "a point of the shaft");
    visit.place("about", self.about, "where it would be on the straight shaft");
    visit.vector({"axis", "", "axis of rotation, of any length", Range::positive}, self.axis);
    visit.quantity({"coefficient", "N s/m", "force per velocity in the shaft"}, self.coefficient);
    visit.quantity({"speed", "rad/s", "speed of the shaft"}, self.speed);
  }

  template <class Scalar>
  void force(ElementView<Scalar>& at) const {
    const Vec3<Scalar> e = unit(at.value(axis));
    const Vec3<Scalar> d = at.position(point) - at.position(about);
    const Vec3<Scalar> rate = at.velocity(point) - at.velocity(about) - at.value(speed) * e.cross(d);
    // Only the components normal to the axis: a shaft is stiff along its axis.
    const Vec3<Scalar> across = rate - e.dot(rate) * e;
    const Vec3<Scalar> force = -at.value(coefficient) * across;
    at.add_force(point, force);
    at.add_force(about, -force);
  }
};

}  // namespace eigentrail
