#include "model/assembly.hpp"

#include <cmath>

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

/// Adds a series to an entry of a matrix series and notes whether all its coefficients are finite.
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

/// Evaluates one element with forces: its derivative in each direction gives a column of M, C or K.
template <class Real, int Q, class Element>
bool linearize_force(const Placed<Element>& placed, const PathValues<Series<Real, Q>>& values,
                     std::span<const Series<Real, Q>> lambda, LinearizationScatter<Real, Q>& sum) {
  using Scalar = Series<Series<Real, Q>, 1>;
  bool finite = true;
  const auto differentiate = [&](bool depends, Motion motion, Scatter<Real, Q>& matrix) {
    if (!depends) return;
    for (const int point : placed.points) {
      for (int column = 3 * point; column < 3 * point + 3; ++column) {
        ElementView<Scalar> view(values, placed.points, lambda, {Seed{motion, column}});
        placed.element.force(view);
        for (std::size_t i = 0; i < placed.points.size(); ++i) {
          for (int axis = 0; axis < 3; ++axis) {
            add_entry<Real, Q>(matrix, 3 * placed.points[i] + axis, column, -view.force(i)[axis][1], finite);
          }
        }
      }
    }
  };
  differentiate(Element::depends.acceleration, Motion::acceleration, sum.M);
  differentiate(Element::depends.velocity, Motion::velocity, sum.C);
  differentiate(Element::depends.position, Motion::position, sum.K);
  return finite;
}

/// Rows of A, and (A^T lambda)_/x as the second derivatives of lambda^T c (Eq. 18), which is symmetric.
template <class Real, int Q, class Element>
bool linearize_constraint(const Placed<Element>& placed, const PathValues<Series<Real, Q>>& values,
                          std::span<const Series<Real, Q>> lambda, LinearizationScatter<Real, Q>& sum) {
  using Scalar = Series<Series<Series<Real, Q>, 1>, 1>;
  bool finite = true;
  std::vector<int> coordinates;
  for (const int point : placed.points) {
    for (int axis = 0; axis < 3; ++axis) coordinates.push_back(3 * point + axis);
  }
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const int a = coordinates[i];
      const int b = coordinates[j];
      ElementView<Scalar> view(values, placed.points, lambda,
                               {Seed{Motion::position, a}, Seed{Motion::position, b}});
      placed.element.constraint(view);
      const Series<Real, Q>& curvature = view.lagrangian()[1][1];
      add_entry<Real, Q>(sum.K, a, b, curvature, finite);
      if (a == b) {
        for (int row = 0; row < Element::constraint_count; ++row) {
          add_entry<Real, Q>(sum.A, placed.first_row + row, a, view.constraint(row)[0][1], finite);
        }
      } else {
        add_entry<Real, Q>(sum.K, b, a, curvature, finite);
      }
    }
  }
  return finite;
}

template <class Real, int Q, class Element>
bool force_residual(const Placed<Element>& placed, const PathValues<Series<Real, Q>>& values,
                    std::span<const Series<Real, Q>> lambda, BasicSteadyResidual<Real>& sum) {
  bool finite = true;
  ElementView<Series<Real, Q>> view(values, placed.points, lambda);
  placed.element.force(view);
  for (std::size_t i = 0; i < placed.points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      add_entry<Real, Q>(sum.force, 3 * placed.points[i] + axis, -view.force(i)[axis], finite);
    }
  }
  return finite;
}

template <class Real, int Q, class Element>
bool constraint_residual(const Placed<Element>& placed, const PathValues<Series<Real, Q>>& values,
                         std::span<const Series<Real, Q>> lambda, BasicSteadyResidual<Real>& sum) {
  using Scalar = Series<Series<Real, Q>, 1>;
  bool finite = true;
  bool first = true;
  for (const int point : placed.points) {
    for (int i = 3 * point; i < 3 * point + 3; ++i) {
      ElementView<Scalar> view(values, placed.points, lambda, {Seed{Motion::position, i}});
      placed.element.constraint(view);
      add_entry<Real, Q>(sum.force, i, view.lagrangian()[1], finite);
      for (int row = 0; first && row < Element::constraint_count; ++row) {
        add_entry<Real, Q>(sum.constraint, placed.first_row + row, view.constraint(row)[0], finite);
      }
      first = false;
    }
  }
  return finite;
}

template <class Real, int Q, class Element>
std::span<const Series<Real, Q>> own_multipliers(const Placed<Element>& placed,
                                                 const PathValues<Series<Real, Q>>& values) {
  if constexpr (HasConstraint<Element>) {
    return std::span(values.lambda)
        .subspan(static_cast<std::size_t>(placed.first_row), Element::constraint_count);
  } else {
    return {};
  }
}

}  // namespace

template <class Real, int Q>
Assembly<Real, Q>::Assembly(const MultibodyData& data, const BasicPath<Real>& path) : data_(data) {
  values_.x = to_series<Real, Q>(path.x);
  values_.lambda = to_series<Real, Q>(path.lambda);
  std::vector<Base> parameters = to_series<Real, Q>(path.parameters);
  data.parameters.to_si(std::span<Base>(parameters));
  values_.values.reserve(data.quantities.size());
  for (const Expression& quantity : data.quantities) {
    values_.values.push_back(quantity.evaluate(std::span<const Base>(parameters)));
  }
}

template <class Real, int Q>
EvaluationFault Assembly<Real, Q>::residual(BasicSteadyResidual<Real>& result,
                                            EvaluationCounts& counts) const {
  result.force = Columns<Real>::Zero(data_.n_coordinates, Q + 1);
  result.constraint = Columns<Real>::Zero(data_.n_constraints, Q + 1);
  EvaluationFault fault;
  data_.elements.for_each([&]<class Element>(const std::vector<Placed<Element>>& list, std::size_t kind) {
    for (const Placed<Element>& placed : list) {
      const auto lambda = own_multipliers<Real, Q>(placed, values_);
      bool finite = true;
      if constexpr (HasForce<Element>)
        finite = force_residual<Real, Q>(placed, values_, lambda, result) && finite;
      if constexpr (HasConstraint<Element>)
        finite = constraint_residual<Real, Q>(placed, values_, lambda, result) && finite;
      if (!finite && !fault) fault.source = placed.label;
    }
    counts.residual[kind] += list.size();
  });
  return fault;
}

template <class Real, int Q>
EvaluationFault Assembly<Real, Q>::linearize(BasicLinearization<Real>& result,
                                             EvaluationCounts& counts) const {
  LinearizationScatter<Real, Q> sum(data_.n_coordinates, data_.n_constraints);
  EvaluationFault fault;
  data_.elements.for_each([&]<class Element>(const std::vector<Placed<Element>>& list, std::size_t kind) {
    for (const Placed<Element>& placed : list) {
      const auto lambda = own_multipliers<Real, Q>(placed, values_);
      bool finite = true;
      if constexpr (HasForce<Element>)
        finite = linearize_force<Real, Q>(placed, values_, lambda, sum) && finite;
      if constexpr (HasConstraint<Element>)
        finite = linearize_constraint<Real, Q>(placed, values_, lambda, sum) && finite;
      if (!finite && !fault) fault.source = placed.label;
    }
    counts.linearization[kind] += list.size();
  });
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
