#include "model/assembly.hpp"

#include <cmath>

namespace eigentrail {
namespace {

template <int Q>
std::vector<Series<double, Q>> to_series(const VectorSeries& coefficients) {
  std::vector<Series<double, Q>> series(static_cast<std::size_t>(coefficients.rows()));
  for (Eigen::Index i = 0; i < coefficients.rows(); ++i) {
    for (int k = 0; k <= Q; ++k) series[static_cast<std::size_t>(i)][k] = coefficient(coefficients, i, k);
  }
  return series;
}

/// Adds a series to an entry of a matrix series and notes whether all its coefficients are finite.
template <int Q>
void add_entry(MatrixSeries& sum, int row, int column, const Series<double, Q>& value, bool& finite) {
  for (int k = 0; k <= Q; ++k) {
    sum[k](row, column) += value[k];
    finite = finite && std::isfinite(value[k]);
  }
}

template <int Q>
void add_entry(VectorSeries& sum, int row, const Series<double, Q>& value, bool& finite) {
  for (int k = 0; k <= Q; ++k) {
    sum(row, k) += value[k];
    finite = finite && std::isfinite(value[k]);
  }
}

/// Drops the trailing coefficients that are exactly zero: a constant keeps one.
void trim(MatrixSeries& series) {
  while (series.size() > 1 && series.back().isZero(0.0)) series.pop_back();
}

/// Evaluates one element with forces: its derivative in each direction gives a column of M, C or K.
template <int Q, class Element>
bool linearize_force(const Placed<Element>& placed, const PathValues<Series<double, Q>>& values,
                     std::span<const Series<double, Q>> lambda, Linearization& sum) {
  using Scalar = Series<Series<double, Q>, 1>;
  bool finite = true;
  const auto differentiate = [&](bool depends, Motion motion, MatrixSeries& matrix) {
    if (!depends) return;
    for (const int point : placed.points) {
      for (int column = 3 * point; column < 3 * point + 3; ++column) {
        ElementView<Scalar> view(values, placed.points, lambda, {Seed{motion, column}});
        placed.element.force(view);
        for (std::size_t i = 0; i < placed.points.size(); ++i) {
          for (int axis = 0; axis < 3; ++axis) {
            add_entry<Q>(matrix, 3 * placed.points[i] + axis, column, -view.force(i)[axis][1], finite);
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
template <int Q, class Element>
bool linearize_constraint(const Placed<Element>& placed, const PathValues<Series<double, Q>>& values,
                          std::span<const Series<double, Q>> lambda, Linearization& sum) {
  using Scalar = Series<Series<Series<double, Q>, 1>, 1>;
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
      const Series<double, Q>& curvature = view.lagrangian()[1][1];
      add_entry<Q>(sum.K, a, b, curvature, finite);
      if (a == b) {
        for (int row = 0; row < Element::constraint_count; ++row) {
          add_entry<Q>(sum.A, placed.first_row + row, a, view.constraint(row)[0][1], finite);
        }
      } else {
        add_entry<Q>(sum.K, b, a, curvature, finite);
      }
    }
  }
  return finite;
}

template <int Q, class Element>
bool force_residual(const Placed<Element>& placed, const PathValues<Series<double, Q>>& values,
                    std::span<const Series<double, Q>> lambda, SteadyResidual& sum) {
  bool finite = true;
  ElementView<Series<double, Q>> view(values, placed.points, lambda);
  placed.element.force(view);
  for (std::size_t i = 0; i < placed.points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      add_entry<Q>(sum.force, 3 * placed.points[i] + axis, -view.force(i)[axis], finite);
    }
  }
  return finite;
}

template <int Q, class Element>
bool constraint_residual(const Placed<Element>& placed, const PathValues<Series<double, Q>>& values,
                         std::span<const Series<double, Q>> lambda, SteadyResidual& sum) {
  using Scalar = Series<Series<double, Q>, 1>;
  bool finite = true;
  bool first = true;
  for (const int point : placed.points) {
    for (int i = 3 * point; i < 3 * point + 3; ++i) {
      ElementView<Scalar> view(values, placed.points, lambda, {Seed{Motion::position, i}});
      placed.element.constraint(view);
      add_entry<Q>(sum.force, i, view.lagrangian()[1], finite);
      for (int row = 0; first && row < Element::constraint_count; ++row) {
        add_entry<Q>(sum.constraint, placed.first_row + row, view.constraint(row)[0], finite);
      }
      first = false;
    }
  }
  return finite;
}

template <int Q, class Element>
std::span<const Series<double, Q>> own_multipliers(const Placed<Element>& placed,
                                                   const PathValues<Series<double, Q>>& values) {
  if constexpr (HasConstraint<Element>) {
    return std::span(values.lambda)
        .subspan(static_cast<std::size_t>(placed.first_row), Element::constraint_count);
  } else {
    return {};
  }
}

MatrixSeries zero_series(int order, Eigen::Index rows, Eigen::Index columns) {
  return MatrixSeries(static_cast<std::size_t>(order) + 1, Matrix::Zero(rows, columns));
}

}  // namespace

template <int Q>
Assembly<Q>::Assembly(const MultibodyData& data, const Path& path) : data_(data) {
  values_.x = to_series<Q>(path.x);
  values_.lambda = to_series<Q>(path.lambda);
  std::vector<Base> parameters = to_series<Q>(path.parameters);
  data.parameters.to_si(std::span<Base>(parameters));
  values_.values.reserve(data.quantities.size());
  for (const Expression& quantity : data.quantities) {
    values_.values.push_back(quantity.evaluate(std::span<const Base>(parameters)));
  }
}

template <int Q>
EvaluationFault Assembly<Q>::residual(SteadyResidual& result, EvaluationCounts& counts) const {
  result.force = VectorSeries::Zero(data_.n_coordinates, Q + 1);
  result.constraint = VectorSeries::Zero(data_.n_constraints, Q + 1);
  EvaluationFault fault;
  data_.elements.for_each([&]<class Element>(const std::vector<Placed<Element>>& list, std::size_t kind) {
    for (const Placed<Element>& placed : list) {
      const auto lambda = own_multipliers<Q>(placed, values_);
      bool finite = true;
      if constexpr (HasForce<Element>) finite = force_residual<Q>(placed, values_, lambda, result) && finite;
      if constexpr (HasConstraint<Element>)
        finite = constraint_residual<Q>(placed, values_, lambda, result) && finite;
      if (!finite && !fault) fault.source = placed.label;
    }
    counts.residual[kind] += list.size();
  });
  return fault;
}

template <int Q>
EvaluationFault Assembly<Q>::linearize(Linearization& result, EvaluationCounts& counts) const {
  const int n = data_.n_coordinates;
  result.M = zero_series(Q, n, n);
  result.C = zero_series(Q, n, n);
  result.K = zero_series(Q, n, n);
  result.A = zero_series(Q, data_.n_constraints, n);
  EvaluationFault fault;
  data_.elements.for_each([&]<class Element>(const std::vector<Placed<Element>>& list, std::size_t kind) {
    for (const Placed<Element>& placed : list) {
      const auto lambda = own_multipliers<Q>(placed, values_);
      bool finite = true;
      if constexpr (HasForce<Element>) finite = linearize_force<Q>(placed, values_, lambda, result) && finite;
      if constexpr (HasConstraint<Element>)
        finite = linearize_constraint<Q>(placed, values_, lambda, result) && finite;
      if (!finite && !fault) fault.source = placed.label;
    }
    counts.linearization[kind] += list.size();
  });
  trim(result.M);
  trim(result.C);
  trim(result.K);
  trim(result.A);
  return fault;
}

template class Assembly<0>;
template class Assembly<1>;
template class Assembly<2>;
template class Assembly<3>;
template class Assembly<4>;
template class Assembly<5>;

}  // namespace eigentrail
