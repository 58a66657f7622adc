// Inflow of a rotor: the velocity v that its thrust induces against its axis, in hover and axial flow.
//
// Over the disc v = v_0 + v_x x / R + v_y y / R. With V the velocity of the air through the disc against the
// axis, without inflow, and the thrusts T of all strips
//
//     8/(3 pi)   rho A R v_0' + 2 rho A |V + v_0| v_0             = sum T
//     16/(45 pi) rho A R g'   + rho A (V + 2 v_0) sign(V + v_0) g/2 = sum T (x, y) / R,   g = (v_x, v_y)
//
// (Pitt & Peters, Vertica 5, 1981: M and L of a disc in axial flow; Peters & HaQuang, J. AHS 33, 1988: the
// mass flow). The first one alone is momentum theory with the apparent mass of a disc (Carpenter & Fridovich,
// NACA TN 3075, 1953). g' is the rate against the air: in a frame that rotates with W about the axis, the
// rate of the components plus W x g. In hover V = 0.
//
// Of an annulus there is the first equation alone, with its area in place of A (annular momentum theory:
// Gessow & Myers, Aerodynamics of the Helicopter, 1952, Ch. 4), and Prandtl's factor of the loss at the tips,
//
//     F = 2/pi acos exp(-B/2 (R - r) / (r sin phi)),   tan phi = |V + v_0| / (W r)
//
// on its steady part, if wanted.
#pragma once

#include <numbers>

#include "model/element.hpp"

namespace eigentrail {

struct Inflow {
  static constexpr std::string_view name = "inflow";
  static constexpr std::string_view description =
      "velocity that a rotor induces (momentum theory, Pitt and Peters)";
  static constexpr Contribution contribution{.conservative = true, .circulatory = true, .dissipative = true};

  Place velocity;                                        ///< (v_0, v_x, v_y), m/s
  std::array<Quantity, 3> axis, wind, angular_velocity;  ///< unit vector; m/s; of the frame, rad/s
  Quantity radius, density;
  Quantity area;  ///< of an annulus, m^2; without slot: the whole disc
  Quantity to_the_tip,
      at_radius;  ///< B/2 (R - r) / r and r of an annulus with loss at the tips; without slot: none

  static void fields(auto& self, auto& visit) {
    visit.place("velocity", self.velocity, "");
    visit.numbers(self.axis, self.wind, self.angular_velocity, self.radius, self.density, self.area,
                  self.to_the_tip, self.at_radius);
  }

  template <class Scalar>
  void force(ElementView<Scalar>& at) const {
    constexpr double pi = std::numbers::pi;
    const Vec3<Scalar> v = at.position(velocity);
    const Vec3<Scalar> rate = at.velocity(velocity);
    const Vec3<Scalar> a = at.value(axis);
    const Scalar R = at.value(radius);
    const Scalar disc =
        area.slot < 0 ? Scalar(pi * at.value(density) * R * R) : Scalar(at.value(density) * at.value(area));
    const Scalar V = -a.dot(at.value(wind));
    const Scalar through = sqrt((V + v[0]) * (V + v[0]));
    const Scalar cyclic = 0.5 * (V + 2.0 * v[0]) * (V + v[0]) / through;
    const Scalar W = a.dot(at.value(angular_velocity));
    Vec3<Scalar> steady{2.0 * through * v[0], cyclic * v[1], cyclic * v[2]};
    if (to_the_tip.slot >= 0) steady[0] *= tip_loss(at, through, W);
    const Vec3<Scalar> change{8.0 / (3.0 * pi) * rate[0], 16.0 / (45.0 * pi) * (rate[1] - W * v[2]),
                              16.0 / (45.0 * pi) * (rate[2] + W * v[1])};
    at.add_force(velocity, -disc * (steady + R * change));
  }

 private:
  /// Prandtl's factor for the speed `through` the disc and the rotation W.
  template <class Scalar>
  Scalar tip_loss(const ElementView<Scalar>& at, const Scalar& through, const Scalar& W) const {
    const Scalar r = at.value(at_radius);
    const Scalar sine = through / sqrt(through * through + W * W * r * r);
    return 2.0 / std::numbers::pi * acos(exp(-at.value(to_the_tip) / sine));
  }
};

}  // namespace eigentrail
