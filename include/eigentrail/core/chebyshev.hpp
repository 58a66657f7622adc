// Roots of a smooth function near an interval, from its Chebyshev interpolant.
#pragma once

#include <functional>
#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// All complex roots t of the polynomial of the given degree that agrees with f at the Chebyshev points of
/// [0, 1]: eigenvalues of its colleague matrix (Good, Quart. J. Math. 12, 1961). Roots far from the interval
/// mean nothing unless f is that polynomial. A function that vanishes throughout has none.
std::vector<Complex> roots_near_unit_interval(const std::function<Complex(double)>& f, int degree);

/// All roots of sum_k coefficients[k] h^k.
std::vector<Complex> polynomial_roots(const ComplexVector& coefficients);

}  // namespace eigentrail
