#include "eigentrail/projection/project.hpp"

#include "eigentrail/projection/route.hpp"

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

void project_if_large(std::unique_ptr<Model>& model, const TraceOptions& trace,
                      const std::vector<ParameterValues>& lines, const ProjectionOptions& options) {
  if (!is_large(*model, trace)) return;
  if (const auto* family = dynamic_cast<const SparseFamily*>(model.get()))
    model = project(*family, trace, lines, options);
  else
    model = project(std::shared_ptr<const Model>(std::move(model)), trace, lines, options);
}

void project_at_if_large(std::unique_ptr<Model>& model, const TraceOptions& trace,
                         const std::vector<double>& values, const ProjectionOptions& options) {
  if (!is_large(*model, trace)) return;
  if (const auto* family = dynamic_cast<const SparseFamily*>(model.get()))
    model = project_at(*family, trace, values, options);
  else
    model = project_at(std::shared_ptr<const Model>(std::move(model)), trace, values, options);
}

}  // namespace eigentrail
