#include "eigentrail/modes/invariants.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/bisection.hpp"
#include "eigentrail/modes/block_parts.hpp"
#include "eigentrail/modes/matching.hpp"

namespace eigentrail {

Eigen::Index block_size(Eigen::Index functions) {
  return functions <= 2 ? functions
                        : static_cast<Eigen::Index>(std::lround(std::sqrt(static_cast<double>(functions))));
}

namespace {

/// Whether two eigenvalues of a block are one wherever its series hold: every coefficient of delta, a sum of
/// products of the coefficients of N = Lambda - tau I, is what rounding of those of Lambda makes of it. Near
/// a collision or a crossing, the first or the second coefficient is more.
bool are_one(const std::vector<ComplexMatrix>& Lambda, const ComplexVector& delta) {
  constexpr double rounding = 1e-14;  // of Lambda: some fifty machine epsilons
  std::vector<double> sizes, centred;
  for (ComplexMatrix N : Lambda) {
    sizes.push_back(N.norm());
    N.diagonal().array() -= 0.5 * N.trace();
    centred.push_back(N.norm());
  }
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    double products = 0.0;
    for (std::size_t i = 0; i <= k; ++i) products += centred[i] * sizes[k - i];
    if (std::abs(delta[static_cast<Eigen::Index>(k)]) > rounding * products) return false;
  }
  return true;
}

}  // namespace

ComplexMatrix block_functions(const std::vector<ComplexMatrix>& Lambda) {
  const auto count = static_cast<Eigen::Index>(Lambda.size());
  const Eigen::Index k = Lambda[0].rows();
  ComplexMatrix functions = ComplexMatrix::Zero(k <= 2 ? k : k * k, count);
  if (k != 2) {
    for (Eigen::Index i = 0; i < count; ++i)
      functions.col(i) = Lambda[static_cast<std::size_t>(i)].reshaped();
    return functions;
  }
  // delta is formed from Lambda - tau I, not from tau^2 - det: near a meeting the latter would cancel its
  // digits.
  functions.row(0) = mean_series(Lambda).transpose();
  const ComplexVector delta = discriminant_series(Lambda, 1);
  if (!are_one(Lambda, delta)) functions.row(1) = delta.transpose();
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
  if (functions.imag().isZero(0.0))
    return Eigen::EigenSolver<Matrix>(Matrix(Lambda.real()), false).eigenvalues();
  return Eigen::ComplexEigenSolver<ComplexMatrix>(Lambda, false).eigenvalues();
}

double least_gap(const ComplexVector& roots) {
  double gap = INFINITY;
  for (Eigen::Index i = 0; i < roots.size(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) gap = std::min(gap, std::abs(roots[i] - roots[j]));
  }
  return gap;
}

/// Relative error of Lambda by rounding.
constexpr double roundings = 1e-15;

Vector function_rounding(const ComplexMatrix& Lambda) {
  return function_rounding(Lambda, roundings * Lambda.norm());
}

Vector function_rounding(const ComplexMatrix& Lambda, double error) {
  const Eigen::Index k = Lambda.rows();
  // Eigenvalues of larger blocks are those of Lambda plus a rounding error of it.
  if (k > 2) error = std::max(error, roundings * Lambda.norm());
  Vector rounding = Vector::Constant(k <= 2 ? k : k * k, error);
  if (k == 2) rounding[1] *= (Lambda - 0.5 * Lambda.trace() * ComplexMatrix::Identity(2, 2)).norm();
  return rounding;
}

double root_error(const ComplexVector& functions, const Vector& errors, double least_gap) {
  const Eigen::Index k = block_size(functions.size());
  if (k == 1) return errors[0];
  if (k == 2)
    return errors[0] + errors[1] / (2.0 * std::max(std::abs(std::sqrt(functions[1])), 0.5 * least_gap));
  // Eigenvalues of Lambda change by at most the error times the condition number of the eigenvectors (Bauer &
  // Fike 1960). The condition number is limited, because it is infinite at exceptional points.
  constexpr double worst_condition = 10.0;
  const ComplexMatrix Lambda = functions.reshaped(k, k);
  const ComplexMatrix vectors = Eigen::ComplexEigenSolver<ComplexMatrix>(Lambda).eigenvectors();
  const double reciprocal = Eigen::PartialPivLU<ComplexMatrix>(vectors).rcond();
  return errors.norm() * std::min(1.0 / std::max(reciprocal, 1e-300), worst_condition);
}

namespace {

/// The x with x^k = error (nu^(k-1) + nu^(k-2) x + ... + x^(k-1)): eigenvalues of a k x k matrix whose
/// departure from normality is nu move at most so far if the matrix changes by `error` (Henrici 1962).
double henrici_bound(double error, double nu, Eigen::Index k) {
  double high = std::max(2.0 * error, 1e-300);
  const auto holds = [&](double x) {
    double sum = 0.0;
    for (Eigen::Index j = 0; j < k; ++j) sum = sum * (nu / x) + 1.0;
    return x >= error * sum;
  };
  while (!holds(high) && std::isfinite(high)) high *= 2.0;
  constexpr int halvings = 10;  // to a tenth of a per cent
  return bisected(high, error, halvings, holds).last;
}

struct Eigensystem {
  ComplexVector values;
  ComplexMatrix vectors;  ///< as columns
};

Eigensystem eigensystem(const ComplexMatrix& Lambda) {
  if (Lambda.imag().isZero(0.0)) {
    const Eigen::EigenSolver<Matrix> solver(Matrix(Lambda.real()));
    return {solver.eigenvalues(), solver.eigenvectors()};
  }
  const Eigen::ComplexEigenSolver<ComplexMatrix> solver(Lambda);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

/// First-order bounds of the errors of eigenvalues, where they hold: |y^H dLambda x| with unit x and y^H x =
/// 1, doubled for the second order, of a `roots[i]` that is farther from the others than a few of these.
/// Infinite elsewhere.
Vector first_order_errors(const ComplexMatrix& Lambda, const ComplexVector& roots, double error) {
  constexpr double small = 0.25;  // of the distance from the others
  const Eigen::Index k = roots.size();
  const auto [s, vectors] = eigensystem(Lambda);
  const ComplexMatrix inverse = vectors.inverse();
  Vector bounds(k);
  for (Eigen::Index i = 0; i < k; ++i) {
    Eigen::Index own = 0;
    (s.array() - roots[i]).abs().minCoeff(&own);
    const double bound = 2.0 * inverse.row(own).norm() * vectors.col(own).norm() * error;
    double gap = INFINITY;
    for (Eigen::Index j = 0; j < k; ++j) {
      if (j != own) gap = std::min(gap, std::abs(s[j] - s[own]));
    }
    bounds[i] = bound <= small * gap ? bound : INFINITY;
  }
  return bounds;
}

Vector errors_of_many(const ComplexMatrix& Lambda, const ComplexVector& roots, double error) {
  const double nu = std::sqrt(std::max(Lambda.squaredNorm() - roots.squaredNorm(), 0.0));
  return first_order_errors(Lambda, roots, error).cwiseMin(henrici_bound(error, nu, roots.size()));
}

}  // namespace

Vector root_errors(const ComplexVector& functions, const ComplexVector& roots, const Vector& errors) {
  const Eigen::Index k = block_size(functions.size());
  if (k == 1) return errors;
  if (k > 2) return errors_of_many(functions.reshaped(k, k), roots, errors.norm());
  // |sqrt(delta + e) - sqrt(delta)| <= min(sqrt(e), e / sqrt(|delta|))
  const double of_root = std::sqrt(errors[1]);
  const double apart = std::sqrt(std::abs(functions[1]));
  return Vector::Constant(2, errors[0] + (apart > of_root ? errors[1] / apart : of_root));
}

bool are_told_apart(const ComplexVector& functions, const ComplexVector& roots, const Vector& errors) {
  const Vector known = root_errors(functions, roots, errors);
  for (Eigen::Index i = 0; i < roots.size(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      if (!(std::abs(roots[i] - roots[j]) > known[i] + known[j])) return false;
    }
  }
  return true;
}

Vector root_resolutions(const ComplexVector& functions, const ComplexVector& roots) {
  // relative, of the corrector and of the basis that both ends of a step share
  constexpr double rounding = 1e-13;
  const Eigen::Index k = roots.size();
  if (k <= 2) return Vector::Zero(k);
  const ComplexMatrix Lambda = functions.reshaped(k, k);
  const double error = rounding * Lambda.norm();
  const Vector errors = first_order_errors(Lambda, roots, error);
  const Eigen::Index unknown = (errors.array() == INFINITY).count();
  if (unknown == 0) return Vector::Zero(k);
  // Departure from normality (Henrici 1962).
  const double departure = std::sqrt((Lambda * Lambda.adjoint() - Lambda.adjoint() * Lambda).norm());
  // Of a few, two nearly always meet at a time. Larger blocks are formed at exceptional points of their
  // order.
  constexpr Eigen::Index few = 6;
  const double order = unknown <= few ? 0.5 : 1.0 / static_cast<double>(unknown);
  const double resolution = std::pow(error, order) * std::pow(departure, 1.0 - order);
  return (errors.array() < INFINITY).select(Vector::Zero(k), Vector::Constant(k, resolution));
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
