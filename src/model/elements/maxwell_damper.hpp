// Spring and dashpot in series (Maxwell element), between two places or on the angle of a joint: an
// elastomeric damper, whose damping fades at high frequencies and whose stiffness fades at low ones.
//
// The state u is the elongation that the dashpot has taken up, of first order and without mass. The spring
// has the rest, l - u. Spring and dashpot carry the same force:
//
//   f = k (l - u) = c u'
//
// At rest f = 0 and u = l for every c > 0, so a free length would only shift u. With V = k (l - u)^2 / 2 and
// R = c u'^2 / 2, K and C are symmetric. About a rest the dynamic stiffness is k c s / (k + c s): a dashpot c
// for slow motions, a spring k for fast ones. Small c or k: no force; large c: a spring k; large k: a damper.
// A dashpot with c = 0 has an infinite eigenvalue.
#pragma once

#include "model/elements/torsion.hpp"

namespace eigentrail {

/// Tension k (|d| - u) along d = to - from.
struct MaxwellDamper {
  static constexpr std::string_view name = "maxwell_damper";
  static constexpr std::string_view description = "spring and dashpot in series between two places";
  static constexpr Contribution contribution{.conservative = true, .dissipative = true};
  static constexpr std::array states{OwnState{"dashpot", "m", "elongation of the dashpot"}};

  Place from, to;
  Quantity stiffness, coefficient;

  static void fields(auto& self, auto& visit) {
    visit.place("from", self.from, "one end");
    visit.place("to", self.to, "the other end");
    visit.quantity({"stiffness", "N/m", "force per elongation of the spring", Range::positive},
                   self.stiffness);
    visit.quantity(
        {"coefficient", "N s/m", "force per rate of elongation of the dashpot", Range::non_negative},
        self.coefficient);
  }

  template <class Scalar>
  void force(ElementView<Scalar>& at) const {
    const Vec3<Scalar> d = at.position(to) - at.position(from);
    const Scalar length = d.norm();
    const Scalar tension = at.value(stiffness) * (length - at.state(0));
    const Vec3<Scalar> pull = (tension / length) * d;
    at.add_force(from, pull);
    at.add_force(to, -pull);
    at.add_to_state(0, tension - at.value(coefficient) * at.state_rate(0));
  }
};

/// Moment k (angle - u) against growing angles of a joint.
struct TorsionalMaxwellDamper {
  static constexpr std::string_view name = "torsional_maxwell_damper";
  static constexpr std::string_view description = "spring and dashpot in series on the angle of a joint";
  static constexpr Contribution contribution{.conservative = true, .dissipative = true};
  static constexpr std::array states{OwnState{"dashpot", "rad", "angle of the dashpot"}};

  HingeAngle angle;
  Quantity stiffness, coefficient;

  static void fields(auto& self, auto& visit) {
    visit.joint("joint", self.angle, "the joint whose angle it acts on");
    visit.quantity({"stiffness", "N m/rad", "moment per angle of the spring", Range::positive},
                   self.stiffness);
    visit.quantity(
        {"coefficient", "N m s/rad", "moment per rate of the dashpot's angle", Range::non_negative},
        self.coefficient);
  }

  template <class Scalar>
  void force(ElementView<Scalar>& at) const {
    const detail::AngleAt<Scalar> theta(at, angle);
    const Scalar moment = at.value(stiffness) * (angle_of(theta.sine, theta.cosine) - at.state(0));
    theta.add_moment(at, angle, -moment);
    at.add_to_state(0, moment - at.value(coefficient) * at.state_rate(0));
  }
};

}  // namespace eigentrail
