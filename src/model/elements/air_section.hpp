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
};

/// A section in moving air: its motion through the air, and what the forces of the air follow from.
template <class Scalar>
class AirFlow {
 public:
  AirFlow(const AirSection& section, ElementView<Scalar>& at)
      : t(at.position(section.leading)), n(at.position(section.lift)), section_(section), at_(at) {
    const Place& quarter_chord = section.quarter_chord;
    const Vec3<Scalar> w = at.value(section.angular_velocity);
    Vec3<Scalar> U =
        at.velocity(quarter_chord) + w.cross(at.position(quarter_chord)) - at.value(section.wind);
    if (section.inflow.moves()) {
      const Vec3<Scalar> from_centre = at.position(quarter_chord) - at.value(section.disc.centre);
      const Vec3<Scalar> v = at.position(section.inflow);
      x_ = from_centre.dot(at.value(section.disc.x));
      y_ = from_centre.dot(at.value(section.disc.y));
      U += (v[0] + v[1] * x_ + v[2] * y_) * at.value(section.disc.axis);
    }
    forward = U.dot(t);
    normal = U.dot(n);
    turn = n.dot(at.velocity(section.leading) + w.cross(t));
    downwash = 0.5 * at.value(section.chord) * turn - normal;
  }

  Vec3<Scalar> t, n;  ///< towards the leading edge; direction of lift
  Scalar forward;     ///< components of U along t and n, m/s
  Scalar normal;
  Scalar turn;      ///< rate of pitch, nose up, rad/s
  Scalar downwash;  ///< of the air through the section at three quarters of the chord, m/s

  Scalar speed_squared() const { return forward * forward + normal * normal; }

  /// 1/2 rho c times the width, kg/m.
  Scalar half_mass() const {
    return 0.5 * at_.value(section_.density) * at_.value(section_.chord) * at_.value(section_.width);
  }

  /// The factor of Prandtl and Glauert for lift and moment, 1 / sqrt(1 - Mach^2); not a number from the speed
  /// of sound on.
  Scalar compressed(const Scalar& value) const {
    if (section_.speed_of_sound.slot < 0) return value;
    const Scalar sound = at_.value(section_.speed_of_sound);
    return value / sqrt(1.0 - speed_squared() / (sound * sound));
  }

  /// A coefficient of the polar for a downwash.
  Scalar coefficient(const std::shared_ptr<const TabulatedFactor>& of_polar, const Scalar& by) const {
    return of_polar ? apply(*of_polar, angle_of(by, forward)) : Scalar(0.0);
  }

  /// Density times circulation times width that a downwash causes, kg/s: 1/2 rho c a (downwash cos alpha_0 -
  /// forward sin alpha_0), or 1/2 rho c c_l |U| of a table.
  Scalar circulation(const Scalar& by) const {
    const Scalar half = compressed(half_mass());
    if (section_.polar) return half * sqrt(speed_squared()) * coefficient(section_.polar->lift, by);
    const Scalar slope = half * at_.value(section_.lift_slope);
    if (section_.zero_lift.slot < 0) return slope * by;
    const Scalar angle = at_.value(section_.zero_lift);
    return slope * (cos(angle) * by - sin(angle) * forward);
  }

  /// The lift of a circulation, normal to U.
  Vec3<Scalar> lift_of(const Scalar& circulation) const { return circulation * (forward * n - normal * t); }

  /// Adds a force at the quarter chord, and its thrust to the equations of the inflow.
  void add_force(const Vec3<Scalar>& force) {
    at_.add_force(section_.quarter_chord, force);
    if (!section_.inflow.moves()) return;
    const Scalar thrust = at_.value(section_.disc.blades) * force.dot(at_.value(section_.disc.axis));
    at_.add_force(section_.inflow, {thrust, thrust * x_, thrust * y_});
  }

 private:
  const AirSection& section_;
  ElementView<Scalar>& at_;
  Scalar x_, y_;  ///< place on the disc of the rotor, in radii; without inflow not used
};

}  // namespace eigentrail
