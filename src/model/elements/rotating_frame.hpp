// Steadily rotating frame: centrifugal and Coriolis forces on a point mass,
// f = -m (w x (w x p) + 2 w x v)   (seed paper, Eqs. 136, 138; the sign of 139 is a misprint).
#pragma once

#include "model/element.hpp"

namespace eigentrail {

struct RotatingFrame {
  static constexpr std::string_view name = "frame";
  static constexpr std::string_view description =
      "steadily rotating frame: centrifugal and Coriolis forces on every mass";
  static constexpr Contribution contribution{.conservative = true, .gyroscopic = true};
  static constexpr Dependence depends{.position = true, .velocity = true};

  Place point;
  Quantity mass;
  std::array<Quantity, 3> angular_velocity;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit.point("point", self.point, "every point with mass");
    visit.quantity({"mass", "kg", enters_damping_and_force, "mass of the point", Range::non_negative},
                   self.mass);
    visit.vector({"angular_velocity", "rad/s", enters_damping_and_force,
                  "angular velocity of the frame, about an axis through the origin"},
                 self.angular_velocity);
  }

  template <class Scalar>
  void force(ElementView<Scalar>& at) const {
    const Vec3<Scalar> w = at.value(angular_velocity);
    const Vec3<Scalar> p = at.position(point);
    const Vec3<Scalar> v = at.velocity(point);
    const Vec3<Scalar> guided = w.cross(w.cross(p).eval()) + 2.0 * w.cross(v);
    at.add_force(point, -at.value(mass) * guided);
  }
};

}  // namespace eigentrail
