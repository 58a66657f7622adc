// Ideal constraints of points: rod, plane, fixed coordinate.
#pragma once

#include "model/element.hpp"

namespace eigentrail {

/// Massless rod of given length: c = |to - from|^2 - length^2   (seed paper, Eq. 131).
struct Rod {
  static constexpr std::string_view name = "rod";
  static constexpr std::string_view description =
      "massless rigid rod between two places: c = |d|^2 - length^2";
  static constexpr Contribution contribution{.constraint = true};
  static constexpr int constraint_count = 1;
  static constexpr bool curved = true;

  Place from, to;
  Quantity length;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit.place("from", self.from, "one end");
    visit.place("to", self.to, "the other end");
    visit.quantity({"length", "m", enters_constraint, "distance of the ends", Range::positive}, self.length);
  }

  template <class Scalar>
  void constraint(ElementView<Scalar>& at) const {
    const Vec3<Scalar> d = at.position(to) - at.position(from);
    const Scalar l = at.value(length);
    at.set_constraint(0, d.squaredNorm() - l * l);
  }
};

/// Point on a plane: c = normal . x - offset.
struct Plane {
  static constexpr std::string_view name = "plane";
  static constexpr std::string_view description = "keeps a point on a plane: c = normal . x - offset";
  static constexpr Contribution contribution{.constraint = true};
  static constexpr int constraint_count = 1;
  static constexpr bool curved = false;

  Place point;
  std::array<Quantity, 3> normal;
  Quantity offset;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit.point("point", self.point, "the point");
    visit.vector({"normal", "", enters_constraint, "normal of the plane, of any length", Range::positive},
                 self.normal);
    visit.quantity({"offset", "m", enters_constraint, "normal . x on the plane", Range::any, 0.0},
                   self.offset);
  }

  template <class Scalar>
  void constraint(ElementView<Scalar>& at) const {
    at.set_constraint(0, at.value(normal).dot(at.position(point)) - at.value(offset));
  }
};

/// One coordinate of a point held: c = x_i - value.
struct FixedCoordinate {
  static constexpr std::string_view name = "fixed";
  static constexpr std::string_view description = "holds one coordinate of a point: c = x_i - value";
  static constexpr Contribution contribution{.constraint = true};
  static constexpr int constraint_count = 1;
  static constexpr bool curved = false;

  Place point;
  Axis coordinate;
  Quantity value;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit.point("point", self.point, "the point");
    visit.axis("coordinate", self.coordinate, "which coordinate: \"x\", \"y\" or \"z\"");
    visit.quantity({"value", "m", enters_constraint, "what it is held at", Range::any, 0.0}, self.value);
  }

  template <class Scalar>
  void constraint(ElementView<Scalar>& at) const {
    at.set_constraint(0, at.position(point)[coordinate.index] - at.value(value));
  }
};

}  // namespace eigentrail
