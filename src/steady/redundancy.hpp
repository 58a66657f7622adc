// Constraints that are redundant at a configuration only, and reactions that are not unique.
//
// If the rows of A are dependent, nu^T A = 0, the equilibrium determines lambda up to multiples of nu. Along
// a motion that the constraints allow, the second derivative of nu^T c vanishes, so that
//
//     Q2^T (A^T nu)_/x Q2 = 0.
//
// Where it does not, no motion goes in some direction of the null space of A: the constraints say the same at
// this configuration but not beside it, and the stiffness depends on how they share the load.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/steady/equilibrium.hpp"

namespace eigentrail {

/// Which constraints have reactions that are not unique and change the stiffness of the allowed motions, in a
/// sentence for the user; empty if the stiffness is unique, or the scene shares the reactions. Three
/// evaluations of the model if rows of A are dependent, more if the stiffness is not unique; none otherwise.
std::string undetermined_stiffness(const Model& model, const Vector& parameters, const Equilibrium& at,
                                   EvaluationCounts& counts);

/// Whether the model shares the load of dependent constraints, and there are any.
bool shares_reactions(const Model& model, const ConstraintFactorization& constraints);

/// lambda of the same reaction A^T lambda with the least sum of squares, each in units of its row of A.
Vector least_squares_multipliers(const Equilibrium& at);

/// Power series of these along a path: lambda(h) = D(h)^2 A(h) w(h), where D scales the rows of A to unit
/// length. Order by order, what nu^T A = 0 leaves free in lambda follows from the orders before.
class LeastSquaresSeries {
 public:
  explicit LeastSquaresSeries(const Equilibrium& at);

  /// Completes lambda of order k, of which A^T lambda is right, after orders 1 ... k - 1.
  EvaluationFault complete(const Model& model, int k, Path& path, EvaluationCounts& counts);

 private:
  const ConstraintFactorization& constraints_;
  Matrix A_;
  std::vector<Vector> w_;
};

}  // namespace eigentrail
