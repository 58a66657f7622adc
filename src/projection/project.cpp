#include "eigentrail/projection/project.hpp"

#include "eigentrail/scene/limits.hpp"
#include "projection/family_pencils.hpp"

namespace eigentrail {

ProjectedFamily::ProjectedFamily(ModelDescription description, AffinePencil<Matrix> pencil,
                                 Projection projection)
    : AffineFamily<Matrix>(std::move(description), std::move(pencil)), projection_(std::move(projection)) {}

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

ProjectionEstimate estimate_projection(const SparseFamily& family, const TraceOptions& trace,
                                       const SparseSolverMaker& solver) {
  const Parameters& parameters = family.description().parameters;
  Vector values = parameters.declared_values();
  values[parameters.index(trace.parameter).value()] = 0.5 * (trace.from + trace.to);
  const SparsePencil pencil = FamilyPencils(family).at(values);
  const ShiftedMatrix shifted = shifted_matrix(pencil, {});
  const FactorEstimate factors = make_solver(solver)->estimate(shifted.matrix, shifted.kind);
  ProjectionEstimate estimate;
  estimate.freedoms = pencil.size();
  estimate.nonzeros = pencil.M.nonZeros() + pencil.C.nonZeros() + pencil.K.nonZeros();
  estimate.two_sided = !pencil.one_sided;
  estimate.method = factors.method;
  estimate.factor_bytes = factors.bytes;
  estimate.factor_operations = factors.operations;
  // Arnoldi: four vectors of positions and velocities per mode; the space: about six samples of each.
  const int modes = trace.modes.count.value_or(8) + ProjectionOptions().spare_modes;
  const double vectors = modes * (8.0 + 12.0 * (estimate.two_sided ? 2.0 : 1.0));
  const double entry = sizeof(double) + sizeof(int);
  estimate.total_bytes = factors.bytes + 3.0 * static_cast<double>(estimate.nonzeros) * entry +
                         vectors * static_cast<double>(pencil.size()) * sizeof(double);
  estimate.target = ProjectionOptions().share_of_tolerance * trace.tolerance;
  return estimate;
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
}

void project_at_if_large(std::unique_ptr<Model>& model, const TraceOptions& trace,
                         const std::vector<double>& values, const ProjectionOptions& options) {
  if (const SparseFamily* family = large_family(*model, trace))
    model = project_at(*family, trace, values, options);
}

}  // namespace eigentrail
