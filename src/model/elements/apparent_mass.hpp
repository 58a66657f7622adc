// Apparent mass: air that a thin airfoil sets in motion, without circulation (Theodorsen, NACA Report 496,
// 1935, Eqs. XVIII, XX; the terms without C(k)). Per length, with the half chord b and m = pi rho b^2:
//
//     -m (n . acceleration of mid-chord)        normal to the chord, at mid-chord
//      m U_t (rate of pitch)                    normal to the chord, at three quarters of the chord
//     -m b^2 / 8 (acceleration of pitch)        a moment, nose up
//
// Accelerations and rates are those against the air, which a rotating frame takes part in.
#pragma once

#include <numbers>

#include "model/elements/air_section.hpp"

namespace eigentrail {

struct ApparentMass : AirSection {
  static constexpr std::string_view name = "apparent_mass";
  static constexpr std::string_view description = "inertia of the air that strips move (Theodorsen)";
  static constexpr Contribution contribution{
      .inertia = true, .conservative = true, .circulatory = true, .dissipative = true, .gyroscopic = true};

  template <class Scalar>
  void force(ElementView<Scalar>& at) const {
    const AirFlow<Scalar> air(*this, at);
    const Vec3<Scalar> w = at.value(angular_velocity);
    const Scalar c = at.value(chord);
    const Scalar mass = 0.5 * std::numbers::pi * c * air.half_mass();
    const auto seen_at_rest = [&](const Place& place) -> Vec3<Scalar> {
      return at.acceleration(place) + 2.0 * w.cross(at.velocity(place)) +
             w.cross(w.cross(at.position(place)).eval());
    };
    const Vec3<Scalar> t_rate = at.velocity(leading) + w.cross(air.t);
    const Vec3<Scalar> n_rate = at.velocity(lift) + w.cross(air.n);
    const Vec3<Scalar> t_acceleration = seen_at_rest(leading);
    const Scalar rise = air.n.dot(seen_at_rest(quarter_chord) - 0.25 * c * t_acceleration);
    const Scalar pitch = air.n.dot(t_acceleration) + n_rate.dot(t_rate);
    const Scalar at_mid_chord = -mass * rise;
    const Scalar behind = mass * air.forward * air.turn;
    at.add_force(quarter_chord, (at_mid_chord + behind) * air.n);
    const Scalar moment = -0.25 * c * at_mid_chord - 0.5 * c * behind - mass * c * c * pitch / Scalar(32.0);
    at.add_force(leading, moment * air.n);
  }
};

}  // namespace eigentrail
