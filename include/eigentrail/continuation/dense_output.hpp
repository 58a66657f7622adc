// Dense output: the two-point Hermite interpolant of the power series at both ends of a step.
//
// With derivatives up to order q at both ends the interpolant has degree 2q + 1 and the error
//     s^(2q+2)(xi) / (2q+2)!  (p - a)^(q+1) (p - b)^(q+1),   at most  (h/2)^(2q+2) |s^(2q+2)| / (2q+2)!   inside
// (Stoer & Bulirsch, Introduction to Numerical Analysis, Sect. 2.1.5). Outside [a, b] it extrapolates.
#pragma once

#include "eigentrail/core/types.hpp"

namespace eigentrail {

class HermiteInterpolant {
 public:
  /// `left` and `right` hold power series coefficients (rows: functions, columns: order + 1) at a and b, a != b.
  HermiteInterpolant(double a, const ComplexMatrix& left, double b, const ComplexMatrix& right);

  /// Values of all functions at p.
  ComplexVector operator()(double p) const;

 private:
  double begin_, length_;
  Eigen::Index repeated_;     ///< order + 1: how often each end counts as a node
  ComplexMatrix difference_;  ///< column k: divided difference for k + 1 nodes, in t = (p - a) / (b - a)
};

}  // namespace eigentrail
