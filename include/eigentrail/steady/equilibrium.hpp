// Steady equilibrium x0, lambda0 of a model and its power series along the path (seed paper, Eqs. 14, 38).
#pragma once

#include <optional>
#include <string>

#include "eigentrail/model/model.hpp"
#include "eigentrail/steady/kkt_factorization.hpp"

namespace eigentrail {

struct SteadyOptions {
  int max_iterations = 200;  ///< limit of KINSOL's iterations, >= 1
  /// KINSOL stops when the residual of every equation is below this fraction of its scale; > 0.
  double tolerance = 1e-12;
  bool relax = true;  ///< if KINSOL fails, start again from a relaxed guess (relaxation.hpp)
};

/// Outcome of a solution; `not_finite` means that the model returned a number that is not finite.
enum class SteadyStatus { converged, not_converged, not_finite };

/// Work of the solver and the result of its checks; complete also after a failure.
struct SteadyReport {
  int iterations = 0;      ///< iterations of KINSOL
  int factorizations = 0;  ///< factorizations of the KKT matrix, final Newton corrections included
  int residual_evaluations = 0;
  bool relaxed = false;        ///< the solution was found from a relaxed guess
  double residual = 0.0;       ///< largest residual at the end, relative to its scale
  std::string worst_equation;  ///< the equation with the largest residual
  std::string message;         ///< reason of a failure
};

/// An equilibrium with its linearization, for a model with n coordinates, m constraints and k trimmed
/// parameters.
struct [[nodiscard]] Equilibrium {
  SteadyStatus status = SteadyStatus::not_converged;
  Vector x;                     ///< n
  Vector lambda;                ///< m + k: multipliers, then trimmed parameters in their declared units
  Linearization linearization;  ///< of order 0, at (x, lambda)
  KktFactorization kkt;         ///< factored at (x, lambda)
  SteadyReport report;
};

/// Solves the steady equations at given parameters (declared units) from the guess (x, lambda). KINSOL
/// iterates with a line search and the exact Jacobian; Newton corrections then reduce the error to the
/// rounding level. An empty `lambda` is replaced by the least-squares multipliers (Eq. 15) at x. If this
/// fails and options.relax is set, the guess is relaxed and the solution repeated. Failures are reported in
/// the status. Trimmed parameters are unknowns like the multipliers; their values in `parameters` are the
/// guess if `lambda` is empty.
Equilibrium solve_equilibrium(const Model& model, const Vector& parameters, const Vector& x,
                              const Vector& lambda, const SteadyOptions& options, EvaluationCounts& counts);

/// The equilibrium at positions x that are known to be one: the multipliers are those of least squares (Eq.
/// 15). Only the constraints are factored.
Equilibrium equilibrium_at_rest(const Model& model, const Vector& parameters, const Vector& x,
                                EvaluationCounts& counts);

/// The same, where it is not known: empty if a Newton correction of x is more than rounding.
std::optional<Equilibrium> find_rest(const Model& model, const Vector& parameters, const Vector& x,
                                     EvaluationCounts& counts);

/// Takes an equilibrium that is already known: linearizes at (x, lambda) and factors the constraints, without
/// solving.
Equilibrium keep_equilibrium(const Model& model, const Vector& parameters, const Vector& x,
                             const Vector& lambda, EvaluationCounts& counts);

/// Power series of an equilibrium up to h^order along `parameters` (n_parameters x (<= order + 1); column 0
/// holds the values at the equilibrium). One back-substitution per order with the factorization of the
/// equilibrium. Returns a fault if a number is not finite.
EvaluationFault differentiate_equilibrium(const Model& model, const Equilibrium& equilibrium,
                                          const VectorSeries& parameters, int order, Path& path,
                                          EvaluationCounts& counts);

/// The same for an equilibrium whose positions do not change along `parameters`: series of the multipliers by
/// least squares.
EvaluationFault differentiate_multipliers(const Model& model, const Equilibrium& equilibrium,
                                          const VectorSeries& parameters, int order, Path& path,
                                          EvaluationCounts& counts);

}  // namespace eigentrail
