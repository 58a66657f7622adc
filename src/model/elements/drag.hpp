// Viscous drag relative to the frame: f = -r v   (seed paper, Eq. 141).
#pragma once

#include "model/element.hpp"

namespace eigentrail {

struct Drag {
  static constexpr std::string_view name = "drag";
  static constexpr std::string_view description = "viscous drag -r v, v relative to the frame";
  static constexpr Contribution contribution{.dissipative = true};

  Place point;
  Quantity coefficient;

  static void fields(auto& self, auto& visit) {
    visit.point("point", self.point, "the point it acts on");
    visit.quantity({"coefficient", "N s/m", "drag per velocity"}, self.coefficient);
  }

  template <class Scalar>
  void force(ElementView<Scalar>& at) const {
    at.add_force(point, -at.value(coefficient) * at.velocity(point));
  }
};

}  // namespace eigentrail
