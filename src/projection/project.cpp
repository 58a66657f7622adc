#include "eigentrail/projection/project.hpp"

#include "eigentrail/scene/limits.hpp"
#include "model/multibody.hpp"
#include "projection/family_pencils.hpp"

namespace eigentrail {

ProjectedFamily::ProjectedFamily(ModelDescription description, AffinePencil<Matrix> pencil,
                                 Projection projection)
    : AffineFamily<Matrix>(std::move(description), std::move(pencil)), projection_(std::move(projection)) {}

namespace {

void replace_all_but_space(Projection& projection, Projection outcome) {
  outcome.basis = std::move(projection.basis);
  outcome.motions = std::move(projection.motions);
  outcome.freedoms = projection.freedoms;
  outcome.names = std::move(projection.names);
  projection = std::move(outcome);
}

}  // namespace

void ProjectedFamily::settle(Projection outcome) {
  replace_all_but_space(projection_, std::move(outcome));
}

Matrix ProjectedFamily::take_basis() {
  return std::move(projection_.basis);
}

Matrix ProjectedScene::take_basis() {
  return std::move(projection_.motions->basis);
}

void ProjectedScene::settle(Projection outcome) {
  replace_all_but_space(projection_, std::move(outcome));
}

ProjectedScene::ProjectedScene(std::shared_ptr<const Model> scene, Projection projection, Path first)
    : Model(scene->description()),
      scene_(std::move(scene)),
      projection_(std::move(projection)),
      first_(std::move(first)) {}

Vector ProjectedScene::initial_guess(const Vector& parameters) const {
  return parameters == first_.parameters.col(0) ? Vector(first_.x.col(0)) : scene_->initial_guess(parameters);
}

EvaluationFault ProjectedScene::residual(const Path& path, int order, SteadyResidual& result,
                                         EvaluationCounts& counts) const {
  return scene_->residual(path, order, result, counts);
}

EvaluationFault ProjectedScene::linearize(const Path& path, int order, Linearization& result,
                                          EvaluationCounts& counts) const {
  return scene_->linearize(path, order, result, counts);
}

std::vector<ParameterValues> lines_over(const TraceOptions& trace, const std::string& second, double from,
                                        double to) {
  constexpr int count = 5;
  std::vector<ParameterValues> lines(count, trace.values);
  for (int i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / (count - 1);
    lines[static_cast<std::size_t>(i)][second] = (1.0 - share) * from + share * to;
  }
  return lines;
}

namespace {

/// Bytes of an entry of a sparse matrix.
constexpr double entry_bytes = sizeof(double) + sizeof(int);

Vector parameters_in_the_middle(const Parameters& parameters, const TraceOptions& trace) {
  Vector values = parameters.declared_values();
  values[parameters.index(trace.parameter).value()] = 0.5 * (trace.from + trace.to);
  return values;
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
  const int modes = trace.modes.count.value_or(8) + ProjectionOptions().spare_modes;
  const double vectors = modes * (8.0 + 12.0 * (estimate.two_sided ? 2.0 : 1.0));
  estimate.total_bytes = factors.bytes + 3.0 * static_cast<double>(estimate.nonzeros) * entry_bytes +
                         vectors * static_cast<double>(pencil.size()) * sizeof(double);
  estimate.target = ProjectionOptions().share_of_tolerance * trace.tolerance;
  return estimate;
}

}  // namespace

ProjectionEstimate estimate_projection(const SparseFamily& family, const TraceOptions& trace,
                                       const SparseSolverMaker& solver) {
  const Vector values = parameters_in_the_middle(family.description().parameters, trace);
  return estimate_of(FamilyPencils(family).at(values), trace, solver);
}

ProjectionEstimate estimate_projection(const Model& scene, const TraceOptions& trace,
                                       const SparseSolverMaker& solver) {
  const Parameters& parameters = scene.description().parameters;
  const Vector values = parameters_in_the_middle(parameters, trace);
  const Structure structure = scene.structure(parameters.index(trace.parameter).value());
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
  constexpr double points = 3.0, coefficients = 6.0, coordinates_per_mode = 6.0;
  const int modes = trace.modes.count.value_or(8) + ProjectionOptions().spare_modes;
  estimate.total_bytes +=
      points * coefficients *
      (static_cast<double>(estimate.nonzeros) * entry_bytes +
       coordinates_per_mode * modes * static_cast<double>(pencil.size()) * sizeof(double));
  return estimate;
}

bool is_large_scene(const Model& model, const TraceOptions& trace) {
  if (model.n_trims() > 0) return false;  // the equilibrium of a projected scene has no conditions
  const bool has_bodies = dynamic_cast<const Multibody*>(&model) != nullptr;
  if (!has_bodies || model.n_coordinates() < smallest_large_scene) return false;
  if (trace.modes.count || trace.modes.band) return true;
  if (model.n_coordinates() <= limits::matrix_rows) return false;
  throw InputError("a large model with " + std::to_string(model.n_coordinates()) +
                   " coordinates, of which all modes are asked for: follow some of them, with modes = 6 or "
                   "modes = { band = [\"0 Hz\", \"50 Hz\"] } in [trace], or --modes 6");
}

bool is_large(const Model& model, const TraceOptions& trace) {
  return large_family(model, trace) != nullptr || is_large_scene(model, trace);
}

const SparseFamily* large_family(const Model& model, const TraceOptions& trace) {
  const auto* family = dynamic_cast<const SparseFamily*>(&model);
  if (family == nullptr || family->n_coordinates() <= largest_dense_size) return nullptr;
  const bool some_modes = trace.modes.count || trace.modes.band;
  return some_modes || family->n_coordinates() > limits::matrix_rows ? family : nullptr;
}

void project_if_large(std::unique_ptr<Model>& model, const TraceOptions& trace,
                      const std::vector<ParameterValues>& lines, const ProjectionOptions& options) {
  if (const SparseFamily* family = large_family(*model, trace))
    model = project(*family, trace, lines, options);
  else if (is_large_scene(*model, trace))
    model = project(std::shared_ptr<const Model>(std::move(model)), trace, lines, options);
}

void project_at_if_large(std::unique_ptr<Model>& model, const TraceOptions& trace,
                         const std::vector<double>& values, const ProjectionOptions& options) {
  if (const SparseFamily* family = large_family(*model, trace))
    model = project_at(*family, trace, values, options);
  else if (is_large_scene(*model, trace))
    model = project_at(std::shared_ptr<const Model>(std::move(model)), trace, values, options);
}

}  // namespace eigentrail
