// Interpolation of several complex functions on an equidistant grid: linear, or by the cubic spline with
// not-a-knot end conditions (de Boor, A Practical Guide to Splines, Ch. IV). The error of the spline is of
// fourth order up to the ends.
#pragma once

#include <vector>

#include "eigentrail/accuracy/study.hpp"

namespace eigentrail {

class GridInterpolant {
 public:
  /// `values[k]` contains all functions at first + k step; step is not zero. Throws std::invalid_argument if
  /// there are fewer than two points, or five for a spline.
  GridInterpolant(double first, double step, std::vector<ComplexVector> values, Interpolation kind);

  /// All functions at p; outside of the grid the outermost pieces extrapolate.
  ComplexVector operator()(double p) const;

 private:
  double first_, step_;
  std::vector<ComplexVector> values_;
  std::vector<ComplexVector> curvatures_;  ///< second derivatives times step^2 / 6; empty if linear
};

}  // namespace eigentrail
