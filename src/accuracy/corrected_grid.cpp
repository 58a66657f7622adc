#include <optional>

#include "accuracy/grid_loci.hpp"
#include "eigentrail/modes/spectrum.hpp"

namespace eigentrail {
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

/// a + factor (b - a) for vectors and eigenvalues: the line through a (factor 0) and b (factor 1).
Modes along_line(const Modes& a, const Modes& b, double factor) {
  Modes result = a;
  for (std::size_t i = 0; i < a.size(); ++i) {
    result[i].Z += factor * (b[i].Z - a[i].Z);
    result[i].Lambda += factor * (b[i].Lambda - a[i].Lambda);
  }
  return result;
}

/// Moves modes and equilibrium along their first derivatives by h. Returns false if these are not finite.
bool follow_tangent(PathProblem problem, const PathPoint& point, double h, Modes& modes,
                    EquilibriumGuess& guess, RunCounts& counts) {
  problem.order = 0;  // differentiate_point computes order + 1 derivatives
  const std::optional<PathNode> node = differentiate_point(problem, point, counts);
  if (!node) return false;
  for (std::size_t i = 0; i < node->tracks.size(); ++i) {
    const PairSeries& series = node->tracks[i].series;
    modes[i].Z = series.Z[0] + h * series.Z[1];
    modes[i].Lambda = series.Lambda[0] + h * series.Lambda[1];
  }
  guess = {evaluate_series(node->path.x, h), evaluate_series(node->path.lambda, h), true};
  return true;
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
    Modes there = here;
    EquilibriumGuess guess{point->equilibrium.x, point->equilibrium.lambda, true};
    if (method == Method::secant && before) there = along_line(*before, here, 2.0);
    loci.message = "derivatives are not finite";
    if (method == Method::tangent &&
        !follow_tangent(problem, *point, p[k + 1] - p[k], there, guess, loci.counts))
      return loci;
    before = here;
    point = compute_point(problem, {p[k + 1], guess, there}, point->basis.T[0], loci.counts);
  }
  loci.message.clear();
  loci.completed = true;
  return loci;
}

}  // namespace eigentrail
