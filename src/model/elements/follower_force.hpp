// Follower force of given magnitude P whose direction rotates with the line between two places:
// f = P R(axis, angle) (to - from) / |to - from|, R a rotation (Rodrigues' formula).
#pragma once

#include "model/element.hpp"

namespace eigentrail {

struct FollowerForce {
  static constexpr std::string_view name = "follower_force";
  static constexpr std::string_view description =
      "force of given magnitude that turns with the line between two places";
  static constexpr Contribution contribution{.circulatory = true};

  Place point, from, to;
  Quantity magnitude, angle;
  std::array<Quantity, 3> axis;

  static void fields(auto& self, auto& visit) {
    visit.point("point", self.point, "the point it acts on");
    visit.place("from", self.from, "where the line begins");
    visit.place("to", self.to, "where the line ends");
    visit.quantity({"magnitude", "N", "the force, along from -> to where positive"}, self.magnitude);
    visit.quantity({"angle", "rad", "turns the direction about the axis", Range::any, 0.0}, self.angle);
    visit.vector({"axis", "", "axis of that turn, of any length", Range::positive, 1.0}, self.axis);
  }

  template <class Scalar>
  void force(ElementView<Scalar>& at) const {
    const Vec3<Scalar> d = unit<Scalar>(at.position(to) - at.position(from));
    const Vec3<Scalar> k = unit(at.value(axis));
    const Scalar c = cos(at.value(angle));
    const Scalar s = sin(at.value(angle));
    const Vec3<Scalar> turned = c * d + s * k.cross(d) + ((1.0 - c) * k.dot(d)) * k;
    at.add_force(point, at.value(magnitude) * turned);
  }
};

}  // namespace eigentrail
