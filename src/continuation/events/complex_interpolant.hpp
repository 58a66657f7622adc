// A smooth function of the coordinate along the path, continued beside the real axis: the polynomial that
// shares its series at several points (Hermite interpolation in Newton's form).
#pragma once

#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

class ComplexInterpolant {
 public:
  /// `series`: coefficients of the function at x.
  void add(double x, const ComplexVector& series);

  Complex operator()(Complex x) const;

  /// What the last derivative that was added contributes at x, or the one before: about the error there.
  double last_contribution(Complex x) const;

  /// A root near a guess by the secant method; `width` is the scale on which the function changes.
  Complex root_near(Complex guess, double width) const;

  /// Error of a root, as the last terms tell it; infinite where the slope, taken over `width`, is zero.
  double error_of_root(Complex root, double width) const;

  /// Whether a root is a double one: two eigenvalues that do not influence each other coincide at a complex
  /// parameter.
  bool is_double_root(Complex root, double trusted_share) const;

 private:
  void refresh();

  std::vector<double> x_;              ///< a point repeats for every coefficient that it gives
  std::vector<ComplexVector> table_;   ///< the series of the point
  std::vector<Complex> coefficients_;  ///< divided differences
};

}  // namespace eigentrail
