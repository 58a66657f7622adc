// Dense output: the two-point Hermite interpolant of the power series at both ends of a step, and its error.
//
// With derivatives up to order q at both ends, and t = (p - a) / h, h = b - a,
//     s(t) = sum_{k=0..q} (t (t - 1))^k (F(k+1, k) + F(k+1, k+1) t),
// F(i, j) the divided difference over i nodes at t = 0 and j at t = 1: a truncated two-point Taylor expansion
// (Lopez & Temme, Stud. Appl. Math. 109, 2002). Its terms fall geometrically, at the rate h^2 / (4 |z - a| |z
// - b|) set by the nearest singularity z, so the first term left out, which is the error, is told by the last
// ones kept.
#pragma once

#include "eigentrail/core/types.hpp"

namespace eigentrail {

class HermiteInterpolant {
 public:
  /// `left` and `right` hold power series coefficients (rows: functions, columns: order + 1) at a and b, a !=
  /// b.
  HermiteInterpolant(double a, const ComplexMatrix& left, double b, const ComplexMatrix& right);

  /// Values of all functions at p; outside [a, b] it extrapolates.
  ComplexVector operator()(double p) const;

  /// Estimated largest error of every function within [a, b], from the decay of the terms. Needs order >= 2:
  /// with order 1 there is no decay to see yet, and the estimate is zero.
  Vector estimated_error() const;

 private:
  /// Largest magnitude of term k on [a, b] without the factor (t (t - 1))^k.
  double term(Eigen::Index function, Eigen::Index k) const;

  double begin_, length_;
  ComplexMatrix at_left_;  ///< column k: F(k+1, k), the value of term k at t = 0
  ComplexMatrix slope_;    ///< column k: F(k+1, k+1)
};

}  // namespace eigentrail
