// A section of a wing or blade in moving air: what the forces of the air on it have in common.
//
// The section is known by its quarter chord and two directions, all moving: t from trailing to leading edge
// and n, the direction of lift. The quarter chord moves through the air with U = v + w x p - wind, w the
// angular velocity of the frame, and the section turns nose up with the rate n . (t' + w x t). Thin airfoils
// feel the downwash at three quarters of the chord, a vortex at the quarter chord meeting the boundary
// condition there (Pistolesi's theorem; Bisplinghoff, Ashley & Halfman, Aeroelasticity, 1955, Sect. 5-6).
#pragma once

#include "model/element.hpp"

namespace eigentrail {

/// Motion of a section through the air.
template <class Scalar>
struct AirFlow {
  Vec3<Scalar> t, n;  ///< towards the leading edge; direction of lift
  Scalar forward;     ///< components of U along t and n, m/s
  Scalar normal;
  Scalar turn;      ///< rate of pitch, nose up, rad/s
  Scalar downwash;  ///< of the air through the section at three quarters of the chord, m/s

  Scalar speed_squared() const { return forward * forward + normal * normal; }
};

struct AirSection {
  Place quarter_chord, leading, lift;
  std::array<Quantity, 3> angular_velocity, wind;
  Quantity width;                  ///< length of the strip for which the section stands, m
  Quantity chord, density;         ///< m, kg/m^3
  Quantity lift_slope, zero_lift;  ///< 1/rad, rad; zero_lift without slot: 0

  template <class Self, class Visitor>
  static void common_fields(Self& self, Visitor& visit, Enters enters) {
    visit.place("quarter_chord", self.quarter_chord, "");
    visit.direction("leading", self.leading, "");
    visit.direction("lift", self.lift, "");
    visit.vector({"angular_velocity", "rad/s", enters, ""}, self.angular_velocity);
    visit.vector({"wind", "m/s", enters, ""}, self.wind);
    visit.quantity({"width", "m", enters, ""}, self.width);
    visit.quantity({"chord", "m", enters, ""}, self.chord);
    visit.quantity({"density", "kg/m^3", enters, ""}, self.density);
    visit.quantity({"lift_slope", "1/rad", enters, ""}, self.lift_slope);
    visit.quantity({"zero_lift", "rad", enters, ""}, self.zero_lift);
  }

  template <class Scalar>
  AirFlow<Scalar> flow(const ElementView<Scalar>& at) const {
    AirFlow<Scalar> flow;
    const Vec3<Scalar> w = at.value(angular_velocity);
    flow.t = at.position(leading);
    flow.n = at.position(lift);
    const Vec3<Scalar> U = at.velocity(quarter_chord) + w.cross(at.position(quarter_chord)) - at.value(wind);
    flow.forward = U.dot(flow.t);
    flow.normal = U.dot(flow.n);
    flow.turn = flow.n.dot(at.velocity(leading) + w.cross(flow.t));
    flow.downwash = 0.5 * at.value(chord) * flow.turn - flow.normal;
    return flow;
  }

  /// 1/2 rho c times the width, kg/m.
  template <class Scalar>
  Scalar half_mass(const ElementView<Scalar>& at) const {
    return 0.5 * at.value(density) * at.value(chord) * at.value(width);
  }

  /// Density times circulation times width that a downwash causes: 1/2 rho c a (downwash cos alpha_0 -
  /// forward sin alpha_0), kg/s.
  template <class Scalar>
  Scalar circulation(const ElementView<Scalar>& at, const AirFlow<Scalar>& flow,
                     const Scalar& downwash) const {
    using std::cos, std::sin;
    const Scalar slope = half_mass(at) * at.value(lift_slope);
    if (zero_lift.slot < 0) return slope * downwash;
    const Scalar angle = at.value(zero_lift);
    return slope * (cos(angle) * downwash - sin(angle) * flow.forward);
  }

  /// Adds the lift of a circulation: normal to U, at the quarter chord.
  template <class Scalar>
  void add_lift(ElementView<Scalar>& at, const AirFlow<Scalar>& flow, const Scalar& circulation) const {
    at.add_force(quarter_chord, circulation * (flow.forward * flow.n - flow.normal * flow.t));
  }
};

}  // namespace eigentrail
