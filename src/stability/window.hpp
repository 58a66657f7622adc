// The window in the plane of two parameters. In the source files of this folder places are scaled so that the
// window is [0, 1]^2.
#pragma once

#include <array>

#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/stability/boundary.hpp"

namespace eigentrail {

class Window {
 public:
  /// Throws std::invalid_argument when the model lacks one of the parameters.
  Window(const Model& model, const BoundaryOptions& options);

  /// P and Q in their units, from a scaled place; exact on the edges.
  Place declared(const Place& place) const;

  /// The scaled coordinate of a value of P (`coordinate` 0) or Q (1).
  double scaled(int coordinate, double value) const {
    return (value - from_[coordinate]) / size_[coordinate];
  }

  /// A direction or displacement in the units of P and Q, from a scaled one.
  Place declared_direction(const Place& direction) const { return direction.cwiseProduct(size_); }

  /// Power series of all parameters of the model along a curve, from the series of the scaled place (2 x
  /// count).
  VectorSeries parameters(const Matrix& places) const;

  /// The problem at a scaled place: the first parameter is the traced one, the second one is constant.
  PathProblem at(const Place& place) const;

  /// Whether a scaled place is in the window, or outside by rounding only.
  static bool contains(const Place& place) {
    constexpr double rounding = 1e-12;
    return place.minCoeff() >= -rounding && place.maxCoeff() <= 1.0 + rounding;
  }

  const Model& model() const { return problem_.model; }
  int order() const { return problem_.order; }
  void set_reference(double s_ref) { problem_.s_ref = s_ref; }
  double reference() const { return problem_.s_ref; }

  /// Name of the parameter of a coordinate.
  const std::string& name(int coordinate) const;

  /// Value of a parameter where its scaled coordinate is u, as text.
  std::string value_text(int coordinate, double u) const;

  /// A scaled place in words, for example "omega = 12.4, a_n = 1000".
  std::string text(const Place& place) const;

 private:
  PathProblem problem_;
  std::array<int, 2> index_;
  Place from_, to_, size_;
};

}  // namespace eigentrail
