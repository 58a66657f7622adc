// Arithmetic of truncated power series with matrix coefficients, and values of scalar ones.
#pragma once

#include <Eigen/LU>
#include <array>
#include <vector>

#include "core/thin_product.hpp"
#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// Value at h by Horner's rule.
template <class Coefficient>
Coefficient evaluate_series(const std::vector<Coefficient>& series, double h) {
  Coefficient value = series.back();
  for (std::size_t k = series.size() - 1; k-- > 0;) value = value * h + series[k];
  return value;
}

/// Value, first and second derivative at h of a series with scalar coefficients.
template <class Coefficients, class Scalar>
std::array<Scalar, 3> jet(const Coefficients& series, Scalar h) {
  std::array<Scalar, 3> result{};
  for (Eigen::Index k = series.size() - 1; k >= 0; --k) {
    result[2] = result[2] * h + 2.0 * result[1];
    result[1] = result[1] * h + result[0];
    result[0] = result[0] * h + series[k];
  }
  return result;
}

/// The first `count` coefficients of A(h) B(h); missing coefficients of A and B are zero.
template <class Coefficient>
std::vector<Coefficient> multiply_series(const std::vector<Coefficient>& A, const std::vector<Coefficient>& B,
                                         std::size_t count) {
  std::vector<Coefficient> product(count, Coefficient::Zero(A[0].rows(), B[0].cols()));
  for (std::size_t i = 0; i < A.size(); ++i) {
    for (std::size_t j = 0; j < B.size() && i + j < count; ++j) product[i + j] += thin_product(A[i], B[j]);
  }
  return product;
}

/// A(h)^-1 with as many coefficients as A has; A(0) must be nonsingular.
template <class Coefficient>
std::vector<Coefficient> inverse_series(const std::vector<Coefficient>& A) {
  const Eigen::PartialPivLU<Coefficient> lu(A[0]);
  std::vector<Coefficient> inverse{lu.inverse()};
  for (std::size_t k = 1; k < A.size(); ++k) {
    Coefficient sum = Coefficient::Zero(A[0].rows(), A[0].cols());
    for (std::size_t i = 1; i <= k; ++i) sum += A[i] * inverse[k - i];
    inverse.emplace_back(-lu.solve(sum));
  }
  return inverse;
}

}  // namespace eigentrail
