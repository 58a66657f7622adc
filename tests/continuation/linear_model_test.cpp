// The linearized equations of every scene of the library against differences of its steady residual, by their
// observed order.
#include "eigentrail/continuation/linear_model.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "eigentrail/continuation/sensitivities.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/scene/scene.hpp"

namespace eigentrail::test::linear_model_test {
namespace {

/// [A^T lambda - f; c] where coordinates and parameters differ from the equilibrium by h times directions.
/// Empty where a model has none there: a rotor in multiblade coordinates whose hub leaves its axis.
std::optional<Vector> residual(const TraceSetup& setting, const LinearModel& at, const Vector& dx,
                               const Vector& du, double h) {
  Vector lambda(at.lambda.size() + at.trimmed.size());
  lambda << at.lambda, at.trimmed;
  Eigen::Index row = at.lambda.size();
  for (const Trim& trim : setting.model->description().trims) lambda[row++] += h * du[trim.parameter];
  const Path path{setting.parameters_at(at.p) + h * du, at.x + h * dx, lambda};
  SteadyResidual result;
  EvaluationCounts counts = setting.model->new_counts();
  if (setting.model->residual(path, 0, result, counts)) return std::nullopt;
  Vector all(at.x.size() + at.lambda.size());
  all << result.force.col(0), result.constraint.col(0).head(at.lambda.size());
  return all;
}

/// Central differences with steps h and h/2 have errors of the ratio 4, or of rounding. Returns whether there
/// are such.
bool is_checked(const TraceSetup& setting, const LinearModel& at, const Vector& dx, const Vector& du,
                const Vector& derivative, double h, const std::string& what) {
  std::array<double, 2> errors{};
  double size = 0.0;
  for (std::size_t i = 0; i < 2; ++i, h /= 2.0) {
    const auto ahead = residual(setting, at, dx, du, h), behind = residual(setting, at, dx, du, -h);
    if (!ahead || !behind) return false;
    const Vector difference = (*ahead - *behind) / (2.0 * h);
    errors[i] = (difference - derivative).norm();
    size = std::max(size, difference.norm());
  }
  constexpr double rounding = 1e-7;  // of numbers of 1e6 times the result, and steps of 1e-3
  if (errors[1] > rounding * size) {
    EXPECT_NEAR(errors[0] / errors[1], 4.0, 0.5) << what;
  }
  return true;
}

std::vector<std::string> library() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(EIGENTRAIL_DATA_DIR "/scenes"))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem());
  std::ranges::sort(names);
  return names;
}

/// The model at the start of the scene's trace; without the inputs that it refuses.
LinearModel model_with(const TraceSetup& setting, std::vector<std::string>& inputs) {
  std::vector<std::string> accepted;
  for (const std::string& input : inputs) {
    try {
      (void)linear_models(setting, {setting.options.from}, {input});
      accepted.push_back(input);
    } catch (const InputError&) {
    }
  }
  inputs = accepted;
  return linear_models(setting, {setting.options.from}, inputs).found.at(0);
}

TEST(LinearModel, IsTheDerivativeOfTheResidualOfEveryScene) {
  int n_scenes = 0, n_inputs = 0;
  for (const std::string& name : library()) {
    SCOPED_TRACE(name);
    const TraceSetup setting = prepare_trace(read_scene(EIGENTRAIL_DATA_DIR "/scenes/" + name + ".toml"), {});
    if (setting.model->structure(setting.traced()).known_equilibrium)
      continue;  // matrices, without a residual
    const Parameters& parameters = setting.model->description().parameters;
    std::vector<std::string> inputs;
    for (const int i : free_parameters(parameters))
      inputs.push_back(parameters[static_cast<std::size_t>(i)].name);
    const LinearModel model = model_with(setting, inputs);
    const Vector no_input = Vector::Zero(static_cast<Eigen::Index>(parameters.size()));
    Vector stacked(model.x.size() + model.lambda.size());
    std::mt19937 engine(7);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    const Vector dx = Vector::NullaryExpr(model.x.size(), [&] { return number(engine); });
    stacked << model.K * dx, model.A * dx;
    if (is_checked(setting, model, dx, no_input, stacked, 1e-3, "coordinates")) ++n_scenes;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      if (model.F.col(static_cast<Eigen::Index>(i)).isZero(0.0)) continue;  // or what rounding leaves of it
      Vector du = no_input;
      du[*parameters.index(inputs[i])] = 1.0;
      stacked << -model.F.col(static_cast<Eigen::Index>(i)), Vector::Zero(model.lambda.size());
      const double value = std::abs(setting.parameters_at(model.p).dot(du));
      const double h = 1e-3 * (value > 0.0 ? value : 1.0);
      if (is_checked(setting, model, Vector::Zero(model.x.size()), du, stacked, h, inputs[i])) ++n_inputs;
    }
  }
  EXPECT_GT(n_scenes, 20);
  EXPECT_GT(n_inputs, 30);
}

}  // namespace
}  // namespace eigentrail::test::linear_model_test
