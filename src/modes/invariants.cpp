#include "eigentrail/modes/invariants.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "eigentrail/modes/matching.hpp"

namespace eigentrail {
namespace {

ComplexMatrix centred_matrix(const ComplexVector& functions) {
  const Eigen::Index k = block_size(functions.size());
  ComplexMatrix N = functions.reshaped(k, k);
  N.diagonal().array() -= N.trace() / static_cast<double>(k);
  return N;
}

/// Power sums sum n_i^j, j = 0..top, of the eigenvalues less their mean.
ComplexVector power_sums(const ComplexVector& functions, Eigen::Index top) {
  const Eigen::Index k = block_size(functions.size());
  const ComplexMatrix N = centred_matrix(functions);
  ComplexMatrix power = ComplexMatrix::Identity(k, k);
  ComplexVector sums(top + 1);
  for (Eigen::Index j = 0; j <= top; ++j, power *= N) sums[j] = power.trace();
  return sums;
}

}  // namespace

Eigen::Index block_size(Eigen::Index functions) {
  return functions <= 2 ? functions
                        : static_cast<Eigen::Index>(std::lround(std::sqrt(static_cast<double>(functions))));
}

ComplexMatrix block_functions(const std::vector<ComplexMatrix>& Lambda) {
  const auto count = static_cast<Eigen::Index>(Lambda.size());
  const Eigen::Index k = Lambda[0].rows();
  ComplexMatrix functions = ComplexMatrix::Zero(k <= 2 ? k : k * k, count);
  if (k != 2) {
    for (Eigen::Index i = 0; i < count; ++i)
      functions.col(i) = Lambda[static_cast<std::size_t>(i)].reshaped();
    return functions;
  }
  // delta from Lambda - tau, not from tau^2 - det: the digits that are left where the eigenvalues meet.
  std::vector<ComplexMatrix> N = Lambda;
  for (Eigen::Index i = 0; i < count; ++i) {
    ComplexMatrix& n = N[static_cast<std::size_t>(i)];
    functions(0, i) = 0.5 * n.trace();
    n.diagonal().array() -= functions(0, i);
    for (Eigen::Index j = 0; j <= i; ++j) {
      functions(1, i) += 0.5 * (N[static_cast<std::size_t>(j)] * N[static_cast<std::size_t>(i - j)]).trace();
    }
  }
  return functions;
}

ComplexVector block_roots(const ComplexVector& functions) {
  const Eigen::Index k = block_size(functions.size());
  if (k == 1) return functions;
  if (k == 2) {
    const Complex root = std::sqrt(functions[1]);
    return (ComplexVector(2) << functions[0] + root, functions[0] - root).finished();
  }
  const ComplexMatrix Lambda = functions.reshaped(k, k);
  if (functions.imag().isZero(0.0)) return Eigen::EigenSolver<Matrix>(Lambda.real(), false).eigenvalues();
  return Eigen::ComplexEigenSolver<ComplexMatrix>(Lambda, false).eigenvalues();
}

Complex block_mean(const ComplexVector& functions) {
  const Eigen::Index k = block_size(functions.size());
  if (k <= 2) return functions[0];
  return functions.reshaped(k, k).trace() / static_cast<double>(k);
}

Complex block_discriminant(const ComplexVector& functions, Eigen::Index distinct) {
  const Eigen::Index k = block_size(functions.size());
  if (k == 2 && distinct == 2) return 4.0 * functions[1];
  const ComplexVector sums = power_sums(functions, 2 * distinct - 2);
  ComplexMatrix hankel(distinct, distinct);
  for (Eigen::Index i = 0; i < distinct; ++i) {
    for (Eigen::Index j = 0; j < distinct; ++j) hankel(i, j) = sums[i + j];
  }
  return hankel.determinant();
}

double least_gap(const ComplexVector& roots) {
  double gap = INFINITY;
  for (Eigen::Index i = 0; i < roots.size(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) gap = std::min(gap, std::abs(roots[i] - roots[j]));
  }
  return gap;
}

namespace {

/// Characteristic polynomial of the centred block as series: e_0..e_k.
std::vector<ComplexVector> elementary_series(const ComplexMatrix& functions) {
  const Eigen::Index k = block_size(functions.rows());
  const Eigen::Index count = functions.cols();
  std::vector<ComplexVector> sums(static_cast<std::size_t>(k) + 1, ComplexVector::Zero(count));
  if (k == 2) {
    sums[2] = 2.0 * functions.row(1).transpose();
  } else {
    std::vector<ComplexMatrix> N, power;
    for (Eigen::Index i = 0; i < count; ++i) N.push_back(centred_matrix(functions.col(i)));
    power = N;
    for (std::size_t j = 2; j <= static_cast<std::size_t>(k); ++j) {
      std::vector<ComplexMatrix> next(N.size(), ComplexMatrix::Zero(k, k));
      for (std::size_t a = 0; a < N.size(); ++a) {
        for (std::size_t b = 0; a + b < N.size(); ++b) next[a + b] += power[a] * N[b];
      }
      power = std::move(next);
      for (Eigen::Index i = 0; i < count; ++i) sums[j][i] = power[static_cast<std::size_t>(i)].trace();
    }
  }
  std::vector<ComplexVector> e{ComplexVector::Unit(count, 0)};
  for (std::size_t j = 1; j <= static_cast<std::size_t>(k); ++j) {
    ComplexVector sum = ComplexVector::Zero(count);
    for (std::size_t i = 2; i <= j; ++i)
      sum += (i % 2 == 1 ? 1.0 : -1.0) * multiply_series(e[j - i], sums[i]);
    e.emplace_back(sum / static_cast<double>(j));
  }
  return e;
}

ComplexVector mean_series(const ComplexMatrix& functions) {
  const Eigen::Index k = block_size(functions.rows());
  if (k <= 2) return functions.row(0).transpose();
  ComplexVector mean = ComplexVector::Zero(functions.cols());
  for (Eigen::Index i = 0; i < functions.cols(); ++i) mean[i] = block_mean(functions.col(i));
  return mean;
}

}  // namespace

ComplexVector root_series(const ComplexMatrix& functions, Complex root) {
  const Eigen::Index k = block_size(functions.rows());
  const Eigen::Index count = functions.cols();
  if (k == 1) return functions.row(0).transpose();
  const std::vector<ComplexVector> e = elementary_series(functions);
  const ComplexVector mean = mean_series(functions);
  ComplexVector x = ComplexVector::Zero(count);
  x[0] = root - mean[0];
  for (Eigen::Index known = 1; known < 2 * count; known *= 2) {
    ComplexVector value = ComplexVector::Unit(count, 0);
    ComplexVector slope = ComplexVector::Zero(count);
    for (std::size_t j = 1; j <= static_cast<std::size_t>(k); ++j) {
      slope = multiply_series(slope, x) + value;
      value = multiply_series(value, x) + (j % 2 == 1 ? -1.0 : 1.0) * e[j];
    }
    if (std::abs(slope[0]) < 1e-300) return {};
    // The root itself is known better than the functions tell it where it is nearly double.
    value[0] = 0.0;
    x -= multiply_series(value, reciprocal_series(slope));
  }
  x += mean;
  return x.allFinite() ? x : ComplexVector();
}

double root_error(const ComplexVector& functions, const Vector& errors, double least_gap) {
  const Eigen::Index k = block_size(functions.size());
  if (k == 1) return errors[0];
  if (k == 2)
    return errors[0] + errors[1] / (2.0 * std::max(std::abs(std::sqrt(functions[1])), 0.5 * least_gap));
  // Eigenvalues of Lambda move by the error times the condition of its eigenvectors (Bauer & Fike 1960).
  constexpr double worst_condition = 10.0;
  const ComplexMatrix Lambda = functions.reshaped(k, k);
  const ComplexMatrix vectors = Eigen::ComplexEigenSolver<ComplexMatrix>(Lambda).eigenvectors();
  const double reciprocal = Eigen::PartialPivLU<ComplexMatrix>(vectors).rcond();
  return errors.norm() * std::min(1.0 / std::max(reciprocal, 1e-300), worst_condition);
}

ComplexVector in_order_of(const ComplexVector& from, const ComplexVector& to) {
  const Eigen::Index k = from.size();
  if (k == 1) return to;
  if (k == 2) {
    const double kept = std::abs(from[0] - to[0]) + std::abs(from[1] - to[1]);
    const double swapped = std::abs(from[0] - to[1]) + std::abs(from[1] - to[0]);
    return kept <= swapped ? to : ComplexVector(to.reverse());
  }
  Matrix cost(k, k);
  for (Eigen::Index i = 0; i < k; ++i) {
    for (Eigen::Index j = 0; j < k; ++j) cost(i, j) = std::abs(from[i] - to[j]);
  }
  ComplexVector ordered(k);
  const std::vector<int> assignment = optimal_assignment(cost);
  for (Eigen::Index i = 0; i < k; ++i) ordered[i] = to[assignment[static_cast<std::size_t>(i)]];
  return ordered;
}

ComplexVector multiply_series(const ComplexVector& a, const ComplexVector& b) {
  ComplexVector product = ComplexVector::Zero(a.size());
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    for (Eigen::Index j = 0; i + j < a.size(); ++j) product[i + j] += a[i] * b[j];
  }
  return product;
}

ComplexVector reciprocal_series(const ComplexVector& series) {
  ComplexVector result = ComplexVector::Zero(series.size());
  result[0] = 1.0 / series[0];
  for (Eigen::Index k = 1; k < series.size(); ++k) {
    for (Eigen::Index i = 1; i <= k; ++i) result[k] -= series[i] * result[k - i];
    result[k] *= result[0];
  }
  return result;
}

}  // namespace eigentrail
