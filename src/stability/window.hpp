// The window in the plane of two parameters. Inside this folder places are scaled: the window is [0, 1]^2.
#pragma once

#include <array>

#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/stability/boundary.hpp"

namespace eigentrail {

class Window {
 public:
  /// Throws std::invalid_argument when the model lacks one of the parameters.
  Window(const Model& model, const BoundaryOptions& options);

  /// P and Q in their units; exact on the edges.
  Place declared(const Place& place) const;

  /// The scaled coordinate (0: of P, 1: of Q) of a value.
  double scaled(int coordinate, double value) const {
    return (value - from_[coordinate]) / size_[coordinate];
  }

  /// A direction or a displacement in their units.
  Place declared_direction(const Place& direction) const { return direction.cwiseProduct(size_); }

  /// All parameters along a curve of scaled places (2 x count coefficients).
  VectorSeries parameters(const Matrix& places) const;

  /// The problem at a place: traced along the first parameter, the second one held.
  PathProblem at(const Place& place) const;

  /// Whether the place is in the window, or out of it by rounding only.
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

  /// "omega = 12.4, a_n = 1000".
  std::string text(const Place& place) const;

 private:
  PathProblem problem_;
  std::array<int, 2> index_;
  Place from_, to_, size_;
};

}  // namespace eigentrail
