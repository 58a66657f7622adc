#include "eigentrail/continuation/scene_parts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "eigentrail/continuation/path_point.hpp"

namespace eigentrail {
namespace {

/// Matrices at more places than the equations have functions of the parameter span what they are on the whole
/// range. A scene has a handful of such functions; more places cost a linearization each.
constexpr int n_places = 12;
/// The search for parts takes some dozen eigenproblems of this size, half a second in all.
constexpr Eigen::Index most_freedoms = 200;

/// Irregular places, so that no function of the parameter vanishes at all of them by chance.
double place(const TraceOptions& options, int i) {
  const double share = std::fmod(0.5 + i / std::numbers::phi, 1.0);
  return options.from + share * (options.to - options.from);
}

void add(const SystemSeries& B, bool is_constant, std::vector<Matrix>& samples) {
  if (samples.empty() || !is_constant) samples.push_back(B[0].dense());
}

/// The equilibrium at p if positions and constraints there are those of `start`; empty if they are not.
std::optional<Path> resting_path(const PathProblem& problem, double p, const Path& start,
                                 EvaluationCounts& counts) {
  const Structure& structure = problem.structure;
  if (structure.fixed_equilibrium && structure.constant_constraints)
    return Path{parameters_at(problem, p), start.x, start.lambda};
  const auto rest = find_rest(problem.model, parameters_at(problem, p), start.x.col(0), counts);
  if (!rest) return std::nullopt;
  return Path{parameters_at(problem, p), start.x, rest->lambda};
}

bool leaves_its_path(const TraceOptions& options) {
  return std::any_of(options.branch.begin(), options.branch.end(), [](int choice) { return choice != 1; });
}

}  // namespace

SceneOnRange scene_on_range(const PathProblem& problem, const TraceOptions& options, const Vector& x,
                            const Vector& lambda) {
  const Model& model = problem.model;
  const Structure& structure = problem.structure;
  const CoefficientMatrices known = model.coefficient_matrices(problem.parameters, problem.traced);
  const bool gives_coefficients = !known.M.empty() || !known.C.empty() || !known.K.empty();
  if (gives_coefficients || leaves_its_path(options) || problem.basis != BasisChoice::aligned) return {};
  if (model.n_coordinates() - model.n_constraints() > most_freedoms) return {};
  CoefficientMatrices samples;
  EvaluationCounts counts = model.new_counts();
  Linearization there;
  std::optional<Matrix> A;
  for (int i = 0; i < n_places; ++i) {
    const auto at = resting_path(problem, place(options, i), {{}, x, lambda}, counts);
    if (!at || model.linearize(*at, 0, there, counts)) return {};
    if (there.A[0].is_sparse()) return {};
    if (!A) A = there.A[0].dense();
    if (there.A[0].dense() != *A) return {};
    add(there.M, structure.constant_mass, samples.M);
    add(there.C, structure.constant_damping, samples.C);
    add(there.K, structure.constant_stiffness, samples.K);
  }
  const ConstraintFactorization constraints(there.A[0]);
  const Eigen::Index freedoms = model.n_coordinates() - constraints.rank();
  if (freedoms < 2 || freedoms > most_freedoms) return {true, nullptr};
  return {true, find_independent_parts(samples, constraints.null_basis())};
}

}  // namespace eigentrail
