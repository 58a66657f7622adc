// Point mass: inertia force -m a (seed paper, Eq. 140).
#pragma once

#include "model/element.hpp"

namespace eigentrail {

struct PointMass {
  static constexpr std::string_view name = "point";
  static constexpr std::string_view description = "a point with mass: inertia force -m a";
  static constexpr Contribution contribution{.inertia = true};
  static constexpr Dependence depends{.acceleration = true};

  Place point;
  Quantity mass;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit.point("name", self.point, "the point's name");
    visit.quantity({"mass", "kg", enters_mass, "mass of the point", Range::non_negative}, self.mass);
  }

  template <class Scalar>
  void force(ElementView<Scalar>& at) const {
    at.add_force(point, -at.value(mass) * at.acceleration(point));
  }
};

}  // namespace eigentrail
