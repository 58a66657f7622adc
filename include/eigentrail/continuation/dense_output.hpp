// Dense output: the polynomial that shares the power series of both ends of a step.
//
// Of degree 2q+1, in the form of a truncated two-point Taylor expansion, with t = 0 at the left end and 1 at
// the right,
//
//     s(t) = sum_{k=0..q} (t (t - 1))^k (F(k+1, k) + F(k+1, k+1) t)
//
// where F(i, j) is the divided difference over i nodes at the left end and j at the right (Lopez & Temme,
// Stud. Appl. Math. 109, 2002). Its terms fall geometrically, at the rate h^2 / (4 |z - a| |z - b|) set by
// the nearest singularity z. The term k = q is the difference to the interpolant of order q - 1, hence the
// error of that one.
#pragma once

#include "eigentrail/core/types.hpp"

namespace eigentrail {

class HermiteInterpolant {
 public:
  /// `left` and `right` hold power series coefficients (rows: functions, columns: order + 1) at the ends of a
  /// step of signed length `length`, not zero.
  HermiteInterpolant(double length, const ComplexMatrix& left, const ComplexMatrix& right);
  HermiteInterpolant() = default;

  /// Its state, for files that a trace goes on from.
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit(self.left_value_, self.right_value_, self.slope_);
  }

  /// Number of functions.
  Eigen::Index size() const { return slope_.rows(); }

  /// 2q+1: the order from which on `series` has nothing to add.
  int degree() const { return 2 * static_cast<int>(slope_.cols()) - 1; }

  /// Values of all functions at t; outside [0, 1] it extrapolates, off the real axis it continues
  /// analytically.
  ComplexVector operator()(double t) const;
  ComplexVector operator()(Complex t) const;

  /// Derivatives with respect to t.
  ComplexVector slope(double t) const;

  /// Coefficients of all functions in powers of (t - t0), column k that of power k <= order.
  ComplexMatrix series(double t0, int order) const;

  /// Estimated largest error on the step of every function of the interpolant of order q - 1: the term k = q,
  /// and what follows it if the terms go on falling as the last two did.
  Vector error_without_last() const;

  /// The last term of one function at t as a share of its largest one there: small where t is near enough
  /// for the interpolant to tell the function.
  double last_share(Eigen::Index function, Complex t) const;

 private:
  double term(Eigen::Index function, Eigen::Index k) const;

  template <class Scalar>
  ComplexVector evaluate(Scalar t) const;

  /// The expansion as seen from the nearer end, in the distance u from it: relative accuracy there also where
  /// a function vanishes at that end. Seen from the right end the divided differences over i nodes there and
  /// j at the left are (-1)^(i+j-1) F(j, i).
  const ComplexMatrix& near_values(bool left) const { return left ? left_value_ : right_value_; }

  /// Column k: F(k+1, k) and F(k, k+1), the values of term k at both ends, and F(k+1, k+1).
  ComplexMatrix left_value_, right_value_, slope_;
};

}  // namespace eigentrail
