// Roots of a smooth function near an interval, from its Chebyshev interpolant.
#pragma once

#include <functional>
#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// Coefficients of sum_k c_k T_k(2t - 1), the polynomial of the given degree that agrees with f at the
/// Chebyshev points of [0, 1].
ComplexVector chebyshev_coefficients(const std::function<Complex(double)>& f, int degree);

/// All complex roots t of such a polynomial: eigenvalues of its colleague matrix (Good, Quart. J. Math. 12,
/// 1961). Roots far from the interval mean nothing unless f is the polynomial. One that vanishes throughout
/// has none.
std::vector<Complex> chebyshev_roots(const ComplexVector& coefficients);

/// All roots of sum_k coefficients[k] h^k.
std::vector<Complex> polynomial_roots(const ComplexVector& coefficients);

/// Whether such a polynomial certainly has no root with |h| <= radius: its constant term outweighs all others
/// there.
bool has_no_root_within(const ComplexVector& coefficients, double radius);

/// A rectangle of the complex plane with sides along the axes.
struct Rectangle {
  Complex center;
  double half_width = 0.0, half_height = 0.0;
};

/// The same on a rectangle, seen from the centers of discs that cover it. O(n^2) for each of them; a few
/// dozen are tried.
bool has_no_root_in(const ComplexVector& coefficients, const Rectangle& rectangle);

/// The same of sum_k c_k T_k(2t - 1), of a degree that is small enough for its powers: 20 or so. Where roots
/// are looked for near [0, 1] only it saves the colleague matrix.
bool chebyshev_has_no_root_in(const ComplexVector& coefficients, const Rectangle& rectangle);

}  // namespace eigentrail
