// Evaluates recorded equations: runs the programs of all batches and adds up what they give.
#pragma once

#include "model/path_values.hpp"
#include "model/record/evaluation.hpp"
#include "model/recorded_equations.hpp"

namespace eigentrail {

/// Memory of the evaluation of equations.
template <class Real>
struct EquationWork {
  Evaluation<Real, 1> single;
  Evaluation<Real, std::is_same_v<Real, double> ? lanes : 1> several;
  std::array<typename BasicPath<Real>::Columns, 4> sums;  ///< (order + 1) x pattern size
};

/// Residual of equations: sets `result`, of which only the first m rows of `constraint` are set.
template <class Real>
EvaluationFault evaluate_residual(const RecordedEquations& equations, const PathValues<Real>& values,
                                  EquationWork<Real>& work, BasicSteadyResidual<Real>& result);

template <class Real>
EvaluationFault evaluate_linearization(const RecordedEquations& equations, const PathValues<Real>& values,
                                       EquationWork<Real>& work, BasicLinearization<Real>& result);

}  // namespace eigentrail
