// A small interface to KINSOL: damped Newton iteration for F(u) = 0 with a linear solver of eigentrail.
#pragma once

#include <functional>
#include <string>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

struct NonlinearProblem {
  /// Computes F(u); returns false if F is undefined there (the line search then shortens the step).
  std::function<bool(const Vector& u, Vector& f)> residual;
  /// Factors the Jacobian at u; returns false if that is impossible.
  std::function<bool(const Vector& u)> factor;
  /// Solves J du = b with the last factorization.
  std::function<void(const Vector& b, Vector& du)> solve;
  Vector u_scale;  ///< 1 / typical |u_i|
  Vector f_scale;  ///< 1 / typical |F_i|
};

struct NonlinearResult {
  bool converged = false;
  int iterations = 0;
  std::string message;  ///< KINSOL's reason when it did not converge
};

/// Solves from u in place. An exception thrown by a callback is passed on after KINSOL has returned.
NonlinearResult solve_with_kinsol(const NonlinearProblem& problem, double tolerance, int max_iterations,
                                  Vector& u);

}  // namespace eigentrail
