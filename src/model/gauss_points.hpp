// Gauss-Legendre quadrature.
#pragma once

#include <array>
#include <vector>

namespace eigentrail {

/// The n points and weights of Gauss-Legendre quadrature on [0, 1], exact for polynomials of degree 2 n - 1
/// (Golub & Welsch 1969).
std::vector<std::array<double, 2>> gauss_points(int n);

}  // namespace eigentrail
