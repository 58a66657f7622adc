#include "accuracy/grid_loci.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "continuation/point/point_solver.hpp"
#include "eigentrail/modes/matching.hpp"
#include "eigentrail/modes/spectrum.hpp"

namespace eigentrail {
namespace {

/// The whole spectrum at a point, with both members of complex pairs.
struct GridPoint {
  ComplexVector s;
  ComplexMatrix shapes;  ///< columns: mode shapes in physical coordinates, v = T z
  SystemMatrix mass;     ///< mass matrix, the weight of the modal assurance criterion
};

/// Number of eigenvalues of the first `count` modes, both members of complex pairs counted.
Eigen::Index n_members(const Spectrum& spectrum, std::size_t count) {
  const auto complex = std::count_if(spectrum.modes.begin(), spectrum.modes.begin() + count,
                                     [](const StartingMode& mode) { return mode.s.imag() != 0.0; });
  return static_cast<Eigen::Index>(count) + complex;
}

GridPoint members_of(const Spectrum& spectrum, const PathPoint& point) {
  const Eigen::Index count = n_members(spectrum, spectrum.modes.size());
  GridPoint result{ComplexVector(count), ComplexMatrix(point.basis.T[0].rows(), count),
                   point.equilibrium.linearization.M[0]};
  Eigen::Index at = 0;
  for (const StartingMode& mode : spectrum.modes) {
    const ComplexVector v = point.basis.T[0].cast<Complex>() * mode.z;
    result.s[at] = mode.s;
    result.shapes.col(at++) = v;
    if (mode.s.imag() == 0.0) continue;
    result.s[at] = std::conj(mode.s);
    result.shapes.col(at++) = v.conjugate();
  }
  return result;
}

/// Cost of matching modes: 1 - MAC, with the modal assurance criterion MAC. An eigenvalue above the real axis
/// is not matched with one below: the conjugate of backward whirl has the same shape as forward whirl.
Matrix disagreement(const GridPoint& last, const GridPoint& next) {
  Matrix cost = 1.0 - modal_assurance(last.shapes, next.shapes, next.mass).array();
  for (Eigen::Index i = 0; i < cost.rows(); ++i) {
    for (Eigen::Index j = 0; j < cost.cols(); ++j) {
      if (last.s[i].imag() * next.s[j].imag() < 0.0) cost(i, j) += 10.0;  // 1 - MAC is at most 1
      if (!std::isfinite(cost(i, j))) cost(i, j) = 1.0;
    }
  }
  return cost;
}

/// The point `next` with its modes in the order of those of `last`.
GridPoint in_order(const GridPoint& last, const GridPoint& next) {
  const std::vector<int> successor = optimal_assignment(disagreement(last, next));
  return {next.s(successor), next.shapes(Eigen::all, successor), next.mass};
}

}  // namespace

GridLoci qz_grid(const PathProblem& problem, const std::vector<double>& p, const ModeChoice& modes) {
  GridLoci loci;
  Eigen::Index followed = 0;
  loci.both_members = true;
  EquilibriumGuess guess{problem.model.initial_guess(parameters_at(problem, p.front())), {}, false};
  GridPoint last;
  for (const double value : p) {
    const PathPoint point = reduce_at(problem, value, guess, Matrix(), loci.counts);
    loci.message = point.message;
    if (point.status != PointStatus::computed) return loci;
    guess = {point.equilibrium.x, point.equilibrium.lambda, true};
    Spectrum spectrum = compute_spectrum(point.pencil.M[0], point.pencil.C[0], point.pencil.K[0]);
    ++loci.counts.spectra;
    loci.message = "QZ did not yield a spectrum";
    if (spectrum.status != SpectrumStatus::complete) return loci;
    if (loci.p.empty())  // the chosen modes come first
      followed = n_members(spectrum, static_cast<std::size_t>(choose_modes(modes, spectrum.modes)));
    GridPoint next = members_of(spectrum, point);
    loci.message = "the number of finite eigenvalues changes";
    if (!loci.p.empty() && next.s.size() != last.s.size()) return loci;
    last = loci.p.empty() ? std::move(next) : in_order(last, next);
    loci.p.push_back(value);
    loci.s.emplace_back(last.s.head(followed));
  }
  loci.message.clear();
  loci.completed = true;
  return loci;
}

namespace {

/// The followed modes, Z in physical coordinates.
using Modes = std::vector<InvariantPair>;

Modes modes_of(const PathPoint& point) {
  Modes modes(point.pairs.size());
  for (std::size_t i = 0; i < modes.size(); ++i) {
    modes[i].is_real = point.pairs[i].is_real;
    modes[i].Z = point.shapes(i);
    modes[i].Lambda = point.pairs[i].Lambda;
  }
  return modes;
}

/// The place on the line through a and b, of vectors and eigenvalues, that is as far behind b as a before it.
Modes along_secant(const Modes& a, const Modes& b) {
  Modes result = a;
  for (std::size_t i = 0; i < a.size(); ++i) {
    result[i].Z += 2.0 * (b[i].Z - a[i].Z);
    result[i].Lambda += 2.0 * (b[i].Lambda - a[i].Lambda);
  }
  return result;
}

/// Modes and equilibrium along their first derivatives, at distance h; empty if these are not finite.
std::optional<Prediction> along_tangent(PathProblem problem, const PathPoint& point, double h,
                                        RunCounts& counts) {
  problem.order = 0;  // differentiate_point computes order + 1 derivatives
  const std::optional<PathNode> node = differentiate_point(problem, point, counts);
  if (!node) return std::nullopt;
  const PathFrame frame{};
  return PointSolver(problem, frame, counts).predict(all_tracks(*node), h);
}

/// The first point, with modes from the full spectrum; empty if there is no equilibrium or spectrum.
std::optional<PathPoint> first_point(const PathProblem& problem, double p, const ModeChoice& modes,
                                     RunCounts& counts) {
  const EquilibriumGuess guess{problem.model.initial_guess(parameters_at(problem, p)), {}, false};
  const PathPoint reduced = reduce_at(problem, p, guess, Matrix(), counts);
  if (reduced.status != PointStatus::computed) return std::nullopt;
  Spectrum spectrum = compute_spectrum(reduced.pencil.M[0], reduced.pencil.C[0], reduced.pencil.K[0]);
  ++counts.spectra;
  if (spectrum.status != SpectrumStatus::complete) return std::nullopt;
  Prediction prediction{p, {reduced.equilibrium.x, reduced.equilibrium.lambda, true}, {}};
  spectrum.modes.resize(static_cast<std::size_t>(choose_modes(modes, spectrum.modes)));
  for (const StartingMode& mode : spectrum.modes) {
    InvariantPair& pair = prediction.pairs.emplace_back();
    pair.Z = reduced.basis.T[0].cast<Complex>() * mode.z;
    pair.Lambda = ComplexMatrix::Constant(1, 1, mode.s);
  }
  return compute_point(problem, prediction, reduced.basis.T[0], counts);
}

}  // namespace

GridLoci corrected_grid(const PathProblem& problem, const std::vector<double>& p, const ModeChoice& modes,
                        Method method) {
  GridLoci loci;
  std::optional<PathPoint> point = first_point(problem, p.front(), modes, loci.counts);
  loci.message = "no modes at the start";
  if (!point) return loci;
  std::optional<Modes> before;
  for (std::size_t k = 0;; ++k) {
    loci.message = point->message;
    if (point->status != PointStatus::computed) return loci;
    ComplexVector s(static_cast<Eigen::Index>(point->pairs.size()));
    for (Eigen::Index i = 0; i < s.size(); ++i) s[i] = point->pairs[static_cast<std::size_t>(i)].eigenvalue();
    loci.p.push_back(p[k]);
    loci.s.push_back(s);
    if (k + 1 == p.size()) break;
    const Modes here = modes_of(*point);
    std::optional<Prediction> next =
        Prediction{p[k + 1], {point->equilibrium.x, point->equilibrium.lambda, true}, here};
    if (method == Method::secant && before) next->pairs = along_secant(*before, here);
    if (method == Method::tangent) next = along_tangent(problem, *point, p[k + 1] - p[k], loci.counts);
    loci.message = "derivatives are not finite";
    if (!next) return loci;
    next->p = p[k + 1];
    before = here;
    point = compute_point(problem, *next, point->basis.T[0], loci.counts);
  }
  loci.message.clear();
  loci.completed = true;
  return loci;
}

}  // namespace eigentrail
