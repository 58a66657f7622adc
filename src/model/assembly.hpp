// Evaluates all elements of a multibody model as power series of order Q along a path. Real is double, or
// Extended for reference solutions.
#pragma once

#include <stdexcept>
#include <string>

#include "model/trim.hpp"

namespace eigentrail {

/// The data of a multibody model. Counters of constraint kinds follow those of elements.
struct MultibodyData {
  Elements elements;
  std::vector<Constraint> constraints;
  std::vector<TrimCondition> trims;
  std::vector<Expression> quantities;  ///< by Quantity::slot
  Parameters parameters;
  int n_triples = 0;      ///< of points and bodies
  int n_coordinates = 0;  ///< 3 n_triples, and one for each state of an element
  int n_constraints = 0;
};

template <class Real, int Q>
class Assembly {
 public:
  Assembly(const MultibodyData& data, const BasicPath<Real>& path);

  EvaluationFault residual(BasicSteadyResidual<Real>& result, EvaluationCounts& counts) const;
  EvaluationFault linearize(BasicLinearization<Real>& result, EvaluationCounts& counts) const;

  /// Derivatives of the conditions of the trim with respect to x and lambda: `x` and `lambda` of `result`.
  /// Only for Real = double and Q = 0.
  EvaluationFault trim_rows(TrimDerivatives& result, EvaluationCounts& counts) const;

 private:
  using Base = Series<Real, Q>;

  /// Calls add_force or add_rows for every element and constraint of the model, or of the load of a trim, and
  /// counts the calls. The fault names the first one whose result is not finite.
  template <class Equations, class Force, class Rows>
  static EvaluationFault visit_all(const Equations& equations, std::vector<std::uint64_t>& counts,
                                   Force add_force, Rows add_rows);

  /// Residual of some equations.
  template <class Equations>
  EvaluationFault residual_of(const Equations& equations, BasicSteadyResidual<Real>& result,
                              std::vector<std::uint64_t>& counts) const;

  /// Quantity minus target.
  EvaluationFault condition(const TrimCondition& trim, Base& value, EvaluationCounts& counts) const;

  const MultibodyData& data_;
  PathValues<Base> values_;
};

/// Calls visit.operator()<Q>() with Q = order, for what depends on the order of series at compile time.
template <class Visit>
EvaluationFault with_order(int order, Visit&& visit) {
  switch (order) {
    case 0:
      return visit.template operator()<0>();
    case 1:
      return visit.template operator()<1>();
    case 2:
      return visit.template operator()<2>();
    case 3:
      return visit.template operator()<3>();
    case 4:
      return visit.template operator()<4>();
    case 5:
      return visit.template operator()<5>();
    default:
      throw std::invalid_argument("order of a series: expected 0 to 5, got " + std::to_string(order));
  }
}

extern template class Assembly<double, 0>;
extern template class Assembly<double, 1>;
extern template class Assembly<double, 2>;
extern template class Assembly<double, 3>;
extern template class Assembly<double, 4>;
extern template class Assembly<double, 5>;
extern template class Assembly<Extended, 0>;

}  // namespace eigentrail
