// Interpolation of several complex functions on an equidistant grid: straight lines, or the cubic spline with
// not-a-knot ends (de Boor, A Practical Guide to Splines, Ch. IV), which is of fourth order up to the ends.
#pragma once

#include <vector>

#include "eigentrail/accuracy/study.hpp"

namespace eigentrail {

class GridInterpolant {
 public:
  /// `values[k]` holds all functions at first + k step, step not zero; at least two points, five for a
  /// spline.
  GridInterpolant(double first, double step, std::vector<ComplexVector> values, Interpolation kind);

  /// All functions at p; beyond the ends the outermost pieces go on.
  ComplexVector operator()(double p) const;

 private:
  double first_, step_;
  std::vector<ComplexVector> values_;
  std::vector<ComplexVector> curvatures_;  ///< second derivatives times step^2 / 6; empty for straight lines
};

}  // namespace eigentrail
