// Evaluation of a smooth function of the coordinate along the path at complex values of the coordinate: the
// polynomial that agrees with its power series at several real points (Hermite interpolation in Newton's
// form).
#pragma once

#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

class ComplexInterpolant {
 public:
  /// Adds an interpolation point. `series`: Taylor coefficients of the function at x.
  void add(double x, const ComplexVector& series);

  Complex operator()(Complex x) const;

  /// Magnitude of the larger of the last two terms at x: an estimate of the error there.
  double last_contribution(Complex x) const;

  /// A root near a guess, by the secant method; `width` is the length scale of the function.
  Complex root_near(Complex guess, double width) const;

  /// Estimated error of a root: last_contribution divided by the slope, a central difference over +-`width`.
  /// Infinite where the slope is zero.
  double error_of_root(Complex root, double width) const;

  /// Whether a complex root is a double one: the slope there is at most `trusted_share` times the second
  /// derivative times the distance of the root from the real axis. At a double root of a discriminant, two
  /// eigenvalues of uncoupled modes coincide at a complex parameter: a crossing, not an exceptional point.
  bool is_double_root(Complex root, double trusted_share) const;

 private:
  void refresh();

  std::vector<double> x_;              ///< every point, once per coefficient of its series
  std::vector<ComplexVector> table_;   ///< series of the point, one entry per element of x_
  std::vector<Complex> coefficients_;  ///< divided differences
};

}  // namespace eigentrail
