#include "eigentrail/continuation/scene_parts.hpp"

#include <cmath>
#include <numbers>

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

}  // namespace

std::shared_ptr<const IndependentParts> parts_on_range(const PathProblem& problem,
                                                       const TraceOptions& options, const Vector& x,
                                                       const Vector& lambda) {
  const Model& model = problem.model;
  const Structure& structure = problem.structure;
  const CoefficientMatrices known = model.coefficient_matrices(problem.parameters, problem.traced);
  const bool gives_coefficients = !known.M.empty() || !known.C.empty() || !known.K.empty();
  const bool rests = structure.fixed_equilibrium && structure.constant_constraints;
  if (gives_coefficients || !rests || problem.basis != BasisChoice::aligned) return nullptr;
  if (model.n_coordinates() - model.n_constraints() > most_freedoms) return nullptr;
  CoefficientMatrices samples;
  EvaluationCounts counts = model.new_counts();
  Linearization there;
  for (int i = 0; i < n_places; ++i) {
    const Path at{parameters_at(problem, place(options, i)), x, lambda};
    if (model.linearize(at, 0, there, counts)) return nullptr;
    add(there.M, structure.constant_mass, samples.M);
    add(there.C, structure.constant_damping, samples.C);
    add(there.K, structure.constant_stiffness, samples.K);
  }
  const ConstraintFactorization constraints(there.A[0]);
  const Eigen::Index freedoms = model.n_coordinates() - constraints.rank();
  if (freedoms < 2 || freedoms > most_freedoms) return nullptr;
  return find_independent_parts(samples, constraints.null_basis());
}

}  // namespace eigentrail
