// Dense output: the polynomial of degree 2q+1 that agrees with the power series of order q at both ends of a
// step.
//
// It is a truncated two-point Taylor expansion, with t = 0 at the left end and t = 1 at the right end,
//
//     s(t) = sum_{k=0..q} (t (t - 1))^k (F(k+1, k) + F(k+1, k+1) t)
//
// where F(i, j) is the divided difference over i nodes at the left end and j at the right (Lopez & Temme,
// Stud. Appl. Math. 109, 2002). On a step of length h from a to b its terms decrease geometrically with the
// ratio h^2 / (4 |z - a| |z - b|), z being the nearest singularity. The term k = q is the difference from
// the interpolant of order q - 1, and so estimates the error of that interpolant.
#pragma once

#include "eigentrail/core/types.hpp"

namespace eigentrail {

class HermiteInterpolant {
 public:
  /// `left` and `right` hold the power series coefficients at the ends of a step: one row per function, order
  /// q + 1 columns. `length` is the signed length of the step, not zero.
  HermiteInterpolant(double length, const ComplexMatrix& left, const ComplexMatrix& right);
  HermiteInterpolant() = default;

  /// Visits all members, for saving and restoring the state of a trace.
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit(self.left_value_, self.right_value_, self.slope_);
  }

  /// Number of functions.
  Eigen::Index size() const { return slope_.rows(); }

  /// Degree of the polynomial, 2q+1: coefficients of higher powers are zero.
  int degree() const { return 2 * static_cast<int>(slope_.cols()) - 1; }

  /// Values of all functions at t. t outside [0, 1] extrapolates; complex t evaluates the same polynomial
  /// off the real axis.
  ComplexVector operator()(double t) const;
  ComplexVector operator()(Complex t) const;

  /// Derivatives with respect to t.
  ComplexVector slope(double t) const;

  /// Coefficients of all functions in powers of (t - t0): column k belongs to power k, 0 <= k <= order.
  ComplexMatrix series(double t0, int order) const;

  /// Estimated largest error on the step of the interpolant of order q - 1, per function: the term k = q and
  /// the terms after it, if these go on decreasing by the ratio of the last two.
  Vector error_without_last() const;

  /// The last term of one function at t divided by its largest term there. Small where t is near enough to
  /// the step for the interpolant to represent the function.
  double last_share(Eigen::Index function, Complex t) const;

 private:
  /// Bound of |term k| of one function on the step.
  double term(Eigen::Index function, Eigen::Index k) const;

  template <class Scalar>
  ComplexVector evaluate(Scalar t) const;

  /// The expansion is evaluated in the distance u from the nearer end. So it keeps its relative accuracy
  /// where a function vanishes at that end. About the right end, the divided difference over i nodes there
  /// and j at the left end is (-1)^(i+j-1) F(j, i).
  const ComplexMatrix& near_values(bool left) const { return left ? left_value_ : right_value_; }

  /// Column k: F(k+1, k) and F(k, k+1), the values of term k at t = 0 and t = 1 without the factor
  /// (t (t - 1))^k, and F(k+1, k+1).
  ComplexMatrix left_value_, right_value_, slope_;
};

}  // namespace eigentrail
