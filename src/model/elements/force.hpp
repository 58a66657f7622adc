// Dead force: constant in magnitude and direction.
#pragma once

#include "model/element.hpp"

namespace eigentrail {

struct DeadForce {
  static constexpr std::string_view name = "force";
  static constexpr std::string_view description = "dead force: fixed components in the frame";
  static constexpr Contribution contribution{.conservative = true};

  Place point;
  std::array<Quantity, 3> components;

  static void fields(auto& self, auto& visit) {
    visit.point("point", self.point, "the point it acts on");
    visit.vector({"components", "N", "the force [x, y, z]"}, self.components);
  }

  template <class Scalar>
  void force(ElementView<Scalar>& at) const {
    at.add_force(point, at.value(components));
  }
};

}  // namespace eigentrail
