#include "continuation/path/stiffness_determinant.hpp"

#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "core/matrix_series.hpp"
#include "core/products.hpp"
#include "steady/sparse_bordered_kkt.hpp"

namespace eigentrail {
namespace {

/// A matrix whose smallest singular value is at most about this share of its scale counts as singular, since
/// rounding determines the sign of its determinant. The value has a margin for the rounding of the
/// projection.
constexpr double regular = 1e-11;

/// A stiffness in reduced coordinates, and the norm of the terms that its entries are sums of.
struct Stiffness {
  Matrix K;
  double scale;

  double rounding() const { return regular * scale; }
};

/// Without a sign if the smallest singular value is at most `least`.
LogDeterminant determinant_of(const Matrix& K, double least) {
  if (K.size() == 0) return {};
  const Eigen::PartialPivLU<Matrix> lu(K);
  const double norm = K.cwiseAbs().colwise().sum().maxCoeff();
  if (!(lu.rcond() * norm > least)) return {};
  LogDeterminant result{static_cast<double>(lu.permutationP().determinant()), 0.0};
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
  if (!basis.parts) return {K, whole.one_norm()};
  const IndependentParts& parts = *basis.parts;
  const std::vector<Eigen::Index> held = held_freedoms(parts);
  const Matrix terms = magnitudes_of_terms(parts.left, whole.dense(), parts.right);
  return {K(held, held), held.empty() ? 0.0 : terms(held, held).colwise().sum().maxCoeff()};
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
  if (problem.model.projection() == nullptr) {
    const Stiffness stiffness = held_stiffness(point);
    return determinant_of(stiffness.K, stiffness.rounding());
  }
  return of_the_whole(at.linearization.K[0], at.linearization.A[0]);
}

LogDeterminant stiffness_determinant(const PathProblem& problem, const PathNode& node, double distance) {
  const Linearization& at = node.linearization;
  if (problem.model.projection() == nullptr) {
    const Stiffness stiffness = held_stiffness(evaluate_series(node.pencil.K, distance), node.basis, at.K[0]);
    return determinant_of(stiffness.K, stiffness.rounding());
  }
  return of_the_whole(evaluated(at.K, distance), evaluated(at.A, distance));
}

double vanishing_determinant(const PathPoint& point, const LogDeterminant& unit) {
  return determinant_of(held_stiffness(point).K, 0.0).relative_to(unit);
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
