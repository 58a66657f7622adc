// Chebyshev interpolation on [0, 1], roots of polynomials, and tests that a polynomial has no root in a
// region.
#pragma once

#include <functional>
#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// Coefficients c_k, k = 0 .. degree, of sum_k c_k T_k(2t - 1), the polynomial that interpolates f at the
/// degree + 1 Chebyshev points of [0, 1] (the zeros of T_{degree+1}).
ComplexVector chebyshev_coefficients(const std::function<Complex(double)>& f, int degree);

/// All complex roots t of sum_k c_k T_k(2t - 1): eigenvalues of its colleague matrix (Good, Quart. J. Math.
/// 12, 1961). If the polynomial only approximates a function, roots far from [0, 1] are meaningless. Returns
/// no roots for a constant or zero polynomial, for coefficients that are not finite, and if LAPACK fails.
std::vector<Complex> chebyshev_roots(const ComplexVector& coefficients);

/// All complex roots of sum_k coefficients[k] h^k, whatever the unit of h: reciprocals of the eigenvalues of
/// the companion matrix of 1/h. Returns no roots for a constant or zero polynomial, for coefficients that are
/// not finite, and if LAPACK fails.
std::vector<Complex> polynomial_roots(const ComplexVector& coefficients);

/// Sufficient test that sum_k coefficients[k] h^k has no root with |h| <= radius: |c_0| > sum_{k>0} |c_k|
/// radius^k. `false` leaves the question open.
bool has_no_root_within(const ComplexVector& coefficients, double radius);

/// A rectangle of the complex plane with sides along the axes.
struct Rectangle {
  Complex center;
  double half_width = 0.0, half_height = 0.0;
};

/// Sufficient test that the same polynomial has no root in the rectangle: covers the rectangle with discs and
/// applies has_no_root_within to the polynomial shifted to each centre. Cost O(n^2) per disc, at most 40
/// discs. `false` leaves the question open.
bool has_no_root_in(const ComplexVector& coefficients, const Rectangle& rectangle);

/// The same test for sum_k c_k T_k(2t - 1). Converts to powers, which loses accuracy above a degree of about
/// 20. Cheaper than the eigenvalues of the colleague matrix when the question is only whether there are roots
/// near [0, 1].
bool chebyshev_has_no_root_in(const ComplexVector& coefficients, const Rectangle& rectangle);

}  // namespace eigentrail
