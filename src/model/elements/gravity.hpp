// Uniform gravity on a point mass: f = m g.
#pragma once

#include "model/element.hpp"

namespace eigentrail {

struct Gravity {
  static constexpr std::string_view name = "gravity";
  static constexpr std::string_view description = "uniform gravity on every mass";
  static constexpr Contribution contribution{.conservative = true};
  static constexpr Dependence depends{};

  Place point;
  Quantity mass;
  std::array<Quantity, 3> acceleration;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit.point("point", self.point, "every point with mass");
    visit.quantity({"mass", "kg", enters_force, "mass of the point", Range::non_negative}, self.mass);
    visit.vector({"acceleration", "m/s^2", enters_force, "acceleration of gravity"}, self.acceleration);
  }

  template <class Scalar>
  void force(ElementView<Scalar>& at) const {
    at.add_force(point, at.value(mass) * at.value(acceleration));
  }
};

}  // namespace eigentrail
