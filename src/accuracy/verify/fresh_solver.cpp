#include "accuracy/verify/comparisons.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/point/refined_spectrum.hpp"
#include "core/positive_or_one.hpp"
#include "eigentrail/accuracy/reference.hpp"
#include "eigentrail/modes/spectrum.hpp"
#include "eigentrail/projection/route.hpp"

namespace eigentrail {
namespace {

PathProblem problem_of(const TraceSetup& setup) {
  PathProblem problem = problem_along(*setup.model, setup.options.parameter);
  problem.steady.relax = false;  // relaxation may lead to another equilibrium than the stored one
  return problem;
}

Vector row(const Matrix& rows, Eigen::Index i) {
  return rows.row(i).transpose();
}

/// A row, or between two rows; also of matrices without columns.
Vector between(const Matrix& rows, const PathPosition& position) {
  const auto node = static_cast<Eigen::Index>(position.step);
  if (position.t == 0.0 || rows.cols() == 0) return rows.cols() == 0 ? Vector(0) : row(rows, node);
  return (1.0 - position.t) * row(rows, node) + position.t * row(rows, node + 1);
}

/// Multipliers and trimmed parameters, as in Path::lambda, one row per node.
Matrix multipliers_and_trim(const LociFile& loci) {
  const Eigen::Index m = loci.multiplier.cols();
  Matrix rows(loci.multiplier.rows(), m + static_cast<Eigen::Index>(loci.trimmed.size()));
  rows.leftCols(m) = loci.multiplier;
  for (std::size_t i = 0; i < loci.trimmed.size(); ++i)
    rows.col(m + static_cast<Eigen::Index>(i)) =
        Vector::Map(loci.trimmed[i].values.data(), loci.multiplier.rows());
  return rows;
}

/// The planes perpendicular to the chord between the two points of a step.
PathPlane plane_across(const LociFile& loci, std::size_t step, const Matrix& unknowns) {
  const auto node = static_cast<Eigen::Index>(step);
  const Vector begin = row(loci.equilibrium, node);
  const Vector chord = row(loci.equilibrium, node + 1) - begin;
  const double range = loci.highest() - loci.lowest();
  const double size = std::max(begin.squaredNorm(), 1e-300);
  PathPlane plane{chord / size, (loci.p[step + 1] - loci.p[step]) / (range * range)};
  const auto n_trims = static_cast<Eigen::Index>(loci.trimmed.size());
  if (n_trims > 0) {
    const Vector sizes = unknowns.rightCols(n_trims).cwiseAbs().colwise().maxCoeff().transpose();
    const Vector change = (row(unknowns, node + 1) - row(unknowns, node)).tail(n_trims);
    plane.u = change.cwiseQuotient(sizes.cwiseAbs2().unaryExpr(&positive_or_one));
  }
  return plane;
}

/// Starting value for the equilibrium at p on a step where the path may turn back. Newton's method at
/// constant p could converge to another passage of the path. Here equilibria are computed on planes
/// perpendicular to the chord between the two points of the step, and the plane on which the equilibrium has
/// the parameter value p is found.
EquilibriumGuess guess_on_chord(const PathProblem& problem, const LociFile& loci, std::size_t step,
                                double p) {
  constexpr int most_planes = 20;
  constexpr double rounding = 1e-14;
  const Matrix unknowns = multipliers_and_trim(loci);
  const PathPlane plane = plane_across(loci, step, unknowns);
  const double p_begin = loci.p[step], p_end = loci.p[step + 1];
  EvaluationCounts counts = problem.model.new_counts();
  EquilibriumGuess guess{between(loci.equilibrium, {step, 0.0}), between(unknowns, {step, 0.0}), false};
  const auto excess_of_p = [&](double t) {
    double p_there = p_begin + t * (p_end - p_begin);
    const Equilibrium there = solve_equilibrium_on(
        plane, problem.model, parameters_at(problem, p_there), problem.traced,
        between(loci.equilibrium, {step, t}), between(unknowns, {step, t}), problem.steady, p_there, counts);
    if (there.status != SteadyStatus::converged) return 0.0;  // the guess is that of the plane before
    guess = {there.x, there.lambda, false};
    return p_there - p;
  };
  // p is monotonic on a step, because the trace stores a point at every fold: regula falsi, with half the
  // value at an end that stays (Illinois).
  double last = 0.0, other = 1.0, f_last = p_begin - p, f_other = p_end - p;
  for (int i = 0; i < most_planes && std::abs(f_last) > rounding * std::abs(p_end - p_begin); ++i) {
    const double t = (other * f_last - last * f_other) / (f_last - f_other);
    const double f = excess_of_p(t);
    if (f * f_last < 0.0) {
      other = last;
      f_other = f_last;
    } else {
      f_other *= 0.5;
    }
    last = t;
    f_last = f;
  }
  return guess;
}

/// The eigenvalues at a point by QR or QZ, refined if asked for; empty if they cannot be computed.
std::vector<Complex> eigenvalues_of(const PathPoint& point, bool refined) {
  if (point.status != PointStatus::computed) return {};
  const ReducedPencil whole{{point.pencil.M[0]}, {point.pencil.C[0]}, {point.pencil.K[0]}};
  Spectrum spectrum = refined ? compute_spectrum(whole) : compute_eigenvalues(whole);
  if (spectrum.status != SpectrumStatus::complete) return {};
  if (refined) refine(whole, static_cast<int>(spectrum.modes.size()), spectrum);
  std::vector<Complex> exact;
  for (const StartingMode& found : spectrum.modes) exact.push_back(found.s);
  return exact;
}

bool is_node(const PathPosition& position) {
  return position.t == 0.0 || position.t == 1.0;
}

}  // namespace

FreshSolver::FreshSolver(const TraceSetup& setup, const LociFile& loci)
    : problem_(problem_of(setup)), loci_(loci) {
  if (is_large(*setup.model, setup.options)) large_.emplace(*setup.model, setup.options);
}

bool FreshSolver::path_may_turn_at(const PathPosition& position) const {
  return !loci_.steps.empty() && !follows_parameter(loci_.steps[position.step]);
}

EquilibriumGuess FreshSolver::guess_at(const PathPosition& position) const {
  if (path_may_turn_at(position) && !is_node(position))
    return guess_on_chord(problem_, loci_, position.step, loci_.parameter_at(position));
  return {between(loci_.equilibrium, position), between(multipliers_and_trim(loci_), position), false};
}

PathPoint FreshSolver::point_at(const PathPosition& position) const {
  RunCounts counts;
  // At a fold the equilibrium is found on a plane only.
  std::optional<PathPlane> plane;
  if (path_may_turn_at(position) && is_node(position))
    plane = plane_across(loci_, position.step, multipliers_and_trim(loci_));
  return reduce_at(problem_, loci_.parameter_at(position), guess_at(position), Matrix(), counts, plane);
}

std::vector<Complex> FreshSolver::spectrum_at(const PathPosition& position, const ComplexVector& s) {
  if (large_) {
    const double p = loci_.parameter_at(position);
    if (problem_.model.n_coordinates() != loci_.equilibrium.cols()) return large_->beside(s, p, {}, {});
    const EquilibriumGuess guess = guess_at(position);
    return large_->beside(s, p, guess.x, guess.lambda);
  }
  return eigenvalues_of(point_at(position), false);
}

std::vector<Complex> FreshSolver::refined_spectrum_at(const PathPosition& position,
                                                      const std::optional<ComplexVector>& s) const {
  if (large_) return {};
  const ReferenceSpectrum reference =
      reference_spectrum(problem_, loci_.parameter_at(position), guess_at(position), s);
  if (reference.status != ReferenceStatus::converged) return eigenvalues_of(point_at(position), true);
  return reference.nearest_doubles();
}

}  // namespace eigentrail
