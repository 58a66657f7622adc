// Linear springs. The geometric stiffness of a stretched spring results from the differentiation.
#pragma once

#include "model/element.hpp"

namespace eigentrail {

/// Spring between two places: tension k (|d| - free_length) + preload along d = to - from. If the ends
/// coincide, the direction is undefined and the evaluation reports a number that is not finite.
struct Spring {
  static constexpr std::string_view name = "spring";
  static constexpr std::string_view description = "linear spring between two places";
  static constexpr Contribution contribution{.conservative = true};

  Place from, to;
  Quantity stiffness, free_length, preload;

  static void fields(auto& self, auto& visit) {
    visit.place("from", self.from, "one end");
    visit.place("to", self.to, "the other end");
    visit.quantity({"stiffness", "N/m", "force per elongation"}, self.stiffness);
    visit.quantity({"free_length", "m", "length without force", Range::non_negative}, self.free_length);
    visit.quantity({"preload", "N", "tension at the free length", Range::any, 0.0}, self.preload);
  }

  template <class Scalar>
  void force(ElementView<Scalar>& at) const {
    const Vec3<Scalar> d = at.position(to) - at.position(from);
    const Scalar length = d.norm();
    const Vec3<Scalar> tension =
        (at.value(stiffness) * (1.0 - at.value(free_length) / length) + at.value(preload) / length) * d;
    at.add_force(from, tension);
    at.add_force(to, -tension);
  }
};

/// A spring that keeps its direction u (the vertical spring of the seed paper, Eq. 107b): f = -k (u . x -
/// reference) u, with u normalized.
struct GuidedSpring {
  static constexpr std::string_view name = "guided_spring";
  static constexpr std::string_view description =
      "linear spring that keeps its direction, its far end sliding along";
  static constexpr Contribution contribution{.conservative = true};

  Place point;
  std::array<Quantity, 3> direction;
  Quantity stiffness, reference;

  static void fields(auto& self, auto& visit) {
    visit.point("point", self.point, "the point it acts on");
    visit.vector({"direction", "", "direction of the spring, of any length", Range::positive},
                 self.direction);
    visit.quantity({"stiffness", "N/m", "force per elongation"}, self.stiffness);
    visit.quantity({"reference", "m", "coordinate along the direction without force", Range::any, 0.0},
                   self.reference);
  }

  template <class Scalar>
  void force(ElementView<Scalar>& at) const {
    const Vec3<Scalar> u = unit(at.value(direction));
    const Scalar elongation = u.dot(at.position(point)) - at.value(reference);
    at.add_force(point, (-at.value(stiffness) * elongation) * u);
  }
};

}  // namespace eigentrail
