#include "model/multibody.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace eigentrail {
namespace {

/// Largest number of Newton steps for the starting guess of states, and the relative change at which they
/// end. Where their equations are linear one is exact, and the second one sees that.
constexpr int most_settlings = 10;
constexpr double settled = 1e-12;

}  // namespace

ModelDescription with_costs(ModelDescription description,
                            std::initializer_list<const RecordedEquations*> equations) {
  for (const RecordedEquations* part : equations) add_costs(*part, description.effects);
  return description;
}

Multibody::Multibody(ModelDescription description, Assembly assembly, std::vector<Expression> guess)
    : Model(with_costs(std::move(description), {&assembly.equations()})),
      assembly_(std::move(assembly)),
      guess_(std::move(guess)) {}

Vector Multibody::initial_guess(const Vector& parameters) const {
  Vector si = parameters;
  assembly_.data().parameters.to_si(std::span<double>(si.data(), static_cast<std::size_t>(si.size())));
  const std::span<const double> values(si.data(), static_cast<std::size_t>(si.size()));
  Vector x = Vector::Zero(n_coordinates());
  for (std::size_t i = 0; i < guess_.size(); ++i)
    x[static_cast<Eigen::Index>(i)] = guess_[i].evaluate(values);
  settle_states(*this, n_coordinates() - 3 * assembly_.data().n_triples, parameters, x);
  return x;
}

void settle_states(const Model& model, Eigen::Index n_states, const Vector& parameters, Vector& x) {
  if (n_states == 0) return;
  EvaluationCounts counts = model.new_counts();
  for (int i = 0; i < most_settlings; ++i) {
    const Path path{parameters, x, model.first_multipliers(parameters)};
    SteadyResidual rest;
    Linearization linearization;
    if (model.residual(path, 0, rest, counts) || model.linearize(path, 0, linearization, counts)) return;
    const Matrix K = linearization.K[0].dense().bottomRightCorner(n_states, n_states);
    const Vector load = rest.force.col(0).tail(n_states);
    const Vector change = Eigen::PartialPivLU<Matrix>(K).solve(load);
    if (!change.allFinite()) return;
    x.tail(n_states) -= change;
    if (change.norm() <= settled * x.tail(n_states).norm()) return;
  }
}

std::vector<int> moving_parameters(const ModelDescription& description, int traced_parameter) {
  std::vector<int> moving = {traced_parameter};
  for (const Trim& trim : description.trims) moving.push_back(trim.parameter);
  return moving;
}

Structure structure_of(std::initializer_list<const Assembly*> parts, const std::vector<int>& moving) {
  Structure result;
  Inputs residual;
  std::array<Inputs, 4> matrices;
  for (const Assembly* part : parts) {
    part->data().elements.for_each([&]<class Element>(const std::vector<Placed<Element>>& list, std::size_t) {
      if (list.empty()) return;
      result.damped = result.damped || Element::contribution.dissipative;
      result.gyroscopic = result.gyroscopic || Element::contribution.gyroscopic;
      result.circulatory = result.circulatory || Element::contribution.circulatory;
    });
    residual.add(part->equations().inputs_of_residual);
    for (std::size_t target = 0; target < matrices.size(); ++target)
      matrices[target].add(part->equations().inputs[target]);
  }
  const MultibodyData& data = (*parts.begin())->data();
  const auto changes = [&](const Inputs& inputs) {
    return std::any_of(inputs.numbers.begin(), inputs.numbers.end(), [&](int slot) {
      const auto at = static_cast<std::size_t>(slot);
      return at < data.quantities.size() && std::any_of(moving.begin(), moving.end(), [&](int parameter) {
               return data.parameters.depends_on(data.quantities[at], parameter);
             });
    });
  };
  const bool trimmed = moving.size() > 1;
  result.fixed_equilibrium = !changes(residual) && !trimmed;
  const auto is_constant = [&](Target target) {
    const Inputs& inputs = matrices[static_cast<std::size_t>(target)];
    return !changes(inputs) && (result.fixed_equilibrium || !inputs.coordinates);
  };
  result.constant_mass = is_constant(Target::mass);
  result.constant_damping = is_constant(Target::damping);
  // Forces of constraints are part of it.
  result.constant_stiffness = result.fixed_equilibrium;
  result.constant_constraints = is_constant(Target::constraints);
  return result;
}

Structure Multibody::structure(int traced_parameter) const {
  return structure_of({&assembly_}, moving_parameters(description(), traced_parameter));
}

EvaluationFault Multibody::residual(const Path& path, int order, SteadyResidual& result,
                                    EvaluationCounts& counts) const {
  return assembly_.residual(path, order, result, counts);
}

EvaluationFault Multibody::linearize(const Path& path, int order, Linearization& result,
                                     EvaluationCounts& counts) const {
  return assembly_.linearize(path, order, result, counts);
}

EvaluationFault differentiate_by_unknowns(const Model& model, const Path& at, TrimDerivatives& result,
                                          EvaluationCounts& counts) {
  const Eigen::Index k = model.n_trims(), m = model.n_constraints();
  result.force.resize(model.n_coordinates(), k);
  result.constraint.resize(m, k);
  result.trim.resize(k, k);
  for (Eigen::Index i = 0; i < k; ++i) {
    Path along{at.parameters.col(0), at.x.col(0), VectorSeries::Zero(m + k, 2)};
    along.lambda.col(0) = at.lambda.col(0);
    along.lambda(m + i, 1) = 1.0;
    SteadyResidual slope;
    if (auto fault = model.residual(along, 1, slope, counts)) return fault;
    result.force.col(i) = slope.force.col(1);
    result.constraint.col(i) = slope.constraint.col(1).head(m);
    result.trim.col(i) = slope.constraint.col(1).tail(k);
  }
  return {};
}

EvaluationFault Multibody::trim_derivatives(const Path& at, TrimDerivatives& result,
                                            EvaluationCounts& counts) const {
  if (auto fault = differentiate_by_unknowns(*this, at, result, counts)) return fault;
  return assembly_.trim_rows(at, result, counts);
}

std::vector<Expression> varying(const std::vector<Expression>& quantities) {
  std::vector<Expression> all;
  for (const Expression& quantity : quantities) {
    const bool is_new = std::find(all.begin(), all.end(), quantity) == all.end();
    if (!quantity.is_constant() && is_new) all.push_back(quantity);
  }
  return all;
}

std::vector<Expression> Multibody::expressions() const {
  return varying(assembly_.data().quantities);
}

EvaluationFault Multibody::extended_residual(const BasicPath<Extended>& path,
                                             BasicSteadyResidual<Extended>& result) const {
  EvaluationCounts counts = new_counts();
  return assembly_.residual(path, 0, result, counts);
}

EvaluationFault Multibody::extended_linearization(const BasicPath<Extended>& path,
                                                  BasicLinearization<Extended>& result) const {
  EvaluationCounts counts = new_counts();
  return assembly_.linearize(path, 0, result, counts);
}

}  // namespace eigentrail
