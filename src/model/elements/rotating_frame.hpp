// Frame rotating at constant angular velocity: centrifugal and Coriolis forces on all masses,
// f = -m (w x (w x p) + 2 w x v)   (seed paper, Eqs. 136, 138; the sign in Eq. 139 is a misprint).
#pragma once

#include "model/elements/mass_distribution.hpp"

namespace eigentrail {

struct RotatingFrame {
  static constexpr std::string_view name = "frame";
  static constexpr std::string_view description =
      "steadily rotating frame: centrifugal and Coriolis forces on every mass";
  static constexpr Contribution contribution{.conservative = true, .gyroscopic = true};

  MassDistribution masses;
  std::array<Quantity, 3> angular_velocity;

  static void fields(auto& self, auto& visit) {
    MassDistribution::fields(self.masses, visit);
    visit.numbers(self.angular_velocity);
  }

  template <class Scalar>
  void force(ElementView<Scalar>& at) const {
    const Vec3<Scalar> w = at.value(angular_velocity);
    masses.add_inertia_forces(at, [&](const Place& carrier) -> Vec3<Scalar> {
      const Vec3<Scalar> p = at.position(carrier);
      const Vec3<Scalar> v = at.velocity(carrier);
      return w.cross(w.cross(p).eval()) + 2.0 * w.cross(v);
    });
  }
};

}  // namespace eigentrail
