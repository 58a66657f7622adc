#include "stability/boundary_mode.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/matrix_series.hpp"
#include "core/singular_vectors.hpp"
#include "eigentrail/modes/invariants.hpp"
#include "eigentrail/modes/regroup.hpp"

namespace eigentrail {
namespace {

Vector square(const Vector& a) {
  const ComplexVector series = a.cast<Complex>();
  return multiply_series(series, series).real();
}

/// The linear pencil K + g B with B = `border`, of rank one. Its only finite eigenvalue g vanishes where K is
/// singular, and is simple there.
ReducedPencil bordered(const ReducedPencil& pencil, const Matrix& border) {
  const Eigen::Index n = pencil.size();
  return {{Matrix::Zero(n, n)}, {border}, pencil.K};
}

/// A real block of a complex pair by the real and imaginary part of its vector. In the basis in which series
/// lead to it, the norm of Lambda grows where that vector becomes real, and rounding with it.
InvariantPair by_parts_of_vector(InvariantPair block) {
  if (!block.is_real || block.size() != 2) return block;
  const Eigen::EigenSolver<Matrix> solver(Matrix(block.Lambda.real()));
  const Complex s = solver.eigenvalues()[0];
  if (s.imag() == 0.0) return block;
  block.Z = (block.Z * solver.eigenvectors().col(0)).normalized();
  block.Lambda = ComplexMatrix::Constant(1, 1, s);
  return with_conjugate(block);
}

/// Reference of the relative error of the followed eigenvalue: that of the window, or the norm of K for
/// divergence, where the eigenvalue is g.
double reference(const Window& window, const BoundaryFunction& function, const ReducedPencil& pencil) {
  return function.kind == BoundaryKind::divergence ? std::max(pencil.K[0].norm(), 1e-300)
                                                   : window.reference();
}

}  // namespace

ComplexMatrix BoundaryFunction::functions(const std::vector<ComplexMatrix>& Lambda) const {
  const ComplexMatrix own = block_functions(Lambda);
  if (kind != BoundaryKind::coalescence) return own;
  ComplexMatrix all(3, own.cols());
  all.row(0) = own.row(0).real().cast<Complex>();
  all.row(1) = -square(own.row(0).imag().transpose()).transpose().cast<Complex>();
  all.row(2) = own.row(1);
  return all;
}

Vector BoundaryFunction::series(const ComplexMatrix& functions) const {
  if (kind == BoundaryKind::coalescence) return functions.row(2).real().transpose();
  const Vector tau = functions.row(0).real().transpose();
  if (kind != BoundaryKind::damping_ratio) return tau;
  const double z2 = damping_ratio * damping_ratio;
  return z2 * functions.row(1).real().transpose() + (1.0 - z2) * square(tau);
}

double BoundaryFunction::distance_to_end(double tau, double delta) const {
  if (kind == BoundaryKind::divergence || kind == BoundaryKind::coalescence) return INFINITY;
  return kind == BoundaryKind::flutter ? -delta : -tau * damping_ratio;
}

BoundaryFunction function_of(BoundaryKind kind, const BoundaryOptions& options) {
  return {kind, options.damping_ratio.value_or(0.0)};
}

Situation failed_situation(PointStatus status, const std::string& message) {
  Situation failed;
  failed.point.status = status;
  failed.point.message = message;
  return failed;
}

Situation compute_situation(const Window& window, const BoundaryFunction& function, const PlaceGuess& guess,
                            RunCounts& counts) {
  const PathProblem problem = window.at(guess.place);
  Situation result;
  result.place = guess.place;
  result.point =
      reduce_at(problem, problem.parameters[problem.traced], guess.equilibrium, guess.basis, counts);
  if (!result.computed()) return result;
  if (guess.basis.size() > 0 && result.point.pencil.size() != guess.basis.cols())
    return failed_situation(PointStatus::no_equilibrium, "the number of independent constraints changed");
  const TangentBasis& basis = result.point.basis;
  InvariantPair start;
  start.is_real = function.kind != BoundaryKind::coalescence;
  start.Z = basis.coordinates(guess.block.Z, 0);
  if (start.is_real) start.Z.imag().setZero();
  start.Lambda = guess.block.Lambda;
  result.pencil = result.point.pencil;
  result.bordered = function.kind == BoundaryKind::divergence;
  if (result.bordered) {
    const Vector b = basis.coordinates(guess.block.left.cast<Complex>(), 0).real();
    const Vector c = start.Z.real();
    result.pencil = bordered(result.point.pencil, -b * c.transpose() / (b.norm() * c.norm()));
  }
  const StageTimer timer(counts.modes_seconds);
  result.pair = correct_pair(PencilAtPoint(result.pencil), by_parts_of_vector(std::move(start)),
                             reference(window, function, result.pencil), problem.corrector, counts.modes);
  if (result.pair.status != PairStatus::converged)
    return failed_situation(PointStatus::mode_lost, "the corrector did not converge to the mode");
  result.functions = function.functions({result.pair.Lambda});
  return result;
}

Vector left_vector(const Situation& situation) {
  if (!situation.bordered) return {};
  const Eigen::Index n = situation.pencil.size();
  Matrix B = Matrix::Zero(n + 1, n + 1);
  B.topLeftCorner(n, n) = situation.pencil.K[0].transpose();
  B.topRightCorner(n, 1) = situation.pair.Z.real();
  const Vector image = situation.pencil.C[0] * situation.pair.Z.real();
  B.bottomLeftCorner(1, n) = image.transpose();
  const Vector y = B.partialPivLu().solve(Vector::Unit(n + 1, n)).head(n).normalized();
  return situation.point.basis.shapes(y.cast<Complex>(), 0).real();
}

PlaceGuess as_guess(const Situation& situation, const Place& place) {
  const PathPoint& point = situation.point;
  return {place,
          {point.equilibrium.x, point.equilibrium.lambda, true},
          {point.basis.shapes(situation.pair.Z, 0), situation.pair.Lambda, left_vector(situation)},
          point.basis.T[0]};
}

std::optional<SituationSeries> differentiate_situation(const Window& window, const Situation& situation,
                                                       const BoundaryFunction& function, const Matrix& places,
                                                       int order, RunCounts& counts) {
  PathProblem problem = window.at(situation.place);
  problem.order = order - 1;
  std::optional<PathNode> node =
      differentiate_point(problem, situation.point, window.parameters(places), counts);
  if (!node) return std::nullopt;
  const StageTimer timer(counts.differentiation_seconds);
  SituationSeries series;
  PairSeries mode = situation.bordered
                        ? differentiate_pair({situation.pencil.M, situation.pencil.C, node->pencil.K},
                                             situation.pair, order, counts.modes)
                        : differentiate_pair(node->pencil, situation.pair, order, counts.modes);
  series.functions = function.functions(mode.Lambda);
  if (!series.functions.allFinite()) return std::nullopt;
  if (!node->basis.is_identity) {
    std::vector<ComplexMatrix> T;
    for (const Matrix& coefficient : node->basis.T) T.emplace_back(coefficient.cast<Complex>());
    mode.Z = multiply_series(T, mode.Z, mode.Z.size());
  }
  series.mode = std::move(mode);
  series.node = std::move(*node);
  return series;
}

std::optional<Matrix> function_gradients(const Window& window, const Situation& situation,
                                         const BoundaryFunction& function, RunCounts& counts) {
  Matrix gradients(situation.functions.rows(), 2);
  for (int i = 0; i < 2; ++i) {
    Matrix places(2, 2);
    places << situation.place, Place::Unit(i);
    const auto series = differentiate_situation(window, situation, function, places, 1, counts);
    if (!series) return std::nullopt;
    gradients.col(i) = series->functions.col(1).real();
  }
  return gradients;
}

Place gradient(const BoundaryFunction& function, const ComplexMatrix& functions, const Matrix& gradients) {
  Place result;
  for (int i = 0; i < 2; ++i) {
    ComplexMatrix series(functions.rows(), 2);
    series << functions.col(0), gradients.col(i).cast<Complex>();
    result[i] = function.series(series)[1];
  }
  return result;
}

BoundaryBlock starting_block(BoundaryKind kind, const PathPoint& point, std::span<const StartingMode> modes) {
  const auto physical = [&point](const ComplexMatrix& Z) { return point.basis.shapes(Z, 0); };
  if (kind == BoundaryKind::divergence) {
    const SingularVectors<Matrix> svd = singular_vectors(point.pencil.K[0]);
    return {physical(svd.V.rightCols(1).cast<Complex>()), ComplexMatrix::Zero(1, 1),
            physical(svd.U.rightCols(1).cast<Complex>()).real()};
  }
  std::array<InvariantPair, 2> upper;
  for (std::size_t i = 0; i < std::min<std::size_t>(modes.size(), 2); ++i) {
    upper[i].Z = modes[i].z;
    upper[i].Lambda = ComplexMatrix::Constant(1, 1, modes[i].s);
  }
  const InvariantPair pair = kind == BoundaryKind::coalescence ? join_pairs({&upper[0], &upper[1]}, false)
                                                               : with_conjugate(upper[0]);
  return {physical(pair.Z), pair.Lambda, {}};
}

}  // namespace eigentrail
