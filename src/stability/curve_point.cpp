#include "stability/curve_point.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/matrix_series.hpp"
#include "eigentrail/modes/invariants.hpp"
#include "eigentrail/modes/matching.hpp"

namespace eigentrail {
namespace {

constexpr int most_corrections = 12;
// Lengths are in the scaled window.
constexpr double settled = 1e-14;    ///< smaller Newton corrections are rounding
constexpr double stagnated = 1e-10;  ///< corrections below this that no longer halve are rounding
constexpr double longest = 0.5;      ///< Newton's method fails if it moves farther than this
/// A reciprocal condition number of the equilibrium's stiffness below this means that a fold is near.
constexpr double near_fold = 1e-3;
/// An instability below this multiple of max(|s|, reference) counts as zero.
constexpr double vanishing = 1e-9;
/// Largest sum of two eigenvalues, relative to their size, that are opposite.
constexpr double opposite = 1e-3;

/// Sets the eigenvalue of the block with Im s >= 0 and its normalized shape.
void read_mode(const Situation& situation, CurvePoint& point) {
  const InvariantPair& pair = situation.pair;
  ComplexVector z = pair.Z.col(0);
  point.s = 0.0;
  if (pair.size() == 2) {
    const Eigen::ComplexEigenSolver<ComplexMatrix> solver(pair.Lambda);
    const Eigen::Index upper = solver.eigenvalues()[0].imag() >= 0.0 ? 0 : 1;
    const ComplexVector roots = block_roots(situation.functions.col(0).head(2));
    point.s = Complex(roots[0].real(), std::abs(roots[0].imag()));
    z = pair.Z * solver.eigenvectors().col(upper);
  }
  point.shape = situation.point.basis.shapes(normalize_shape(z, situation.pencil.M[0], {}), 0);
}

/// Sets the number of the mode, its distance from the other eigenvalues and the number of other unstable
/// modes, from the whole spectrum.
void count_others(const Window& window, const BoundaryFunction& function, const ReducedPencil& pencil,
                  CurvePoint& point, RunCounts& counts) {
  const Spectrum spectrum = compute_spectrum(pencil.M[0], pencil.C[0], pencil.K[0]);
  ++counts.spectra;
  if (spectrum.modes.empty()) return;
  std::vector<std::size_t> nearest = numbers_to(spectrum.modes.size());
  const auto distance = [&](std::size_t mode) { return std::abs(spectrum.modes[mode].s - point.s); };
  std::sort(nearest.begin(), nearest.end(),
            [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
  // What is lost without damping is zero twice, of which rounding may make s and -s.
  const auto s = [&](std::size_t i) { return spectrum.modes[nearest[i]].s; };
  const bool is_double = function.kind == BoundaryKind::divergence && nearest.size() > 1 &&
                         std::abs(s(0) + s(1)) <= opposite * std::abs(s(1));
  const std::size_t own = function.kind == BoundaryKind::coalescence || is_double ? 2 : 1;
  point.number = static_cast<int>(nearest[0]) + 1;
  point.gap = nearest.size() > own ? distance(nearest[own]) : INFINITY;
  for (std::size_t i = own; i < nearest.size(); ++i) {
    if (function.instability(s(i)) > vanishing * std::max(std::abs(s(i)), window.reference())) ++point.others;
  }
}

/// Newton's method: adds the corrections `step(situation, gradients)` until they are rounding.
template <class Step>
Situation correct(const Window& window, const BoundaryFunction& function, PlaceGuess guess, RunCounts& counts,
                  const Step& step) {
  const Place start = guess.place;
  double last = INFINITY;
  for (int i = 0; i < most_corrections; ++i) {
    Situation situation = compute_situation(window, function, guess, counts);
    if (!situation.computed()) return situation;
    const auto gradients = function_gradients(window, situation, function, counts);
    const Place move = gradients ? step(situation, *gradients) : Place::Constant(INFINITY);
    const double size = move.norm();
    if (size <= settled || (size > 0.5 * last && last <= stagnated)) return situation;
    if (!(size <= longest) || (situation.place + move - start).norm() > longest) break;
    last = size;
    guess = as_guess(situation, situation.place + move);
  }
  return failed_situation(PointStatus::mode_lost, "no point of the curve was found nearby");
}

}  // namespace

std::optional<CurvePoint> expand_curve(const Window& window, const BoundaryFunction& function,
                                       const Situation& situation, const Place& along, RunCounts& counts) {
  const auto gradients = function_gradients(window, situation, function, counts);
  if (!gradients) return std::nullopt;
  const Place slope = gradient(function, situation.functions, *gradients);
  const double steepness = slope.norm();
  if (!(steepness > 0.0)) return std::nullopt;
  const Place normal = slope / steepness;
  const Place tangent(normal.y(), -normal.x());
  const int order = window.order() + 1;
  CurvePoint point;
  point.places = Matrix::Zero(2, order + 1);
  point.places.col(0) = situation.place;
  point.places.col(1) = tangent.dot(along) < 0.0 ? Place(-tangent) : tangent;
  for (int k = 2; k <= order; ++k) {
    const auto known =
        differentiate_situation(window, situation, function, point.places.leftCols(k), k, counts);
    if (!known) return std::nullopt;
    point.places.col(k) = -function.series(known->functions)[k] / steepness * normal;
  }
  auto series = differentiate_situation(window, situation, function, point.places, order, counts);
  if (!series) return std::nullopt;
  point.path = std::move(series->node.path);
  point.mode = std::move(series->mode);
  point.functions = std::move(series->functions);
  point.left = left_vector(situation);
  point.basis = situation.point.basis.T[0];
  const KktFactorization& kkt = situation.point.equilibrium.kkt;
  point.is_beside_fold = kkt.can_solve() && kkt.reciprocal_condition() < near_fold;
  read_mode(situation, point);
  count_others(window, function, situation.point.pencil, point, counts);
  return point;
}

CurvePoint point_on_dense_curve(const Window& window, const BoundaryFunction& function,
                                const Situation& situation, const Matrix& series, const CurvePoint& neighbour,
                                RunCounts& counts) {
  CurvePoint point = neighbour;
  point.flags = 0;
  point.others = 0;
  const double speed = series.col(1).head<2>().norm();
  Matrix along = series;
  for (Eigen::Index k = 1; k < along.cols(); ++k) along.col(k) /= std::pow(speed, k);
  point.places = along.topRows(2);
  point.places.col(0) = situation.place;
  if (point.functions.rows() > 1) point.functions.topRows(2) = along.bottomRows(2).cast<Complex>();
  point.path.x.col(0) = situation.point.equilibrium.x;
  read_mode(situation, point);
  count_others(window, function, situation.point.pencil, point, counts);
  return point;
}

PlaceGuess predict(const CurvePoint& point, double h) {
  return {evaluate_series(point.places, h),
          {evaluate_series(point.path.x, h), evaluate_series(point.path.lambda, h), true},
          {evaluate_series(point.mode.Z, h), evaluate_series(point.mode.Lambda, h), point.left},
          point.basis};
}

Situation correct_along(const Window& window, const BoundaryFunction& function, PlaceGuess guess,
                        const Place& direction, RunCounts& counts) {
  const auto step = [&](const Situation& situation, const Matrix& gradients) -> Place {
    const Place slope = gradient(function, situation.functions, gradients);
    const Place along = direction.isZero(0.0) ? slope : direction;
    return -function.series(situation.functions)[0] / slope.dot(along) * along;
  };
  return correct(window, function, std::move(guess), counts, step);
}

Situation correct_to_end(const Window& window, const BoundaryFunction& function, PlaceGuess guess,
                         RunCounts& counts) {
  const auto step = [&](const Situation& situation, const Matrix& gradients) -> Place {
    const Matrix inverse = gradients.inverse();
    return -inverse * situation.functions.col(0).real();
  };
  return correct(window, function, std::move(guess), counts, step);
}

}  // namespace eigentrail
