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

void settle_states(const Model& model, const Vector& parameters, Vector& x) {
  Eigen::Index n_states = 0;
  for (const Effect& effect : model.description().effects) n_states += effect.states;
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

ModelDescription Assembly::with_costs(ModelDescription description) const {
  add_costs(equations_, description.effects);
  return description;
}

Structure Assembly::structure(const std::vector<int>& moving) const {
  return structure_of({this}, moving);
}

Structure structure_of(std::initializer_list<const Assembly*> parts, const std::vector<int>& moving) {
  Structure result;
  Inputs residual;
  std::array<Inputs, 4> matrices;
  for (const Assembly* part : parts) {
    part->data().elements.for_each([&]<class Element>(const std::vector<Placed<Element>>& list, std::size_t) {
      if (!list.empty()) result.add(Element::contribution);
    });
    residual.add(part->equations().inputs_of_residual);
    for (std::size_t target = 0; target < matrices.size(); ++target)
      matrices[target].add(part->equations().inputs[target]);
  }
  const MultibodyData& data = (*parts.begin())->data();
  std::vector<char> parameter_changes;
  for (int i = 0; i < static_cast<int>(data.parameters.list().size()); ++i) {
    const auto depends = [&](int parameter) { return data.parameters.depends_on(i, parameter); };
    parameter_changes.push_back(std::any_of(moving.begin(), moving.end(), depends));
  }
  const auto changes = [&](const Inputs& inputs) {
    return std::any_of(inputs.numbers.begin(), inputs.numbers.end(), [&](int slot) {
      const auto at = static_cast<std::size_t>(slot);
      if (at >= data.quantities.size()) return false;
      const auto& used = data.quantities[at].parameters();
      return std::any_of(used.begin(), used.end(), [&](int i) { return parameter_changes[i]; });
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

std::vector<Expression> varying(const std::vector<Expression>& quantities) {
  std::vector<Expression> all;
  for (const Expression& quantity : quantities) {
    const bool is_new = std::find(all.begin(), all.end(), quantity) == all.end();
    if (!quantity.is_constant() && is_new) all.push_back(quantity);
  }
  return all;
}

}  // namespace eigentrail
