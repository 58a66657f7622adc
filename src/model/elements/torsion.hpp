// Torsional spring and damper on the angle of a joint.
//
// The angle from u to v about e is theta = atan2(e . (u x v), u . v). e and u rotate with one side of the
// joint, v with the other. The forces on the three directions are gradients of the angle. The spring
// therefore has a potential, and the damper a dissipation function, for any motion of the directions.
#pragma once

#include "model/element.hpp"

namespace eigentrail {

/// The directions that define the angle of a joint.
struct HingeAngle {
  Place axis;  ///< e, a unit vector
  Place from;  ///< u, normal to e
  Place to;    ///< v, equal to u if the angle is zero
};

namespace detail {

/// Sine and cosine of the angle, and the gradients of the angle with respect to axis, from and to.
template <class Scalar>
struct AngleAt {
  Scalar sine, cosine;  ///< times |u| |v|
  Vec3<Scalar> axis, from, to;

  AngleAt(const ElementView<Scalar>& at, const HingeAngle& angle) {
    const Vec3<Scalar> e = at.position(angle.axis);
    const Vec3<Scalar> u = at.position(angle.from);
    const Vec3<Scalar> v = at.position(angle.to);
    const Vec3<Scalar> normal = u.cross(v);
    sine = e.dot(normal);
    cosine = u.dot(v);
    const Scalar share = 1.0 / (sine * sine + cosine * cosine);
    axis = (cosine * share) * normal;
    from = share * (cosine * v.cross(e) - sine * v);
    to = share * (cosine * e.cross(u) - sine * u);
  }

  /// Adds the moment `moment`, positive in the direction of increasing angle.
  void add_moment(ElementView<Scalar>& at, const HingeAngle& angle, const Scalar& moment) const {
    at.add_force(angle.axis, moment * axis);
    at.add_force(angle.from, moment * from);
    at.add_force(angle.to, moment * to);
  }
};

}  // namespace detail

struct TorsionalSpring {
  static constexpr std::string_view name = "torsional_spring";
  static constexpr std::string_view description = "linear spring on the angle of a joint";
  static constexpr Contribution contribution{.conservative = true};

  HingeAngle angle;
  Quantity stiffness, free_angle, preload;

  static void fields(auto& self, auto& visit) {
    visit.joint("joint", self.angle, "the joint whose angle it acts on");
    visit.quantity({"stiffness", "N m/rad", "moment per angle"}, self.stiffness);
    visit.quantity({"free_angle", "rad", "angle without moment", Range::any, 0.0}, self.free_angle);
    visit.quantity(
        {"preload", "N m", "moment at the free angle that opposes growing angles", Range::any, 0.0},
        self.preload);
  }

  template <class Scalar>
  void force(ElementView<Scalar>& at) const {
    const detail::AngleAt<Scalar> theta(at, angle);
    const Scalar opened = angle_of(theta.sine, theta.cosine) - at.value(free_angle);
    theta.add_moment(at, angle, -(at.value(stiffness) * opened + at.value(preload)));
  }
};

struct TorsionalDamper {
  static constexpr std::string_view name = "torsional_damper";
  static constexpr std::string_view description = "linear damper on the angle of a joint";
  static constexpr Contribution contribution{.dissipative = true};

  HingeAngle angle;
  Quantity coefficient;

  static void fields(auto& self, auto& visit) {
    visit.joint("joint", self.angle, "the joint whose angle it acts on");
    visit.quantity({"coefficient", "N m s/rad", "moment per rate of the angle"}, self.coefficient);
  }

  template <class Scalar>
  void force(ElementView<Scalar>& at) const {
    const detail::AngleAt<Scalar> theta(at, angle);
    const Scalar rate = theta.axis.dot(at.velocity(angle.axis)) + theta.from.dot(at.velocity(angle.from)) +
                        theta.to.dot(at.velocity(angle.to));
    theta.add_moment(at, angle, -at.value(coefficient) * rate);
  }
};

}  // namespace eigentrail
