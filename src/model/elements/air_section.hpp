// A section of a wing or blade in moving air: what the forces of the air on it have in common.
//
// The section is known by its quarter chord and two directions, all moving: t from trailing to leading edge
// and n, the direction of lift. The quarter chord moves through the air with U = v + w x p - wind, w the
// angular velocity of the frame, and the section turns nose up with the rate n . (t' + w x t). Thin airfoils
// feel the downwash at three quarters of the chord, a vortex at the quarter chord meeting the boundary
// condition there (Pistolesi's theorem; Bisplinghoff, Ashley & Halfman, Aeroelasticity, 1955, Sect. 5-6).
//
// A rotor may have inflow in addition, see Inflow: the velocity that its thrust induces against its axis. The
// section gives its thrust, and the moments of it, to the equations of the inflow.
#pragma once

#include <memory>

#include "model/element.hpp"
#include "model/tabulated_factor.hpp"

namespace eigentrail {

/// Motion of a section through the air.
template <class Scalar>
struct AirFlow {
  Vec3<Scalar> t, n;  ///< towards the leading edge; direction of lift
  Scalar forward;     ///< components of U along t and n, m/s
  Scalar normal;
  Scalar turn;      ///< rate of pitch, nose up, rad/s
  Scalar downwash;  ///< of the air through the section at three quarters of the chord, m/s
  Scalar x, y;      ///< place on the disc of the rotor, in radii; without inflow not used

  Scalar speed_squared() const { return forward * forward + normal * normal; }
};

/// The disc of a rotor as its sections see it; all in the frame.
struct RotorDisc {
  std::array<Quantity, 3> centre, axis;
  std::array<Quantity, 3> x, y;  ///< directions in the disc, divided by its radius, 1/m
  Quantity blades;               ///< number of blades for which a section stands
};

/// Lift, drag and moment coefficients of an airfoil over the angle of attack, from a table. Those that it
/// does not have are null: zero.
struct Polar {
  std::shared_ptr<const TabulatedFactor> lift, drag, moment;
};

struct AirSection {
  Place quarter_chord, leading, lift;
  Place inflow;  ///< coordinates of an Inflow; does not move: none
  RotorDisc disc;
  std::array<Quantity, 3> angular_velocity, wind;
  Quantity width;                                ///< length of the strip for which the section stands, m
  Quantity chord, density;                       ///< m, kg/m^3
  Quantity lift_slope, zero_lift;                ///< 1/rad, rad; zero_lift without slot: 0
  Quantity speed_of_sound;                       ///< m/s; without slot: the air is incompressible
  std::shared_ptr<const Polar> polar = nullptr;  ///< coefficients in place of lift_slope and zero_lift

  static void fields(auto& self, auto& visit) {
    visit.place("quarter_chord", self.quarter_chord, "");
    visit.direction("leading", self.leading, "");
    visit.direction("lift", self.lift, "");
    visit.place("inflow", self.inflow, "");
    visit.numbers(self.disc.centre, self.disc.axis, self.disc.x, self.disc.y, self.disc.blades,
                  self.angular_velocity, self.wind, self.width, self.chord, self.density, self.lift_slope,
                  self.zero_lift, self.speed_of_sound);
  }

  template <class Scalar>
  AirFlow<Scalar> flow(const ElementView<Scalar>& at) const {
    AirFlow<Scalar> flow;
    const Vec3<Scalar> w = at.value(angular_velocity);
    flow.t = at.position(leading);
    flow.n = at.position(lift);
    Vec3<Scalar> U = at.velocity(quarter_chord) + w.cross(at.position(quarter_chord)) - at.value(wind);
    if (inflow.moves()) {
      const Vec3<Scalar> from_centre = at.position(quarter_chord) - at.value(disc.centre);
      const Vec3<Scalar> v = at.position(inflow);
      flow.x = from_centre.dot(at.value(disc.x));
      flow.y = from_centre.dot(at.value(disc.y));
      U += (v[0] + v[1] * flow.x + v[2] * flow.y) * at.value(disc.axis);
    }
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

  /// The factor of Prandtl and Glauert for lift and moment, 1 / sqrt(1 - Mach^2); not a number from the speed
  /// of sound on.
  template <class Scalar>
  Scalar compressed(const ElementView<Scalar>& at, const AirFlow<Scalar>& flow, const Scalar& value) const {
    using std::sqrt;
    if (speed_of_sound.slot < 0) return value;
    const Scalar sound = at.value(speed_of_sound);
    return value / sqrt(1.0 - flow.speed_squared() / (sound * sound));
  }

  /// A coefficient of the polar for a downwash.
  template <class Scalar>
  Scalar coefficient(const std::shared_ptr<const TabulatedFactor>& of_polar, const AirFlow<Scalar>& flow,
                     const Scalar& downwash) const {
    return of_polar ? apply(*of_polar, angle_of(downwash, flow.forward)) : Scalar(0.0);
  }

  /// Density times circulation times width that a downwash causes, kg/s: 1/2 rho c a (downwash cos alpha_0 -
  /// forward sin alpha_0), or 1/2 rho c c_l |U| of a table.
  template <class Scalar>
  Scalar circulation(const ElementView<Scalar>& at, const AirFlow<Scalar>& flow,
                     const Scalar& downwash) const {
    using std::cos, std::sin, std::sqrt;
    const Scalar half = compressed(at, flow, half_mass(at));
    if (polar) return half * sqrt(flow.speed_squared()) * coefficient(polar->lift, flow, downwash);
    const Scalar slope = half * at.value(lift_slope);
    if (zero_lift.slot < 0) return slope * downwash;
    const Scalar angle = at.value(zero_lift);
    return slope * (cos(angle) * downwash - sin(angle) * flow.forward);
  }

  /// Adds a force at the quarter chord, and its thrust to the equations of the inflow.
  template <class Scalar>
  void add_air_force(ElementView<Scalar>& at, const AirFlow<Scalar>& flow, const Vec3<Scalar>& force) const {
    at.add_force(quarter_chord, force);
    if (!inflow.moves()) return;
    const Scalar thrust = at.value(disc.blades) * force.dot(at.value(disc.axis));
    at.add_force(inflow, {thrust, thrust * flow.x, thrust * flow.y});
  }

  /// The lift of a circulation, normal to U.
  template <class Scalar>
  Vec3<Scalar> lift_of(const AirFlow<Scalar>& flow, const Scalar& circulation) const {
    return circulation * (flow.forward * flow.n - flow.normal * flow.t);
  }
};

}  // namespace eigentrail
