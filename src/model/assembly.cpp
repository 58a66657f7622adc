#include "model/assembly.hpp"

#include <cmath>
#include <initializer_list>
#include <optional>

#include "model/element_matrix.hpp"
#include "model/moved_triples.hpp"

namespace eigentrail {
namespace {

template <class Real>
using Columns = typename BasicPath<Real>::Columns;

template <class Real, int Q>
std::vector<Series<Real, Q>> to_series(const Columns<Real>& coefficients) {
  std::vector<Series<Real, Q>> series(static_cast<std::size_t>(coefficients.rows()));
  for (Eigen::Index i = 0; i < coefficients.rows(); ++i) {
    for (int k = 0; k <= Q; ++k) series[static_cast<std::size_t>(i)][k] = coefficient(coefficients, i, k);
  }
  return series;
}

template <class Real, int Q>
void add_entry(Columns<Real>& sum, int row, const Series<Real, Q>& value, bool& finite) {
  using std::isfinite;
  for (int k = 0; k <= Q; ++k) {
    sum(row, k) += value[k];
    finite = finite && isfinite(value[k]);
  }
}

template <class Element>
Joined join(const Placed<Element>& placed, std::size_t n_triples) {
  const int first = 3 * static_cast<int>(n_triples) + placed.first_state;
  return {placed.arguments, placed.strength, first, number_of_states<Element>()};
}

template <class Base>
std::array<Vec3<Base>, max_arguments> positions(const Joined& joined, const PathValues<Base>& values) {
  std::array<Vec3<Base>, max_arguments> result;
  for (std::size_t i = 0; i < joined.arguments.size(); ++i) result[i] = values.vector(joined.arguments[i]);
  return result;
}

template <class Base, class Element>
std::span<const Base> states_of(const Placed<Element>& placed, const PathValues<Base>& values) {
  if constexpr (number_of_states<Element>() == 0) {
    return {};
  } else {
    return std::span<const Base>(values.states)
        .subspan(static_cast<std::size_t>(placed.first_state), Element::states.size());
  }
}

/// Calls visit(coordinate, value) for every coordinate of a component, with `value` times its weight.
template <class Base, class Visit>
void for_each_coordinate(const Joined& joined, int component, const PathValues<Base>& values,
                         const Base& value, Visit visit) {
  if (component >= joined.of_vectors()) {
    visit(joined.first_state + component - joined.of_vectors(), value);
    return;
  }
  for (const Term& term : joined.arguments[static_cast<std::size_t>(component / 3)].terms)
    visit(3 * term.triple + component % 3, values.times(term.weight, value));
}

/// Adds the derivative of an element's force in one direction, a column of M, C or K.
template <class Real, int Q>
void add_column(const Joined& joined, int component, const ElementView<Series<Series<Real, Q>, 1>>& view,
                const PathValues<Series<Real, Q>>& values, Scatter<Real, Q>& matrix, bool& finite) {
  using Base = Series<Real, Q>;
  for (int i = 0; i < joined.components(); ++i) {
    const Base value = values.times(joined.strength, -view.component(i)[1]);
    if (is_zero(value)) continue;
    for_each_coordinate(joined, i, values, value, [&](int row, const Base& weighted) {
      for_each_coordinate(joined, component, values, weighted, [&](int column, const Base& entry) {
        add_entry<Real, Q>(matrix, row, column, entry, finite);
      });
    });
  }
}

template <class Real, int Q>
void add_force(const Joined& joined, const ElementView<Series<Real, Q>>& view,
               const PathValues<Series<Real, Q>>& values, BasicSteadyResidual<Real>& sum, bool& finite) {
  using Base = Series<Real, Q>;
  for (int i = 0; i < joined.components(); ++i) {
    const Base value = values.times(joined.strength, -view.component(i));
    for_each_coordinate(joined, i, values, value, [&](int row, const Base& entry) {
      add_entry<Real, Q>(sum.force, row, entry, finite);
    });
  }
}

template <class Real, int Q, class Element>
bool linearize_force(const Placed<Element>& placed, const PathValues<Series<Real, Q>>& values,
                     LinearizationScatter<Real, Q>& sum) {
  using Base = Series<Real, Q>;
  constexpr int n_states = number_of_states<Element>();
  bool finite = true;
  const Joined joined = join(placed, values.triples.size());
  const auto all = positions(joined, values);
  const std::span<const Vec3<Base>> arguments(all.data(), placed.arguments.size());
  const auto differentiate = [&](bool vectors, bool states, Motion motion, Scatter<Real, Q>& matrix) {
    if (!vectors && !states) return;
    std::optional<ElementMatrix<Real, Q>> by_coordinates;
    if (matrix.is_sparse()) by_coordinates.emplace(joined, values);
    const int last = states ? joined.components() : joined.of_vectors();
    for (int component = vectors ? 0 : joined.of_vectors(); component < last; ++component) {
      std::array<Series<Base, 1>, n_states> state_force{};
      ElementView<Series<Base, 1>> view(values, arguments, Seed{motion, component}, states_of(placed, values),
                                        state_force);
      placed.element.force(view);
      if (by_coordinates)
        by_coordinates->add_column(component, view);
      else
        add_column<Real, Q>(joined, component, view, values, matrix, finite);
    }
    if (by_coordinates) by_coordinates->add_to(matrix, finite);
  };
  differentiate(Element::depends.acceleration, false, Motion::acceleration, sum.M);
  differentiate(Element::depends.velocity, n_states > 0, Motion::velocity, sum.C);
  differentiate(Element::depends.position, n_states > 0, Motion::position, sum.K);
  return finite;
}

template <class Real, int Q, class Element>
bool force_residual(const Placed<Element>& placed, const PathValues<Series<Real, Q>>& values,
                    BasicSteadyResidual<Real>& sum) {
  using Base = Series<Real, Q>;
  bool finite = true;
  const Joined joined = join(placed, values.triples.size());
  const auto all = positions(joined, values);
  std::array<Base, number_of_states<Element>()> state_force{};
  ElementView<Base> view(values, std::span<const Vec3<Base>>(all.data(), placed.arguments.size()), {},
                         states_of(placed, values), state_force);
  placed.element.force(view);
  add_force<Real, Q>(joined, view, values, sum, finite);
  return finite;
}

template <class Scalar>
Scalar angle_at(const TrimAngle& angle, const ElementView<Scalar>& view) {
  const detail::AngleAt<Scalar> theta(view, angle.angle);
  return angle_of(theta.sine, theta.cosine);
}

template <class Base>
Base angle_value(const TrimAngle& angle, const PathValues<Base>& values) {
  const Quantity none;
  const auto all = positions(Joined{angle.arguments, none, 0, 0}, values);
  return angle_at(angle, ElementView<Base>(values, {all.data(), angle.arguments.size()}));
}

/// Adds the derivative of an angle with respect to the coordinates.
inline void add_angle_gradient(const TrimAngle& angle, const PathValues<Series<double, 0>>& values,
                               Vector& of_x) {
  using Base = Series<double, 0>;
  const Quantity none;
  const Joined joined{angle.arguments, none, 0, 0};
  const auto all = positions(joined, values);
  for (int component = 0; component < joined.of_vectors(); ++component) {
    const ElementView<Series<Base, 1>> view(values, {all.data(), angle.arguments.size()},
                                            Seed{Motion::position, component});
    const Base slope = angle_at(angle, view)[1];
    for_each_coordinate(joined, component, values, slope,
                        [&](int column, const Base& weighted) { of_x[column] += weighted[0]; });
  }
}

/// Calls visit(term, sign) for all terms of a difference.
template <class Visit>
void for_each_share(const Difference& difference, Visit visit) {
  double sign = 1.0;
  for (const Place* place : {&difference.first, difference.second ? &*difference.second : nullptr}) {
    if (place != nullptr) {
      for (const Term& term : place->terms) visit(term, sign);
    }
    sign = -1.0;
  }
}

template <class Base>
Vec3<Base> value_of(const Difference& difference, const PathValues<Base>& values) {
  const Vec3<Base> first = values.vector(difference.first);
  return difference.second ? Vec3<Base>(first - values.vector(*difference.second)) : first;
}

/// Value of one row of c. Calls visit(column, g) for every term of its gradient g = dc / dx_column.
template <class Real, int Q, class Visit>
Series<Real, Q> evaluate_row(const ConstraintRow& row, const PathValues<Series<Real, Q>>& values,
                             Visit visit) {
  using Base = Series<Real, Q>;
  const Vec3<Base> a = value_of(row.a, values);
  const Base& offset = values.values[static_cast<std::size_t>(row.offset.slot)];
  const auto add = [&](const Difference& difference, const Vec3<Base>& other) {
    for_each_share(difference, [&](const Term& term, double sign) {
      for (int i = 0; i < 3; ++i) visit(3 * term.triple + i, sign * values.times(term.weight, other[i]));
    });
  };
  if (!row.b) {
    for_each_share(row.a, [&](const Term& term, double sign) {
      visit(3 * term.triple + row.axis, sign * values.times(term.weight, Base(1.0)));
    });
    return a[row.axis] - offset;
  }
  const Vec3<Base> b = value_of(*row.b, values);
  add(row.a, b);
  add(*row.b, a);
  return a.dot(b) - offset;
}

/// Adds the rows of A and (A^T lambda)_/x (Eq. 18): for every pair of terms of a and b, lambda a_/q b_/q' and
/// its transpose.
template <class Real, int Q>
bool linearize_constraint(const Constraint& constraint, const PathValues<Series<Real, Q>>& values,
                          LinearizationScatter<Real, Q>& sum) {
  using Base = Series<Real, Q>;
  bool finite = true;
  int index = constraint.first_row;
  for (const ConstraintRow& row : constraint.rows) {
    evaluate_row<Real, Q>(row, values, [&](int column, const Base& gradient) {
      add_entry<Real, Q>(sum.A, index, column, gradient, finite);
    });
    const Base& lambda = values.lambda[static_cast<std::size_t>(index++)];
    if (!row.b) continue;
    for_each_share(row.a, [&](const Term& p, double sign_p) {
      const Base share = sign_p * values.times(p.weight, lambda);
      for_each_share(*row.b, [&](const Term& q, double sign_q) {
        const Base curvature = sign_q * values.times(q.weight, share);
        for (int i = 0; i < 3; ++i) {
          add_entry<Real, Q>(sum.K, 3 * p.triple + i, 3 * q.triple + i, curvature, finite);
          add_entry<Real, Q>(sum.K, 3 * q.triple + i, 3 * p.triple + i, curvature, finite);
        }
      });
    });
  }
  return finite;
}

/// Adds c, and A^T lambda to the forces.
template <class Real, int Q>
bool constraint_residual(const Constraint& constraint, const PathValues<Series<Real, Q>>& values,
                         BasicSteadyResidual<Real>& sum) {
  using Base = Series<Real, Q>;
  bool finite = true;
  int index = constraint.first_row;
  for (const ConstraintRow& row : constraint.rows) {
    const Base& lambda = values.lambda[static_cast<std::size_t>(index)];
    const Base c = evaluate_row<Real, Q>(row, values, [&](int column, const Base& gradient) {
      add_entry<Real, Q>(sum.force, column, lambda * gradient, finite);
    });
    add_entry<Real, Q>(sum.constraint, index++, c, finite);
  }
  return finite;
}

}  // namespace

template <class Real, int Q>
Assembly<Real, Q>::Assembly(const MultibodyData& data, const BasicPath<Real>& path) : data_(data) {
  const std::vector<Base> x = to_series<Real, Q>(path.x);
  const std::size_t n_vectors = 3 * static_cast<std::size_t>(data.n_triples);
  for (std::size_t i = 0; i < n_vectors; i += 3) values_.triples.push_back({x[i], x[i + 1], x[i + 2]});
  values_.states.assign(x.begin() + static_cast<std::ptrdiff_t>(n_vectors), x.end());
  values_.lambda = to_series<Real, Q>(path.lambda);
  std::vector<Base> parameters = to_series<Real, Q>(path.parameters);
  for (std::size_t i = 0; i < data.trims.size(); ++i) {
    parameters[static_cast<std::size_t>(data.trims[i].parameter)] =
        values_.lambda[static_cast<std::size_t>(data.n_constraints) + i];
  }
  data.parameters.to_si(std::span<Base>(parameters));
  values_.values.reserve(data.quantities.size());
  for (const Expression& quantity : data.quantities) {
    values_.values.push_back(quantity.evaluate(std::span<const Base>(parameters)));
    values_.constant.push_back(is_constant(values_.values.back()));
  }
}

template <class Real, int Q>
template <class Equations, class Force, class Rows>
EvaluationFault Assembly<Real, Q>::visit_all(const Equations& equations, std::vector<std::uint64_t>& counts,
                                             Force add_force, Rows add_rows) {
  EvaluationFault fault;
  const auto note = [&fault](bool finite, const std::string& label) {
    if (!finite && !fault) fault.source = label;
  };
  equations.elements.for_each([&](const auto& list, std::size_t kind) {
    for (const auto& placed : list) note(add_force(placed), placed.label);
    counts[kind] += list.size();
  });
  for (const Constraint& constraint : equations.constraints) {
    note(add_rows(constraint), constraint.label);
    ++counts[Elements::kinds + static_cast<std::size_t>(constraint.kind)];
  }
  return fault;
}

template <class Real, int Q>
template <class Equations>
EvaluationFault Assembly<Real, Q>::residual_of(const Equations& equations, BasicSteadyResidual<Real>& result,
                                               std::vector<std::uint64_t>& counts) const {
  const auto n_trims = static_cast<Eigen::Index>(data_.trims.size());
  result.force = Columns<Real>::Zero(data_.n_coordinates, Q + 1);
  result.constraint = Columns<Real>::Zero(data_.n_constraints + n_trims, Q + 1);
  return visit_all(
      equations, counts, [&](const auto& placed) { return force_residual<Real, Q>(placed, values_, result); },
      [&](const Constraint& c) { return constraint_residual<Real, Q>(c, values_, result); });
}

template <class Real, int Q>
EvaluationFault Assembly<Real, Q>::residual(BasicSteadyResidual<Real>& result,
                                            EvaluationCounts& counts) const {
  EvaluationFault fault = residual_of(data_, result, counts.residual);
  Eigen::Index row = data_.n_constraints;
  for (const TrimCondition& trim : data_.trims) {
    Base value;
    if (auto of_trim = condition(trim, value, counts); of_trim && !fault) fault = of_trim;
    for (int k = 0; k <= Q; ++k) result.constraint(row, k) = value[k];
    ++row;
  }
  return fault;
}

template <class Real, int Q>
EvaluationFault Assembly<Real, Q>::linearize(BasicLinearization<Real>& result,
                                             EvaluationCounts& counts) const {
  LinearizationScatter<Real, Q> sum(data_.n_coordinates, data_.n_constraints);
  const EvaluationFault fault = visit_all(
      data_, counts.linearization,
      [&](const auto& placed) { return linearize_force<Real, Q>(placed, values_, sum); },
      [&](const Constraint& c) { return linearize_constraint<Real, Q>(c, values_, sum); });
  result = sum.take();
  return fault;
}

template <class Real, int Q>
EvaluationFault Assembly<Real, Q>::condition(const TrimCondition& trim, Base& value,
                                             EvaluationCounts& counts) const {
  EvaluationFault fault;
  if (const auto* place = std::get_if<TrimPlace>(&trim.quantity)) {
    value = values_.vector(place->place)[place->axis.index];
  } else if (const auto* angle = std::get_if<TrimAngle>(&trim.quantity)) {
    value = angle_value<Base>(*angle, values_);
  } else {
    const TrimLoad& load = std::get<TrimLoad>(trim.quantity);
    BasicSteadyResidual<Real> work;
    fault = residual_of(load, work, counts.residual);
    const std::vector<Base> force = to_series<Real, Q>(work.force);
    const MovedTriples<Base> moved(load.motion, values_);
    value = Base(0.0);
    moved.for_each([&](int triple, const Vec3<Base>& w) { value -= w.dot(triple_of(force, triple)); });
    value *= Real(load.motion.factor);
  }
  value -= values_.values[static_cast<std::size_t>(trim.target.slot)];
  using std::isfinite;
  for (int k = 0; k <= Q; ++k) {
    if (!isfinite(value[k]) && !fault) fault.source = "the trim condition " + trim.text;
  }
  return fault;
}

template <class Real, int Q>
EvaluationFault Assembly<Real, Q>::trim_rows(TrimDerivatives& result, EvaluationCounts& counts) const {
  const auto n_trims = static_cast<Eigen::Index>(data_.trims.size());
  result.x = Matrix::Zero(n_trims, data_.n_coordinates);
  result.lambda = Matrix::Zero(n_trims, data_.n_constraints);
  if constexpr (Q == 0 && std::is_same_v<Real, double>) {
    for (Eigen::Index i = 0; i < n_trims; ++i) {
      const auto& quantity = data_.trims[static_cast<std::size_t>(i)].quantity;
      Vector of_x = Vector::Zero(data_.n_coordinates);
      if (const auto* place = std::get_if<TrimPlace>(&quantity)) {
        for (const Term& term : place->place.terms)
          of_x[3 * term.triple + place->axis.index] += values_.times(term.weight, Base(1.0))[0];
      } else if (const auto* angle = std::get_if<TrimAngle>(&quantity)) {
        add_angle_gradient(*angle, values_, of_x);
      } else {
        const TrimLoad& load = std::get<TrimLoad>(quantity);
        LinearizationScatter<double, 0> sum(data_.n_coordinates, data_.n_constraints);
        BasicSteadyResidual<double> work;
        if (auto fault = residual_of(load, work, counts.residual)) return fault;
        if (auto fault = visit_all(
                load, counts.linearization,
                [&](const auto& placed) { return linearize_force<double, 0>(placed, values_, sum); },
                [&](const Constraint& c) { return linearize_constraint<double, 0>(c, values_, sum); }))
          return fault;
        const Linearization of_load = sum.take();
        const MovedTriples<Base> moved(load.motion, values_);
        Vector w = Vector::Zero(data_.n_coordinates);
        moved.for_each([&](int triple, const Vec3<Base>& motion) {
          for (int axis = 0; axis < 3; ++axis) w[3 * triple + axis] += motion[axis][0];
        });
        of_x = -of_load.K[0].transposed_times(w);
        moved.add_gradient(load.motion, values_, -work.force.col(0), of_x);
        of_x *= load.motion.factor;
        result.lambda.row(i) = -load.motion.factor * (of_load.A[0] * w).transpose();
      }
      result.x.row(i) = of_x.transpose();
    }
  }
  return {};
}

template class Assembly<double, 0>;
template class Assembly<double, 1>;
template class Assembly<double, 2>;
template class Assembly<double, 3>;
template class Assembly<double, 4>;
template class Assembly<double, 5>;
template class Assembly<Extended, 0>;

}  // namespace eigentrail
