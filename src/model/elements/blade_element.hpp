// Quasi-steady aerodynamics of a blade, strip by strip (blade-element theory; Johnson, Helicopter Theory,
// 1980, Sect. 2.4; Ormiston & Hodges 1972).
//
// A section moves through the air with U = v + w x p - inflow, w the angular velocity of the frame. t is the
// direction from trailing to leading edge and n the direction of lift, both rotated by the pitch about the
// span n x t. The forces per length are
//
//     lift  1/2 rho c a (-U_n) (-U_n t + U_t n)       normal to U, of magnitude 1/2 rho c a |U|^2 sin(alpha)
//     drag -1/2 rho c c_d0 |U| (U_t t + U_n n)        opposite to U
//
// with the chord c and the lift slope a. Except for |U| they are polynomials in U; for small angles they
// equal the usual linear theory.
#pragma once

#include "model/element.hpp"

namespace eigentrail {

struct BladeElement {
  static constexpr std::string_view name = "blade_element";
  static constexpr std::string_view description = "quasi-steady lift and drag of the strips of a blade";
  static constexpr Contribution contribution{
      .conservative = true, .circulatory = true, .dissipative = true, .gyroscopic = true};

  Place point, leading, lift;
  std::array<Quantity, 3> angular_velocity, inflow;
  Quantity width, chord, density, lift_slope, profile_drag, pitch;

  /// `point` is the middle of a strip and `width` its length; the scene gives the ends of the blade.
  static void fields(auto& self, auto& visit) {
    visit.place("point", self.point, "");
    visit.direction("leading", self.leading, "");
    visit.direction("lift", self.lift, "");
    visit.numbers(self.width, self.chord, self.density, self.lift_slope, self.profile_drag, self.pitch,
                  self.inflow, self.angular_velocity);
  }

  template <class Scalar>
  void force(ElementView<Scalar>& at) const {
    const Vec3<Scalar> w = at.value(angular_velocity);
    const Vec3<Scalar> U = at.velocity(point) + w.cross(at.position(point)) - at.value(inflow);
    const Vec3<Scalar> t0 = at.position(leading);
    const Vec3<Scalar> n0 = at.position(lift);
    const Scalar c = cos(at.value(pitch));
    const Scalar s = sin(at.value(pitch));
    const Vec3<Scalar> t = c * t0 + s * n0;
    const Vec3<Scalar> n = c * n0 - s * t0;
    const Scalar Ut = U.dot(t);
    const Scalar Un = U.dot(n);
    const Scalar half = 0.5 * at.value(density) * at.value(chord) * at.value(width);
    const Scalar slope = half * at.value(lift_slope);
    const Scalar drag = half * at.value(profile_drag) * sqrt(Ut * Ut + Un * Un);
    at.add_force(point, (slope * Un * Un - drag * Ut) * t - (slope * Un * Ut + drag * Un) * n);
  }
};

}  // namespace eigentrail
