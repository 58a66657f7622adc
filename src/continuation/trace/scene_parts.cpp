#include "eigentrail/continuation/scene_parts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/modes/spectrum.hpp"
#include "reduction/separated_basis.hpp"
#include "scene/narrow_places.hpp"

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
/// Share of the range by which a trace stays away from a kink; the step across it is twice as long.
constexpr double beside_kink = 1e-11;

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

std::vector<double> narrow_landings(const PathProblem& problem, const TraceOptions& options) {
  const Model& model = problem.model;
  std::vector<double> places = narrow_places(model.description().parameters, problem.parameters,
                                             problem.traced, options.from, options.to, model.expressions());
  const double beside = beside_kink * std::abs(options.to - options.from);
  for (const double kink : model.kinks(problem.traced)) {
    places.push_back(kink - beside);
    places.push_back(kink + beside);
  }
  for (const double place : model.landings(problem.traced)) places.push_back(place);
  std::sort(places.begin(), places.end());
  return places;
}

namespace {

/// An eigenvalue is near the real axis if its imaginary part is below this share of its magnitude: a mode
/// that is damped nearly critically. With a smaller value an eigenvalue below the axis might be met; with a
/// larger one more pairs are followed as real parts, which costs time.
constexpr double near_axis = 1e-2;
/// The same as a share of the median magnitude, for eigenvalues that pass through zero.
constexpr double near_zero = 1e-3;

/// The ends of the range and some irregular places. An eigenvalue that is near the axis between them only is
/// noticed when the trace comes there.
std::vector<double> places_of(const TraceOptions& options) {
  constexpr int n_within = 3;
  std::vector<double> places{options.from, options.to};
  for (int i = 1; i <= n_within; ++i) {
    const double share = std::fmod(i / std::numbers::phi, 1.0);
    places.push_back(options.from + share * (options.to - options.from));
  }
  return places;
}

double median_magnitude(const std::vector<StartingMode>& by_magnitude) {
  return by_magnitude.empty() ? 0.0 : std::abs(by_magnitude[by_magnitude.size() / 2].s);
}

/// The number of modes of a complex part at a place; empty if one of them is near the real axis, or infinite
/// without being so by the form of the equations.
std::optional<std::size_t> modes_of_complex_part(const ReducedPencil& part) {
  const Spectrum spectrum = compute_eigenvalues(part);
  const Eigen::Index structural = part.size() - state_size(part.M[0]) / 2;
  if (spectrum.status != SpectrumStatus::complete || spectrum.n_infinite != (1 + part.copies) * structural)
    return std::nullopt;
  const double smallest = near_zero * median_magnitude(spectrum.modes);
  const bool apart =
      std::none_of(spectrum.modes.begin(), spectrum.modes.end(),
                   [&](const StartingMode& mode) { return is_near_real_axis(mode.s, smallest); });
  return apart ? std::optional(spectrum.modes.size()) : std::nullopt;
}

/// The pencil of a family at a place; empty if it cannot be computed.
std::optional<ReducedPencil> pencil_at(const PathProblem& problem, double p,
                                       const std::shared_ptr<const IndependentParts>& parts,
                                       EvaluationCounts& counts) {
  const Vector parameters = parameters_at(problem, p);
  Linearization there;
  if (problem.model.linearize({parameters, problem.model.initial_guess(parameters), Vector()}, 0, there,
                              counts))
    return std::nullopt;
  return reduce(there, basis_of(parts), 0);
}

/// For every part, whether it is half of a pair that has to be followed as one real part.
std::vector<bool> real_pairs(const PathProblem& problem, const TraceOptions& options,
                             const std::shared_ptr<const IndependentParts>& parts) {
  std::vector<bool> is_real(parts->count(), false);
  std::vector<std::size_t> modes(parts->count(), 0);
  EvaluationCounts counts = problem.model.new_counts();
  const std::vector<double> places = places_of(options);
  for (const double p : places) {
    const std::optional<ReducedPencil> pencil = pencil_at(problem, p, parts, counts);
    for (std::size_t i = 0; i < parts->count(); ++i) {
      if (parts->ranges[i].complex_sign == 0 || is_real[i]) continue;
      const auto count = pencil ? modes_of_complex_part(pencil->parts[i]) : std::nullopt;
      const bool passes_axis = p != places.front() && count && *count != modes[i];
      if (count) modes[i] = *count;
      if (count && !passes_axis) continue;
      is_real[i] = true;
      is_real[parts->ranges[i].complex_sign > 0 ? i + 1 : i - 1] = true;
    }
  }
  return is_real;
}

bool has_complex_parts(const IndependentParts* parts) {
  return parts != nullptr && std::any_of(parts->ranges.begin(), parts->ranges.end(),
                                         [](const auto& range) { return range.complex_sign != 0; });
}

}  // namespace

bool is_near_real_axis(Complex s, double smallest) {
  return !(std::abs(s.imag()) > std::max(near_axis * std::abs(s), smallest));
}

std::shared_ptr<const IndependentParts> parts_of_family(const PathProblem& problem,
                                                        const TraceOptions& options) {
  const CoefficientMatrices coefficients =
      problem.model.coefficient_matrices(problem.parameters, problem.traced);
  const std::shared_ptr<const IndependentParts> parts = find_independent_parts(coefficients);
  if (!problem.structure.fixed_equilibrium || problem.model.n_constraints() > 0) return parts;
  const auto pairs = find_conjugate_parts(coefficients, parts.get());
  if (!pairs) return parts;
  std::vector<int> numbers;
  auto chosen = joined_pairs(*pairs, real_pairs(problem, options, pairs), numbers);
  return has_complex_parts(chosen.get()) ? chosen : parts;
}

}  // namespace eigentrail
