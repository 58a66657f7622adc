// Steady equilibrium x0, lambda0 of a model and its power series along the path (seed paper, Eqs. 14, 38).
#pragma once

#include <string>

#include "eigentrail/model/model.hpp"
#include "eigentrail/steady/kkt_factorization.hpp"

namespace eigentrail {

struct SteadyOptions {
  int max_iterations = 200;  ///< of KINSOL, >= 1
  double tolerance =
      1e-12;  ///< KINSOL stops when every equation's residual is below this fraction of its scale, > 0
  bool relax =
      true;  ///< where KINSOL fails, begin again from where the mechanism comes to rest (relaxation.hpp)
};

enum class SteadyStatus { converged, not_converged, not_finite };

/// What the solver did; complete also when it failed.
struct SteadyReport {
  int iterations = 0;      ///< of KINSOL
  int factorizations = 0;  ///< of the KKT matrix, polishing included
  int residual_evaluations = 0;
  bool relaxed = false;        ///< found from a relaxed guess
  double residual = 0.0;       ///< largest scaled residual at the end
  std::string worst_equation;  ///< the equation it belongs to
  std::string message;         ///< reason of a failure, in words
};

struct [[nodiscard]] Equilibrium {
  SteadyStatus status = SteadyStatus::not_converged;
  Vector x;                     ///< n
  Vector lambda;                ///< m
  Linearization linearization;  ///< of order 0 at (x, lambda)
  KktFactorization kkt;         ///< at (x, lambda)
  SteadyReport report;
};

/// Solves the steady equations at given parameters (declared units) from the guess (x, lambda): KINSOL with
/// line search and the exact Jacobian, then Newton corrections until they reach rounding. An empty `lambda`
/// guess is replaced by the least-squares multipliers (Eq. 15) at x. Where that fails the guess is relaxed
/// first.
Equilibrium solve_equilibrium(const Model& model, const Vector& parameters, const Vector& x,
                              const Vector& lambda, const SteadyOptions& options, EvaluationCounts& counts);

/// An equilibrium that is already known: linearizes at (x, lambda) and factors the constraints, without
/// solving.
Equilibrium keep_equilibrium(const Model& model, const Vector& parameters, const Vector& x,
                             const Vector& lambda, EvaluationCounts& counts);

/// Extends an equilibrium to its series of the given order along `parameters` (n_parameters x (<= order + 1),
/// column 0 the values at the equilibrium). One back-substitution per order with the factorization of the
/// equilibrium.
EvaluationFault differentiate_equilibrium(const Model& model, const Equilibrium& equilibrium,
                                          const VectorSeries& parameters, int order, Path& path,
                                          EvaluationCounts& counts);

}  // namespace eigentrail
