#include "eigentrail/projection/route.hpp"

#include <algorithm>

#include "eigentrail/continuation/route_choice.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/projection/project.hpp"
#include "eigentrail/scene/limits.hpp"
#include "model/multibody.hpp"
#include "model/recorded_equations.hpp"
#include "projection/family_pencils.hpp"
#include "projection/large_model.hpp"

namespace eigentrail {
namespace {

/// Bytes of an entry of a sparse matrix.
constexpr double entry_bytes = sizeof(double) + sizeof(int);

/// Modes that a band without a number is taken to have.
constexpr int modes_of_a_band = 8;

int followed_modes(const TraceOptions& trace) {
  return trace.modes.count.value_or(modes_of_a_band);
}

/// The followed modes, and the spare ones whose vectors the space holds as well.
int kept_modes(const TraceOptions& trace) {
  return followed_modes(trace) + ProjectionOptions().spare_modes;
}

Vector parameters_in_the_middle(const Model& model, const TraceOptions& trace) {
  return parameters_at(model, trace, {}, 0.5 * (trace.from + trace.to));
}

ProjectionEstimate estimate_of(const SparsePencil& pencil, const TraceOptions& trace,
                               const SparseSolverMaker& solver) {
  const ShiftedMatrix shifted = shifted_matrix(pencil, {});
  const FactorEstimate factors = make_solver(solver)->estimate(shifted.matrix, shifted.kind);
  ProjectionEstimate estimate;
  estimate.freedoms = pencil.freedoms();
  estimate.nonzeros = pencil.M.nonZeros() + pencil.C.nonZeros() + pencil.K.nonZeros() + pencil.A.nonZeros();
  estimate.two_sided = !pencil.one_sided;
  estimate.method = factors.method;
  estimate.factor_bytes = factors.bytes;
  estimate.factor_operations = factors.operations;
  // Arnoldi: four vectors of positions and velocities per mode; the space: about six samples of each.
  const double vectors = kept_modes(trace) * (8.0 + 12.0 * (estimate.two_sided ? 2.0 : 1.0));
  estimate.total_bytes = factors.bytes + 3.0 * static_cast<double>(estimate.nonzeros) * entry_bytes +
                         vectors * static_cast<double>(pencil.size()) * sizeof(double);
  estimate.target = ProjectionOptions().share_of_tolerance * trace.tolerance;
  return estimate;
}

ProjectionEstimate estimate_of_scene(const Model& scene, const TraceOptions& trace,
                                     const SparseSolverMaker& solver) {
  const Vector values = parameters_in_the_middle(scene, trace);
  const Structure structure = scene.structure(scene.description().parameters.index(trace.parameter).value());
  Linearization at;
  EvaluationCounts counts = scene.new_counts();
  const Path guess{values, scene.initial_guess(values), Vector::Zero(scene.n_constraints())};
  if (const EvaluationFault fault = scene.linearize(guess, 0, at, counts))
    throw NotProjected("a number that is not finite came out of " + fault.source);
  SparsePencil pencil{at.M[0].sparse(), at.C[0].sparse(), at.K[0].sparse()};
  pencil.one_sided = !structure.circulatory && !(structure.gyroscopic && structure.damped);
  pencil.A = at.A[0].sparse();
  ProjectionEstimate estimate = estimate_of(pencil, trace, solver);
  estimate.coordinates = scene.n_coordinates();
  estimate.moves = !structure.fixed_equilibrium && !structure.known_equilibrium;
  // Series of the matrices and of the basis, at both ends of a step and at a point that is tried.
  constexpr double kept_points = 3.0, coefficients = 6.0, most_coordinates_per_mode = 6.0;
  estimate.total_bytes +=
      kept_points * coefficients *
      (static_cast<double>(estimate.nonzeros) * entry_bytes +
       most_coordinates_per_mode * kept_modes(trace) * static_cast<double>(pencil.size()) * sizeof(double));
  return estimate;
}

// The figures below are measured with `eigentrail_bench --only crossover` (performance.md). They affect only
// which way is taken, and so the time of a trace.

/// Points of a trace.
constexpr double points = 20.0;
/// Corrections and series once more, for the certificate; and what each mode costs at a point of the smallest
/// model: events, products of small matrices.
constexpr double with_certificate = 1.4, least_per_mode = 1e6;
/// The spectrum at the first point, times the cube of the number of freedoms.
constexpr double first_spectrum = 40.0;
/// Series of the elements of a scene, per nonzero and point.
constexpr double series_of_elements = 15000.0;
/// Coordinates of a projected model for each mode that is kept.
constexpr double coordinates_per_mode = 3.5;
/// Places at which modes are sampled, and back-substitutions for each mode there.
constexpr double samples = 4.0, solutions_per_mode = 8.0;
/// All traces of a projected model, the rough ones included, in that of the last one.
constexpr double with_rough_traces = 2.5;

/// One trace of `modes` modes of a model with n freedoms.
double of_trace(double n, int modes) {
  const auto freedoms = static_cast<Eigen::Index>(n);
  const double at_a_point = route_work(ModeRoute::one_by_one, {}, {freedoms, modes});
  return first_spectrum * n * n * n + points * (with_certificate * at_a_point + modes * least_per_mode);
}

/// Complex factors, and their back-substitutions.
double of_samples(const ProjectionEstimate& estimate, int modes) {
  const double entries = estimate.factor_bytes / sizeof(double);
  const double sides = estimate.two_sided ? 2.0 : 1.0;
  return samples * (4.0 * estimate.factor_operations + sides * solutions_per_mode * modes * 4.0 * entries);
}

bool is_worth_projecting(const TraceWork& work) {
  return work.dense > worth_projecting * work.projected;
}

/// The way by counted work of a model that could take both.
Route cheaper_route(const Model& model, const TraceOptions& trace) {
  ProjectionEstimate estimate;
  estimate.freedoms = model.n_coordinates() - model.n_constraints();
  TraceWork work = trace_work(estimate, trace);  // without what only an analysis of the matrices tells
  if (is_worth_projecting(work)) {
    estimate = estimate_projection(model, trace);
    work = trace_work(estimate, trace);
  }
  return {is_worth_projecting(work), work};
}

}  // namespace

ProjectionEstimate estimate_projection(const Model& model, const TraceOptions& trace,
                                       const SparseSolverMaker& solver) {
  const auto* family = dynamic_cast<const SparseFamily*>(&model);
  if (family == nullptr) return estimate_of_scene(model, trace, solver);
  const Vector values = parameters_in_the_middle(*family, trace);
  return estimate_of(FamilyPencils(*family).at(values), trace, solver);
}

TraceWork trace_work(const ProjectionEstimate& estimate, const TraceOptions& trace) {
  const auto n = static_cast<double>(estimate.freedoms);
  const int modes = std::min(followed_modes(trace), static_cast<int>(estimate.freedoms));
  const double projected = std::min(n, coordinates_per_mode * kept_modes(trace));
  const double elements =
      estimate.coordinates > 0 ? points * series_of_elements * static_cast<double>(estimate.nonzeros) : 0.0;
  return {of_trace(n, modes) + elements, with_rough_traces * (of_trace(projected, modes) + elements) +
                                             of_samples(estimate, kept_modes(trace))};
}

Route route_of(const Model& model, const TraceOptions& trace) {
  const bool is_family = dynamic_cast<const SparseFamily*>(&model) != nullptr;
  const bool has_bodies = dynamic_cast<const Multibody*>(&model) != nullptr;
  const bool is_sparse = is_family || (has_bodies && model.n_coordinates() >= sparse_from);
  if (!is_sparse || model.n_trims() > 0) return {};
  const bool fits = model.n_coordinates() <= limits::matrix_rows;
  if (!trace.modes.count && !trace.modes.band) {
    if (!fits) refuse_all_modes(model);
    return {};
  }
  if (!fits) return {true, {}};
  return cheaper_route(model, trace);
}

void refuse_all_modes(const Model& model) {
  throw InputError("a large model with " + std::to_string(model.n_coordinates()) +
                   (model.n_constraints() > 0 ? " coordinates" : " freedoms") +
                   ", of which all modes are asked for: follow some of them, with modes = 6 or modes = "
                   "{ band = [\"0 Hz\", \"50 Hz\"] } in [trace], or --modes 6");
}

const SparseFamily* large_family(const Model& model, const TraceOptions& trace) {
  const auto* family = dynamic_cast<const SparseFamily*>(&model);
  return family != nullptr && is_large(model, trace) ? family : nullptr;
}

}  // namespace eigentrail
