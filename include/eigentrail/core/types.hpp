// Matrix types, and power series along the path whose order is known at run time.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

namespace eigentrail {

using Complex = std::complex<double>;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;
using ComplexVector = Eigen::VectorXcd;
using ComplexMatrix = Eigen::MatrixXcd;

/// Highest order of the series along the path. Dense output uses at most one order less; the additional
/// coefficient estimates its error.
inline constexpr int max_order = 5;

/// Power series with matrix coefficients: series[k] multiplies h^k. A series may be shorter than the order at
/// which it is used; missing coefficients are zero. A constant thus has size 1 and saves work in products.
using MatrixSeries = std::vector<Matrix>;

/// Power series with vector coefficients: column k multiplies h^k; missing columns are zero.
using VectorSeries = Matrix;

/// The path near a point: all parameters, the coordinates and the multipliers as power series in h, the
/// distance along the path.
template <class Real>
struct BasicPath {
  using Columns = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
  Columns parameters;  ///< n_parameters x (<= order + 1), in the units the scene declares
  Columns x;           ///< n_coordinates x (<= order + 1)
  Columns lambda;      ///< n_constraints x (<= order + 1)
};
using Path = BasicPath<double>;

/// Coefficient k of row `row` of a series; zero if the series is shorter.
template <class Derived>
typename Derived::Scalar coefficient(const Eigen::MatrixBase<Derived>& series, Eigen::Index row,
                                     Eigen::Index k) {
  return k < series.cols() ? series(row, k) : typename Derived::Scalar(0.0);
}

/// Value of sum_k series(:, k) h^k by Horner's rule.
template <class Derived>
auto evaluate_series(const Eigen::MatrixBase<Derived>& series, double h) {
  Eigen::Matrix<typename Derived::Scalar, Eigen::Dynamic, 1> value = series.col(series.cols() - 1);
  for (Eigen::Index k = series.cols() - 2; k >= 0; --k) value = value * h + series.col(k);
  return value;
}

}  // namespace eigentrail
