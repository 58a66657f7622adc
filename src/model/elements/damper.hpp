// Linear damper between two places.
#pragma once

#include "model/element.hpp"

namespace eigentrail {

/// Tension c d|d|/dt along d = to - from.
struct Damper {
  static constexpr std::string_view name = "damper";
  static constexpr std::string_view description = "linear damper between two places";
  static constexpr Contribution contribution{.dissipative = true};

  Place from, to;
  Quantity coefficient;

  static void fields(auto& self, auto& visit) {
    visit.place("from", self.from, "one end");
    visit.place("to", self.to, "the other end");
    visit.quantity({"coefficient", "N s/m", "force per rate of elongation"}, self.coefficient);
  }

  template <class Scalar>
  void force(ElementView<Scalar>& at) const {
    const Vec3<Scalar> d = at.position(to) - at.position(from);
    const Vec3<Scalar> rate = at.velocity(to) - at.velocity(from);
    const Vec3<Scalar> tension = (at.value(coefficient) * d.dot(rate) / d.squaredNorm()) * d;
    at.add_force(from, tension);
    at.add_force(to, -tension);
  }
};

}  // namespace eigentrail
