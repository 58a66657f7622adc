#include "model/multibody.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace eigentrail {
namespace {

/// Largest number of Newton steps for the starting guess of states, and the relative change at which they
/// end. Where their equations are linear one is exact, and the second one sees that.
constexpr int most_settlings = 10;
constexpr double settled = 1e-12;

/// Adds the roles of all quantities that depend on one of some parameters to `enters`.
class TracedRoles {
 public:
  TracedRoles(const Parameters& parameters, std::vector<int> traced, Enters& enters)
      : parameters_(parameters), traced_(std::move(traced)), enters_(enters) {}

  void place(std::string_view, const Place& place, std::string_view = {}) {
    for (const Term& term : place.terms) {
      if (term.weight.slot >= 0) add(term.weight, place_role);
    }
    if (place.moves()) return;
    for (const Quantity& q : place.fixed) add(q, place_role);
  }
  void point(std::string_view key, const Place& place, std::string_view help) {
    this->place(key, place, help);
  }
  void direction(std::string_view key, const Place& place, std::string_view help) {
    this->place(key, place, help);
  }
  void body(std::string_view, const std::array<Place, 3>&, std::string_view) {}
  void joint(std::string_view key, const HingeAngle& angle, std::string_view) {
    for (const Place* direction : {&angle.axis, &angle.from, &angle.to}) place(key, *direction);
  }
  void quantity(const QuantityField& field, const Quantity& q) { add(q, field.enters); }
  void vector(const QuantityField& field, const std::array<Quantity, 3>& v) {
    for (const Quantity& q : v) add(q, field.enters);
  }
  void strength(const Quantity& q, const Enters& role) {
    if (q.slot >= 0) add(q, role);
  }
  template <std::size_t N>
  void matrix(const QuantityField& field, const std::array<Quantity, N>& entries) {
    for (const Quantity& q : entries) add(q, field.enters);
  }
  void constraint(const Constraint& constraint) {
    place_role = enters_constraint;
    for (const ConstraintRow& row : constraint.rows) {
      add(row.offset, enters_constraint);
      sides(row.a);
      if (row.b) sides(*row.b);
    }
  }

  /// Role of the weights and coordinates of places, for the current element or for constraints.
  Enters place_role;

 private:
  void sides(const Difference& difference) {
    place("", difference.first);
    if (difference.second) place("", *difference.second);
  }

  void add(const Quantity& q, const Enters& role) {
    const auto moves_q = [&](int parameter) { return parameters_.depends_on(q.expression, parameter); };
    if (std::none_of(traced_.begin(), traced_.end(), moves_q)) return;
    enters_.mass = enters_.mass || role.mass;
    enters_.damping = enters_.damping || role.damping;
    enters_.force = enters_.force || role.force;
    enters_.constraint = enters_.constraint || role.constraint;
  }

  const Parameters& parameters_;
  std::vector<int> traced_;
  Enters& enters_;
};

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

Structure structure_of(std::initializer_list<const MultibodyData*> parts, const std::vector<int>& moving) {
  Structure result;
  Enters changes;
  bool curved_constraints = false;
  bool turning_damping = false;
  bool turning_mass = false;
  TracedRoles roles((*parts.begin())->parameters, moving, changes);
  for (const MultibodyData* data : parts) {
    data->elements.for_each([&]<class Element>(const std::vector<Placed<Element>>& list, std::size_t) {
      constexpr Dependence depends = Element::depends;
      roles.place_role = {.mass = depends.acceleration, .damping = depends.velocity, .force = true};
      constexpr bool damping = depends.velocity || number_of_states<Element>() > 0;
      constexpr bool only_inertia = Element::contribution.inertia && !depends.position;
      for (const Placed<Element>& placed : list) {
        Element::fields(placed.element, roles);
        roles.strength(placed.strength,
                       {.mass = depends.acceleration, .damping = damping, .force = !only_inertia});
      }
      if (list.empty()) return;
      result.damped = result.damped || Element::contribution.dissipative;
      result.gyroscopic = result.gyroscopic || Element::contribution.gyroscopic;
      result.circulatory = result.circulatory || Element::contribution.circulatory;
      turning_damping = turning_damping || depends.turning;
      turning_mass = turning_mass || depends.turning_mass;
    });
    for (const Constraint& constraint : data->constraints) {
      roles.constraint(constraint);
      curved_constraints = curved_constraints || is_curved(constraint);
    }
  }
  // K and curved constraints (A) change with the equilibrium, and so do some damping matrices and the mass of
  // the air.
  const bool trimmed = moving.size() > 1;
  result.fixed_equilibrium = !changes.force && !changes.constraint && !trimmed;
  result.constant_mass = !changes.mass && (result.fixed_equilibrium || !turning_mass);
  result.constant_damping = !changes.damping && (result.fixed_equilibrium || !turning_damping);
  result.constant_stiffness = result.fixed_equilibrium;
  result.constant_constraints = !changes.constraint && (result.fixed_equilibrium || !curved_constraints);
  return result;
}

Structure Multibody::structure(int traced_parameter) const {
  return structure_of({&assembly_.data()}, moving_parameters(description(), traced_parameter));
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
