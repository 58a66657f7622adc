#include "eigentrail/continuation/linear_model.hpp"

#include <algorithm>
#include <cctype>
#include <functional>
#include <limits>
#include <set>

#include "continuation/point/separate_points.hpp"
#include "core/products.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/limits.hpp"
#include "modes/companion_form.hpp"

namespace eigentrail {
namespace {

[[noreturn]] void refuse_input(const TraceSetup& setup, const std::string& name, const std::string& why) {
  throw InputError(setup.scene.path + ": input '" + name + "': " + why);
}

int input_index(const TraceSetup& setup, const std::string& name) {
  const Parameters& parameters = setup.model->description().parameters;
  const std::optional<int> index = parameters.index(name);
  if (!index)
    refuse_input(setup, name, "expected a parameter of the scene; " + suggestion(name, parameters.names()));
  if (parameters.at(name).definition)
    refuse_input(setup, name, "is defined by other parameters; name one of those");
  if (setup.model->structure(setup.traced()).known_equilibrium)
    refuse_input(setup, name, "a rotor, or a family of matrices, has no forces that could be inputs");
  return *index;
}

/// The path along a parameter, at rest in the equilibrium. That of a trimmed one is among the multipliers.
Path along_input(const TraceSetup& setup, int input, const Equilibrium& at, const Vector& parameters) {
  Path path{Matrix::Zero(parameters.size(), 2), at.x, Matrix::Zero(at.lambda.size(), 2)};
  path.parameters.col(0) = parameters;
  path.parameters(input, 1) = 1.0;
  path.lambda.col(0) = at.lambda;
  Eigen::Index row = setup.model->n_constraints();
  for (const Trim& trim : setup.model->description().trims)
    path.lambda(row++, 1) = trim.parameter == input ? 1.0 : 0.0;
  return path;
}

/// Change of the forces with the value of a parameter, n. Zero where it would change the equilibrium by no
/// more than rounding does.
Vector input_force(const TraceSetup& setup, const std::string& name, const Equilibrium& at,
                   const Vector& parameters) {
  const int input = input_index(setup, name);
  SteadyResidual change;
  EvaluationCounts counts = setup.model->new_counts();
  if (const EvaluationFault fault =
          setup.model->residual(along_input(setup, input, at, parameters), 1, change, counts))
    refuse_input(setup, name, fault.message());
  for (Eigen::Index i = 0; i < setup.model->n_constraints(); ++i) {
    if (coefficient(change.constraint, i, 1) != 0.0)
      refuse_input(setup, name,
                   "changes the constraint " +
                       setup.model->description().constraint_names[static_cast<std::size_t>(i)] +
                       "; an input changes forces only");
  }
  const Vector none = Vector::Zero(at.x.size());
  if (change.force.cols() < 2) return none;
  const double rounding = std::numeric_limits<double>::epsilon() * at.linearization.K[0].norm() * at.x.norm();
  const double value = std::abs(parameters[input]);
  const bool is_rounding = value > 0.0 && change.force.col(1).norm() * value < rounding;
  return is_rounding ? none : Vector(-change.force.col(1));
}

/// Without the columns of coordinates whose mass is rounding of the product with the basis.
Matrix without_rounding_of_mass(Matrix M) {
  const double rounding = static_cast<double>(M.rows()) * std::numeric_limits<double>::epsilon() *
                          (M.size() == 0 ? 0.0 : M.cwiseAbs().maxCoeff());
  for (auto column : M.colwise()) {
    if (column.cwiseAbs().maxCoeff() <= rounding) column.setZero();
  }
  return M;
}

LinearModel linear_model(const TraceSetup& setup, const PathPoint& point,
                         const std::vector<std::string>& inputs) {
  const Linearization& all = point.equilibrium.linearization;
  LinearModel model;
  model.p = point.p;
  model.x = point.equilibrium.x;
  model.lambda = point.equilibrium.lambda.head(setup.model->n_constraints());
  model.trimmed = point.equilibrium.lambda.tail(setup.model->n_trims());
  model.M = all.M[0].dense();
  model.C = all.C[0].dense();
  model.K = all.K[0].dense();
  model.A = all.A[0].dense();
  model.T = point.basis.T[0];
  model.Mq = without_rounding_of_mass(point.pencil.M[0]);
  model.Cq = point.pencil.C[0];
  model.Kq = point.pencil.K[0];
  const auto count = static_cast<Eigen::Index>(inputs.size());
  model.F.resize(model.x.size(), count);
  for (Eigen::Index j = 0; j < count; ++j)
    model.F.col(j) = input_force(setup, inputs[static_cast<std::size_t>(j)], point.equilibrium,
                                 setup.parameters_at(point.p));
  model.Fq = transposed_product(model.T, model.F);
  return model;
}

/// Sets the equations of first order, with the same states at all values. Throws InputError where the number
/// of freedoms differs.
void set_states(const TraceSetup& setup, std::vector<LinearModel>& models) {
  if (models.empty()) return;
  if (models.front().Mq.rows() == 0)
    throw InputError(setup.scene.path + ": has no freedoms: its constraints hold every motion");
  Matrix masses = Matrix::Zero(models.front().Mq.rows(), models.front().Mq.cols());
  for (const LinearModel& model : models) {
    if (model.Mq.rows() != masses.rows())
      throw InputError(setup.scene.path + ": has " + std::to_string(masses.rows()) + " freedoms at " +
                       setup.options.parameter + " = " + exact_text(models.front().p) + " and " +
                       std::to_string(model.Mq.rows()) + " at " + exact_text(model.p) +
                       "; linearize these values one by one");
    masses = masses.cwiseMax(model.Mq.cwiseAbs());
  }
  const std::vector<Eigen::Index> rates = coordinates_with_mass(masses);
  for (LinearModel& model : models) {
    CompanionForm<Matrix> form(model.Mq, model.Cq, model.Kq, rates);
    model.E = std::move(form.b);
    model.G = std::move(form.a);
    model.B = Matrix::Zero(model.E.rows(), model.Fq.cols());
    model.B.bottomRows(model.Fq.rows()) = model.Fq;
    model.rates = rates;
  }
}

void note_inputs_without_force(const std::vector<std::string>& inputs, LinearModels& models) {
  for (std::size_t j = 0; j < inputs.size() && !models.found.empty(); ++j) {
    const auto is_zero = [j](const LinearModel& model) {
      return model.F.col(static_cast<Eigen::Index>(j)).isZero(0.0);
    };
    if (std::ranges::all_of(models.found, is_zero))
      models.notes.push_back("input '" + inputs[j] + "' exerts no force at " +
                             (models.found.size() == 1 ? "this equilibrium" : "these equilibria"));
  }
}

/// Whether a name means something else, here or to what reads such files.
bool is_name_of_array(const std::string& name) {
  static const std::set<std::string> others = {
      "A_error", "T",     "constraints", "derivative_order", "eigentrail", "frame", "lambda",
      "names",   "order", "states",      "trimmed",          "units",      "x"};
  const bool is_matrix = name.size() == 1 && std::isupper(static_cast<unsigned char>(name[0])) != 0;
  return is_matrix || others.contains(name) || name.starts_with("state_") || name.ends_with("_full") ||
         name.ends_with("_names") || name.ends_with("_units");
}

/// Names of the coordinates q: those of the scene, where these are all of them.
std::vector<std::string> names_of(const TraceSetup& setup, const LinearModel& model) {
  if (model.A.rows() == 0) return setup.model->description().coordinate_names;
  std::vector<std::string> names;
  for (Eigen::Index i = 0; i < model.T.cols(); ++i) names.push_back("q" + std::to_string(i + 1));
  return names;
}

}  // namespace

LinearModels linear_models(const TraceSetup& setup, const std::vector<double>& values,
                           const std::vector<std::string>& inputs) {
  check_within_samples(setup, values);
  if (setup.model->n_coordinates() > limits::matrix_rows)
    throw InputError(setup.scene.path + ": has " + std::to_string(setup.model->n_coordinates()) +
                     " coordinates, and at most " + std::to_string(limits::matrix_rows) +
                     " fit into whole matrices; eigentrail trace --save-reduced writes projected ones");
  for (auto name = inputs.begin(); name != inputs.end(); ++name) {
    if (std::find(inputs.begin(), name, *name) != name) refuse_input(setup, *name, "is given twice");
  }
  const PathProblem problem = problem_along(*setup.model, setup.options.parameter);
  LinearModels models;
  Matrix frame;
  for_each_point(problem, values, frame, [&](const PathPoint& point) {
    if (point.status != PointStatus::computed) {
      models.faults.emplace_back(point.p, point.message);
      return;
    }
    models.found.push_back(linear_model(setup, point, inputs));
    if (frame.size() == 0) frame = models.found.back().T;
  });
  note_inputs_without_force(inputs, models);
  set_states(setup, models.found);
  return models;
}

std::vector<NamedSamples> arrays_of(const TraceSetup& setup, const std::vector<LinearModel>& models,
                                    const std::vector<std::string>& inputs) {
  std::vector<NamedSamples> arrays;
  const auto add = [&](const std::string& name, int rank, auto member) {
    NamedSamples array{name, rank};
    for (const LinearModel& model : models) array.samples.push_back(std::invoke(member, model));
    if (array.samples.front().size() > 0) arrays.push_back(std::move(array));
  };
  const auto add_texts = [&](const std::string& name, const std::vector<std::string>& texts) {
    if (!texts.empty()) arrays.push_back({name, 1, {}, texts});
  };
  const ModelDescription& description = setup.model->description();
  const std::string& parameter = setup.options.parameter;
  add("M", 2, &LinearModel::Mq);
  add("C", 2, &LinearModel::Cq);
  add("K", 2, &LinearModel::Kq);
  add("F", 2, &LinearModel::Fq);
  add("state_E", 2, &LinearModel::E);
  add("state_A", 2, &LinearModel::G);
  add("state_B", 2, &LinearModel::B);
  add("T", 2, &LinearModel::T);
  add("M_full", 2, &LinearModel::M);
  add("C_full", 2, &LinearModel::C);
  add("K_full", 2, &LinearModel::K);
  add("F_full", 2, &LinearModel::F);
  add("constraints", 2, &LinearModel::A);
  add("x", 1, &LinearModel::x);
  add("lambda", 1, &LinearModel::lambda);
  add("trimmed", 1, &LinearModel::trimmed);
  add(is_name_of_array(parameter) ? "parameter" : parameter, 0,
      [](const LinearModel& model) { return Matrix::Constant(1, 1, model.p); });
  const std::vector<std::string> states = names_of(setup, models.front());
  std::vector<std::string> rates, trimmed;
  for (const Eigen::Index i : models.front().rates) rates.push_back(states[static_cast<std::size_t>(i)]);
  for (const Trim& trim : description.trims)
    trimmed.push_back(description.parameters.names()[static_cast<std::size_t>(trim.parameter)]);
  add_texts("state_names", states);
  add_texts("rate_names", rates);
  add_texts("coordinate_names", description.coordinate_names);
  add_texts("coordinate_units", description.coordinate_units);
  add_texts("constraint_names", description.constraint_names);
  add_texts("trimmed_names", trimmed);
  add_texts("input_names", inputs);
  return arrays;
}

}  // namespace eigentrail
