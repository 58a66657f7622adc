#include "reduction/balance.hpp"

#include <algorithm>
#include <cmath>

namespace eigentrail {
namespace {

double power_of_two(double x) {
  return std::exp2(std::round(std::log2(x)));
}

Matrix sum_of_magnitudes(const std::vector<Matrix>& matrices, Eigen::Index n) {
  Matrix sum = Matrix::Zero(n, n);
  for (const Matrix& A : matrices) {
    if (A.size() > 0 && A.allFinite()) sum += A.cwiseAbs();
  }
  return sum;
}

/// The sum |M| w^2 + |C| w + |K| of magnitudes, at the frequency w at which the first and the last have the
/// same norm; without M, the last two. No term then counts for more because of the unit of time. Freedoms
/// that no force holds, or that have no mass, have no frequency: their mass or stiffness does not count, or
/// else scaling it would change w further and further.
Matrix at_typical_frequency(const Matrix& M, const Matrix& C, const Matrix& K) {
  const Vector held = (K.rowwise().norm().array() > 0.0).cast<double>();
  const Vector heavy = (M.rowwise().norm().array() > 0.0).cast<double>();
  const double m = (held.asDiagonal() * M).norm();
  const double k = (heavy.asDiagonal() * K).norm();
  const double of_damped = C.norm() > 0.0 && K.norm() > 0.0 ? K.norm() / C.norm() : 1.0;
  const double w = m > 0.0 && k > 0.0 ? std::sqrt(k / m) : of_damped;
  return M * (w * w) + C * w + K;
}

}  // namespace

// The frequency w is that of the coordinates found so far: in those given, one unit may hide all others.
Balance balance(const CoefficientMatrices& coefficients, Eigen::Index n) {
  constexpr int most_sweeps =
      200;                        // of which freedoms without stiffness may need a hundred, others about ten
  constexpr double enough = 0.1;  // largest deviation of a norm from one
  const Matrix M = sum_of_magnitudes(coefficients.M, n);
  const Matrix C = sum_of_magnitudes(coefficients.C, n);
  const Matrix K = sum_of_magnitudes(coefficients.K, n);
  Balance scaling{Vector::Ones(n), Vector::Ones(n)};
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    const Matrix sum = at_typical_frequency(scaling.of(M), scaling.of(C), scaling.of(K));
    const Vector rows = sum.rowwise().norm();
    const Vector columns = sum.colwise().norm();
    const auto deviates = [](double norm) { return norm > 0.0 && std::abs(norm - 1.0) > enough; };
    if (std::none_of(rows.begin(), rows.end(), deviates) &&
        std::none_of(columns.begin(), columns.end(), deviates))
      break;
    const auto factor = [](double norm) { return norm > 0.0 ? 1.0 / std::sqrt(norm) : 1.0; };
    scaling.rows.array() *= rows.unaryExpr(factor).array();
    scaling.columns.array() *= columns.unaryExpr(factor).array();
  }
  scaling.rows = scaling.rows.unaryExpr(&power_of_two);
  scaling.columns = scaling.columns.unaryExpr(&power_of_two);
  return scaling;
}

}  // namespace eigentrail
