// Quasi-steady forces on a strip of a wing or blade (strip theory of thin airfoils): per length
//
//     lift    1/2 rho c a (-U_n) (-U_n t + U_t n), with the downwash at three quarters of the chord for -U_n
//     drag   -1/2 rho c c_d |U| (U_t t + U_n n)
//     moment  1/2 rho c^2 c_m |U|^2, nose up
//
// at the quarter chord. A section that does not pitch has the forces of BladeElement. Coefficients of a table
// are those at the angle whose tangent is the downwash over the forward speed.
#pragma once

#include "model/elements/air_section.hpp"

namespace eigentrail {

struct Strip : AirSection {
  static constexpr std::string_view name = "strips";
  static constexpr std::string_view description =
      "quasi-steady lift, drag and moment of a beam, blade or body";
  static constexpr Contribution contribution{
      .conservative = true, .circulatory = true, .dissipative = true, .gyroscopic = true};

  Quantity drag, moment;  ///< coefficients of drag and of the moment about the quarter chord; no slot: 0

  static void fields(auto& self, auto& visit) {
    AirSection::fields(self, visit);
    visit.numbers(self.drag, self.moment);
  }

  template <class Scalar>
  void force(ElementView<Scalar>& at) const {
    AirFlow<Scalar> air(*this, at);
    Vec3<Scalar> sum = air.lift_of(air.circulation(air.downwash));
    const Scalar half = air.half_mass();
    Scalar c_d(0.0), c_m(0.0);
    if (polar) {
      c_d = air.coefficient(polar->drag, air.downwash);
      c_m = air.coefficient(polar->moment, air.downwash);
    }
    if (drag.slot >= 0) c_d += at.value(drag);
    if (moment.slot >= 0) c_m += at.value(moment);
    if (polar || drag.slot >= 0)
      sum -= half * c_d * sqrt(air.speed_squared()) * (air.forward * air.t + air.normal * air.n);
    air.add_force(sum);
    if (polar || moment.slot >= 0) {
      const Scalar nose_up = air.compressed(half * at.value(chord) * c_m * air.speed_squared());
      at.add_force(leading, nose_up * air.n);
    }
  }
};

}  // namespace eigentrail
