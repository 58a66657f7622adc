// Moment on a body, about a direction that is fixed in the frame (dead moment) or rotates with a body
// (follower moment).
#pragma once

#include "model/element.hpp"

namespace eigentrail {

/// A moment t does the work t . w dt = 1/2 sum (t x d_i) . d_i' dt on a body that rotates with angular
/// velocity w and has the unit directors d_i. It is therefore applied as forces (t x d_i) / 2 on the
/// directors. In general neither kind of moment has a potential.
struct Moment {
  static constexpr std::string_view name = "moment";
  static constexpr std::string_view description =
      "moment on a body along a direction of the frame or of a body";
  static constexpr Contribution contribution{.circulatory = true};

  std::array<Place, 3> directors;
  Place along;
  Quantity magnitude;

  static void fields(auto& self, auto& visit) {
    visit.body("body", self.directors, "the body it acts on");
    visit.direction("along", self.along, "its axis, of any length");
    visit.quantity({"magnitude", "N m", "the moment"}, self.magnitude);
  }

  template <class Scalar>
  void force(ElementView<Scalar>& at) const {
    const Vec3<Scalar> axis = at.position(along);
    const Vec3<Scalar> moment = (at.value(magnitude) / axis.norm()) * axis;
    for (const Place& director : directors) {
      at.add_force(director, 0.5 * moment.cross(at.position(director)));
    }
  }
};

}  // namespace eigentrail
