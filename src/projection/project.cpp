#include "eigentrail/projection/project.hpp"

#include "eigentrail/projection/route.hpp"

namespace eigentrail {

ProjectedFamily::ProjectedFamily(ModelDescription description, AffinePencil<Matrix> pencil,
                                 Projection projection)
    : AffineFamily<Matrix>(std::move(description), std::move(pencil)), Projected(std::move(projection)) {}

void Projected::settle(Projection outcome) {
  outcome.basis = std::move(projection_.basis);
  outcome.motions = std::move(projection_.motions);
  outcome.freedoms = projection_.freedoms;
  outcome.names = std::move(projection_.names);
  projection_ = std::move(outcome);
}

Matrix Projected::take_basis() {
  return std::move(projection_.motions ? projection_.motions->basis : projection_.basis);
}

ProjectedScene::ProjectedScene(std::shared_ptr<const Model> scene, Projection projection, Path first)
    : Model(scene->description()),
      Projected(std::move(projection)),
      scene_(std::move(scene)),
      first_(std::move(first)) {}

Vector ProjectedScene::initial_guess(const Vector& parameters) const {
  return parameters == first_.parameters.col(0) ? Vector(first_.x.col(0)) : scene_->initial_guess(parameters);
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
  if (is_large(*model, trace))
    model = project(std::shared_ptr<const Model>(std::move(model)), trace, lines, options);
}

void project_at_if_large(std::unique_ptr<Model>& model, const TraceOptions& trace,
                         const std::vector<double>& values, const ProjectionOptions& options) {
  if (is_large(*model, trace))
    model = project_at(std::shared_ptr<const Model>(std::move(model)), trace, values, options);
}

}  // namespace eigentrail
