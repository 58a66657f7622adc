#include "continuation/path/stiffness_determinant.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <vector>

#include "core/matrix_series.hpp"
#include "core/products.hpp"
#include "steady/sparse_kkt.hpp"

namespace eigentrail {
namespace {

/// Error of an entry of a reduced stiffness, in units of 2.2e-16 of the magnitudes of the terms that it is a
/// sum of. As RoundingThresholds::entries.
constexpr double roundings = 10.0;

/// A stiffness in reduced coordinates, the magnitudes of the terms that its entries are sums of, and the norm
/// of the whole: in its entries stiffnesses of elements may have cancelled, of which the terms tell nothing.
struct Stiffness {
  Matrix K, terms;
  double whole;
};

/// In coordinates in which the terms of the diagonal are one: stiffnesses of very different size, as those of
/// stretching and bending, do not hide each other. Without a sign if the smallest singular value there is at
/// most `margin` times the error by rounding.
LogDeterminant determinant_of(const Stiffness& stiffness, double margin) {
  if (stiffness.K.size() == 0) return {};
  const Vector scale = stiffness.terms.diagonal().unaryExpr(
      [](double term) { return term > 0.0 ? 1.0 / std::sqrt(term) : 1.0; });
  const auto norm = [](const Matrix& A) { return A.cwiseAbs().colwise().sum().maxCoeff(); };
  const Matrix K = scale.asDiagonal() * stiffness.K * scale.asDiagonal();
  const double rounding = std::numeric_limits<double>::epsilon() *
                          (roundings * norm(scale.asDiagonal() * stiffness.terms * scale.asDiagonal()) +
                           stiffness.whole * scale.cwiseAbs2().maxCoeff());
  const Eigen::PartialPivLU<Matrix> lu(K);
  if (!(lu.rcond() * norm(K) > margin * rounding)) return {};
  LogDeterminant result{static_cast<double>(lu.permutationP().determinant()),
                        -2.0 * scale.array().log().sum()};
  for (const double pivot : lu.matrixLU().diagonal()) {
    result.sign *= pivot > 0.0 ? 1.0 : -1.0;
    result.logarithm += std::log(std::abs(pivot));
  }
  return result;
}

/// Freedoms that a force holds for some value of the parameter. The zero of the others is no branch point.
std::vector<Eigen::Index> held_freedoms(const IndependentParts& parts) {
  std::vector<Eigen::Index> held;
  for (Eigen::Index i = 0; i < parts.pattern_K.rows(); ++i) {
    if (!parts.pattern_K.row(i).isZero(0.0) || !parts.pattern_K.col(i).isZero(0.0)) held.push_back(i);
  }
  return held;
}

/// `K` in the coordinates of a basis, of the freedoms that are held. `whole`: the stiffness of which K is a
/// projection.
Stiffness held_stiffness(const Matrix& K, const TangentBasis& basis, const SystemMatrix& whole) {
  const double norm = whole.one_norm();
  if (basis.is_identity) return {K, whole.dense().cwiseAbs(), norm};
  if (!basis.parts) return {K, magnitudes_of_terms(basis.T[0], whole.dense(), basis.T[0]), norm};
  const IndependentParts& parts = *basis.parts;
  const std::vector<Eigen::Index> held = held_freedoms(parts);
  const Matrix terms = magnitudes_of_terms(parts.left, whole.dense(), parts.right);
  return {K(held, held), terms(held, held), norm};
}

Stiffness held_stiffness(const PathPoint& point) {
  return held_stiffness(point.pencil.K[0], point.basis, point.equilibrium.linearization.K[0]);
}

SystemMatrix evaluated(const SystemSeries& series, double h) {
  SystemMatrix sum = series[0];
  double power = h;
  for (std::size_t k = 1; k < series.size(); ++k, power *= h) sum.add_scaled(power, series[k]);
  return sum;
}

LogDeterminant of_the_whole(const SystemMatrix& K, const SystemMatrix& A) {
  const auto kkt = SparseKkt::factor(K.sparse(), A.sparse());
  return kkt ? kkt->determinant() : LogDeterminant();
}

}  // namespace

LogDeterminant stiffness_determinant(const PathProblem& problem, const PathPoint& point) {
  const Equilibrium& at = point.equilibrium;
  if (problem.model.projection() == nullptr) return determinant_of(held_stiffness(point), 1.0);
  return of_the_whole(at.linearization.K[0], at.linearization.A[0]);
}

LogDeterminant stiffness_determinant(const PathProblem& problem, const PathNode& node, double distance) {
  const Linearization& at = node.linearization;
  if (problem.model.projection() == nullptr)
    return determinant_of(held_stiffness(evaluate_series(node.pencil.K, distance), node.basis, at.K[0]), 1.0);
  return of_the_whole(evaluated(at.K, distance), evaluated(at.A, distance));
}

double vanishing_determinant(const PathPoint& point, const LogDeterminant& unit) {
  return determinant_of(held_stiffness(point), 0.0).relative_to(unit);
}

double WholeSingularity::operator()(const PathPoint& point) {
  const SparseMatrix& K = point.equilibrium.linearization.K[0].sparse();
  const SparseMatrix& A = point.equilibrium.linearization.A[0].sparse();
  if (!kernel_) kernel_ = kkt_kernel(K, A);
  return kernel_ ? singularity_test(K, A, *kernel_) : 0.0;
}

bool holds_anything(const PathPoint& point) {
  return !point.basis.parts || !held_freedoms(*point.basis.parts).empty();
}

}  // namespace eigentrail
