#include "model/assembly.hpp"

#include <cmath>
#include <initializer_list>

#include "model/scatter.hpp"

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

/// Adds a series to an entry of a matrix series. Sets `finite` to false if a coefficient is not finite.
template <class Real, int Q>
void add_entry(Scatter<Real, Q>& sum, int row, int column, const Series<Real, Q>& value, bool& finite) {
  using std::isfinite;
  sum.add(row, column, value);
  for (int k = 0; k <= Q; ++k) finite = finite && isfinite(value[k]);
}

template <class Real, int Q>
void add_entry(Columns<Real>& sum, int row, const Series<Real, Q>& value, bool& finite) {
  using std::isfinite;
  for (int k = 0; k <= Q; ++k) {
    sum(row, k) += value[k];
    finite = finite && isfinite(value[k]);
  }
}

/// Adds entry (i, j) of a 3 x 3 block whose rows belong to `to` and whose columns belong to `from`: weight_to
/// weight_from value for every pair of their terms.
template <class Real, int Q>
void add_weighted(Scatter<Real, Q>& sum, const PathValues<Series<Real, Q>>& values, const Place& to, int i,
                  const Place& from, int j, const Series<Real, Q>& value, bool& finite) {
  for (const Term& row : to.terms) {
    const Series<Real, Q> weighted = values.times(row.weight, value);
    for (const Term& column : from.terms) {
      add_entry<Real, Q>(sum, 3 * row.triple + i, 3 * column.triple + j,
                         values.times(column.weight, weighted), finite);
    }
  }
}

/// The moving vectors and strength of an element. The functions below do not depend on the type of the
/// element, so the compiler instantiates them once per order and not once per order and type.
struct Joined {
  const std::vector<Place>& arguments;
  const Quantity& strength;
};

template <class Base>
std::array<Vec3<Base>, max_arguments> positions(const Joined& joined, const PathValues<Base>& values) {
  std::array<Vec3<Base>, max_arguments> result;
  for (std::size_t i = 0; i < joined.arguments.size(); ++i) result[i] = values.vector(joined.arguments[i]);
  return result;
}

/// Adds the derivative of an element's force in one direction, a column of M, C or K.
template <class Real, int Q>
void add_column(const Joined& joined, int component, const ElementView<Series<Series<Real, Q>, 1>>& view,
                const PathValues<Series<Real, Q>>& values, Scatter<Real, Q>& matrix, bool& finite) {
  const Place& from = joined.arguments[static_cast<std::size_t>(component / 3)];
  for (std::size_t i = 0; i < joined.arguments.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      add_weighted<Real, Q>(matrix, values, joined.arguments[i], axis, from, component % 3,
                            values.times(joined.strength, -view.force(i)[axis][1]), finite);
    }
  }
}

template <class Real, int Q>
void add_force(const Joined& joined, const ElementView<Series<Real, Q>>& view,
               const PathValues<Series<Real, Q>>& values, BasicSteadyResidual<Real>& sum, bool& finite) {
  for (std::size_t i = 0; i < joined.arguments.size(); ++i) {
    for (const Term& row : joined.arguments[i].terms) {
      for (int axis = 0; axis < 3; ++axis) {
        add_entry<Real, Q>(sum.force, 3 * row.triple + axis,
                           values.times(row.weight, values.times(joined.strength, -view.force(i)[axis])),
                           finite);
      }
    }
  }
}

template <class Real, int Q, class Element>
bool linearize_force(const Placed<Element>& placed, const PathValues<Series<Real, Q>>& values,
                     LinearizationScatter<Real, Q>& sum) {
  using Base = Series<Real, Q>;
  bool finite = true;
  const Joined joined{placed.arguments, placed.strength};
  const auto all = positions(joined, values);
  const std::span<const Vec3<Base>> arguments(all.data(), placed.arguments.size());
  const auto differentiate = [&](bool depends, Motion motion, Scatter<Real, Q>& matrix) {
    const int components = depends ? 3 * static_cast<int>(arguments.size()) : 0;
    for (int component = 0; component < components; ++component) {
      ElementView<Series<Base, 1>> view(values, arguments, Seed{motion, component});
      placed.element.force(view);
      add_column<Real, Q>(joined, component, view, values, matrix, finite);
    }
  };
  differentiate(Element::depends.acceleration, Motion::acceleration, sum.M);
  differentiate(Element::depends.velocity, Motion::velocity, sum.C);
  differentiate(Element::depends.position, Motion::position, sum.K);
  return finite;
}

template <class Real, int Q, class Element>
bool force_residual(const Placed<Element>& placed, const PathValues<Series<Real, Q>>& values,
                    BasicSteadyResidual<Real>& sum) {
  using Base = Series<Real, Q>;
  bool finite = true;
  const Joined joined{placed.arguments, placed.strength};
  const auto all = positions(joined, values);
  ElementView<Base> view(values, std::span<const Vec3<Base>>(all.data(), placed.arguments.size()));
  placed.element.force(view);
  add_force<Real, Q>(joined, view, values, sum, finite);
  return finite;
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
  for (std::size_t i = 0; i + 2 < x.size(); i += 3) values_.triples.push_back({x[i], x[i + 1], x[i + 2]});
  values_.lambda = to_series<Real, Q>(path.lambda);
  std::vector<Base> parameters = to_series<Real, Q>(path.parameters);
  data.parameters.to_si(std::span<Base>(parameters));
  values_.values.reserve(data.quantities.size());
  for (const Expression& quantity : data.quantities) {
    values_.values.push_back(quantity.evaluate(std::span<const Base>(parameters)));
  }
}

template <class Real, int Q>
template <class Force, class Rows>
EvaluationFault Assembly<Real, Q>::visit_all(std::vector<std::uint64_t>& counts, Force add_force,
                                             Rows add_rows) const {
  EvaluationFault fault;
  const auto note = [&fault](bool finite, const std::string& label) {
    if (!finite && !fault) fault.source = label;
  };
  data_.elements.for_each([&](const auto& list, std::size_t kind) {
    for (const auto& placed : list) note(add_force(placed), placed.label);
    counts[kind] += list.size();
  });
  for (const Constraint& constraint : data_.constraints) {
    note(add_rows(constraint), constraint.label);
    ++counts[Elements::kinds + static_cast<std::size_t>(constraint.kind)];
  }
  return fault;
}

template <class Real, int Q>
EvaluationFault Assembly<Real, Q>::residual(BasicSteadyResidual<Real>& result,
                                            EvaluationCounts& counts) const {
  result.force = Columns<Real>::Zero(data_.n_coordinates, Q + 1);
  result.constraint = Columns<Real>::Zero(data_.n_constraints, Q + 1);
  return visit_all(
      counts.residual, [&](const auto& placed) { return force_residual<Real, Q>(placed, values_, result); },
      [&](const Constraint& c) { return constraint_residual<Real, Q>(c, values_, result); });
}

template <class Real, int Q>
EvaluationFault Assembly<Real, Q>::linearize(BasicLinearization<Real>& result,
                                             EvaluationCounts& counts) const {
  LinearizationScatter<Real, Q> sum(data_.n_coordinates, data_.n_constraints);
  const EvaluationFault fault = visit_all(
      counts.linearization,
      [&](const auto& placed) { return linearize_force<Real, Q>(placed, values_, sum); },
      [&](const Constraint& c) { return linearize_constraint<Real, Q>(c, values_, sum); });
  result = sum.take();
  return fault;
}

template class Assembly<double, 0>;
template class Assembly<double, 1>;
template class Assembly<double, 2>;
template class Assembly<double, 3>;
template class Assembly<double, 4>;
template class Assembly<double, 5>;
template class Assembly<Extended, 0>;

}  // namespace eigentrail
