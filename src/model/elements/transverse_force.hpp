// Force normal to the line from a hinge to a point, proportional to its length (seed paper, Eq. 142). With
// d = point - hinge, f = { -a_t d_y - a_n d_z, a_t d_x, a_n d_x }, "loosely representative of lift (a_n) and
// drag (a_t)". Circulatory.
#pragma once

#include "model/element.hpp"

namespace eigentrail {

struct TransverseForce {
  static constexpr std::string_view name = "transverse_force";
  static constexpr std::string_view description =
      "lift-and-drag-like force normal to the line hinge-point, growing with it";
  static constexpr Contribution contribution{.circulatory = true};

  Place point, hinge;
  Quantity tangential, normal;

  static void fields(auto& self, auto& visit) {
    visit.point("point", self.point, "the point it acts on");
    visit.place("hinge", self.hinge, "where the line begins; the reaction is not applied to it");
    visit.quantity({"tangential", "N/m", "a_t: force along y per distance along x"}, self.tangential);
    visit.quantity({"normal", "N/m", "a_n: force along z per distance along x"}, self.normal);
  }

  template <class Scalar>
  void force(ElementView<Scalar>& at) const {
    const Vec3<Scalar> d = at.position(point) - at.position(hinge);
    const Scalar t = at.value(tangential);
    const Scalar n = at.value(normal);
    at.add_force(point, {-t * d[1] - n * d[2], t * d[0], n * d[0]});
  }
};

}  // namespace eigentrail
