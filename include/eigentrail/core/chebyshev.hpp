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

}  // namespace eigentrail
