#include "eigentrail/continuation/scene_parts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "continuation/trace/narrow_landings.hpp"
#include "eigentrail/continuation/path_point.hpp"
#include "reduction/separated_basis.hpp"

namespace eigentrail {
namespace {

/// Matrices at more places than the equations have functions of the parameter span what they are on the whole
/// range. A scene has a handful of such functions; more places cost a linearization each.
constexpr int n_places = 12;
/// The search for parts takes some dozen eigenproblems of this size, half a second in all.
constexpr Eigen::Index most_freedoms = 200;
/// Dense matrices of all coordinates at three dozen places: 300 MB.
constexpr Eigen::Index most_coordinates = 600;
/// Where an expression changes abruptly at more places than this, no parts are looked for.
constexpr std::size_t most_narrow = 24;

/// Irregular places, so that no function of the parameter vanishes at all of them by chance, and those where
/// the model changes on a small part of the range: there parts may cease to be parts.
std::vector<double> places_of(const TraceOptions& options, const std::vector<double>& narrow_ones) {
  std::vector<double> places;
  for (int i = 0; i < n_places; ++i) {
    const double share = std::fmod(0.5 + i / std::numbers::phi, 1.0);
    places.push_back(options.from + share * (options.to - options.from));
  }
  const auto [least, largest] = std::minmax(options.from, options.to);
  for (const double narrow : narrow_ones) {
    if (narrow >= least && narrow <= largest) places.push_back(narrow);
  }
  return places;
}

void add(const SystemSeries& B, bool is_constant, std::vector<Matrix>& samples) {
  if (samples.empty() || !is_constant) samples.push_back(B[0].dense());
}

/// The linearization at p if x is an equilibrium there; empty if it is not. `lambda`: the multipliers, where
/// these do not change either; becomes those at p.
std::optional<Linearization> linearize_at_rest(const PathProblem& problem, double p, const Vector& x,
                                               Vector& lambda, EvaluationCounts& counts) {
  const Vector parameters = parameters_at(problem, p);
  if (!problem.structure.fixed_equilibrium || !problem.structure.constant_constraints) {
    auto rest = find_rest(problem.model, parameters, x, counts);
    if (!rest) return std::nullopt;
    lambda = rest->lambda;
    return std::move(rest->linearization);
  }
  Linearization there;
  if (problem.model.linearize({parameters, x, lambda}, 0, there, counts)) return std::nullopt;
  return there;
}

/// By how much K, that at p, changes if all coordinates change by the largest one, in the first order, and
/// all reactions by the largest: rounding of both is so much in K.
Matrix changes_of_stiffness(const PathProblem& problem, double p, const Vector& x, const Vector& lambda,
                            const Matrix& K, EvaluationCounts& counts) {
  constexpr double small = 1e-6;
  const auto moved = [](const Vector& values, double share) -> Vector {
    if (values.size() == 0) return values;
    return values + Vector::LinSpaced(values.size(), 1.0, 2.0) * (share * values.cwiseAbs().maxCoeff());
  };
  const Vector parameters = parameters_at(problem, p);
  Linearization elsewhere, loaded;
  if (problem.model.linearize({parameters, moved(x, small), lambda}, 0, elsewhere, counts) ||
      problem.model.linearize({parameters, x, moved(lambda, 1.0)}, 0, loaded, counts))
    return {};
  return (elsewhere.K[0].dense() - K).cwiseAbs() / small + (loaded.K[0].dense() - K).cwiseAbs();
}

bool leaves_its_path(const TraceOptions& options) {
  return std::any_of(options.branch.begin(), options.branch.end(), [](int choice) { return choice != 1; });
}

/// The parts at all places so far. Where the constraints stay the same, the coordinates are constant.
std::shared_ptr<const IndependentParts> parts_at(const std::vector<PlaceOnPath>& places,
                                                 bool constant_constraints) {
  if (!constant_constraints) return find_turning_parts(places);
  CoefficientMatrices samples;
  Matrix changes = places.front().changes;
  for (const PlaceOnPath& place : places) {
    samples.M.push_back(place.M);
    samples.C.push_back(place.C);
    samples.K.push_back(place.K);
    if (place.changes.norm() > changes.norm()) changes = place.changes;
  }
  return find_independent_parts(samples, separated_basis(places.front().constraints), changes);
}

/// The parts of a scene whose equilibrium moves: the matrices at the equilibria of the range take the place
/// of coefficients. Two of them tell most scenes that do not fall apart.
std::shared_ptr<const IndependentParts> parts_of_moving_scene(const PathProblem& problem,
                                                              const TraceOptions& options,
                                                              std::vector<double> places, const Vector& x,
                                                              const Vector& lambda) {
  std::sort(places.begin(), places.end());
  if (options.to < options.from) std::reverse(places.begin(), places.end());
  RunCounts counts;
  EquilibriumGuess guess{x, lambda, true};
  std::vector<PlaceOnPath> samples;
  std::shared_ptr<const IndependentParts> parts;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const PathPoint point = reduce_at(problem, places[i], guess, Matrix(), counts);
    if (point.status != PointStatus::computed || point.pencil.size() < 2) return nullptr;
    const Linearization& there = point.equilibrium.linearization;
    if (there.K[0].is_sparse()) return nullptr;
    const Equilibrium& at = point.equilibrium;
    samples.push_back(
        {there.M[0].dense(), there.C[0].dense(), there.K[0].dense(), at.kkt.constraints(),
         changes_of_stiffness(problem, places[i], at.x, at.lambda, there.K[0].dense(), counts.evaluations)});
    guess = {point.equilibrium.x, point.equilibrium.lambda, true};
    if (i != 1 && i + 1 != places.size()) continue;
    parts = parts_at(samples, problem.structure.constant_constraints);
    if (!parts) return nullptr;
  }
  return parts;
}

}  // namespace

SceneOnRange scene_at_start(const PathProblem& problem, const TraceOptions& options) {
  RunCounts counts;
  const Vector guess = problem.model.initial_guess(parameters_at(problem, options.from));
  const PathPoint point = reduce_at(problem, options.from, {guess, Vector()}, Matrix(), counts);
  if (point.status != PointStatus::computed) return {};
  return scene_on_range(problem, options, point.equilibrium.x, point.equilibrium.lambda);
}

SceneOnRange scene_on_range(const PathProblem& problem, const TraceOptions& options, const Vector& x,
                            const Vector& lambda) {
  const Model& model = problem.model;
  if (model.n_trims() > 0) return {};
  const Structure& structure = problem.structure;
  const CoefficientMatrices known = model.coefficient_matrices(problem.parameters, problem.traced);
  const bool gives_coefficients = !known.M.empty() || !known.C.empty() || !known.K.empty();
  if (gives_coefficients || leaves_its_path(options) || problem.basis != BasisChoice::aligned) return {};
  if (model.n_coordinates() - model.n_constraints() > most_freedoms) return {};
  if (model.n_coordinates() > most_coordinates) return {};
  const std::vector<double> narrow = narrow_landings(problem, options);
  if (narrow.size() > most_narrow) return {};
  const std::vector<double> places = places_of(options, narrow);
  CoefficientMatrices samples;
  EvaluationCounts counts = model.new_counts();
  Matrix A, K;  // K where reactions are largest
  Vector reactions;
  double p = 0.0, largest = -1.0;
  for (const double place : places) {
    Vector reaction = lambda;
    const auto there = linearize_at_rest(problem, place, x, reaction, counts);
    if (there && samples.M.empty()) A = there->A[0].dense();
    if (!there || there->A[0].dense() != A)
      return {false, parts_of_moving_scene(problem, options, places, x, lambda)};
    add(there->M, structure.constant_mass, samples.M);
    add(there->C, structure.constant_damping, samples.C);
    add(there->K, structure.constant_stiffness, samples.K);
    const double size = reaction.size() > 0 ? reaction.cwiseAbs().maxCoeff() : 0.0;
    if (!(size > largest)) continue;
    largest = size;
    p = place;
    reactions = reaction;
    K = there->K[0].dense();
  }
  const ConstraintFactorization constraints{SystemMatrix(A)};
  const Eigen::Index freedoms = model.n_coordinates() - constraints.rank();
  if (freedoms < 2 || freedoms > most_freedoms) return {true, nullptr};
  return {true, find_independent_parts(samples, separated_basis(constraints),
                                       changes_of_stiffness(problem, p, x, reactions, K, counts))};
}

}  // namespace eigentrail
