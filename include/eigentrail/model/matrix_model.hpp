// A model that is given by its matrices, M(p) x'' + C(p) x' + K(p) x + A(p)^T lambda = 0 with A(p) x = 0: its
// equilibrium is x = 0, lambda = 0 for all parameters.
#pragma once

#include "eigentrail/model/model.hpp"

namespace eigentrail {

class MatrixModel : public Model {
 public:
  Vector initial_guess(const Vector& parameters) const override;
  /// Throws std::invalid_argument for another x or lambda than the equilibrium.
  EvaluationFault residual(const Path& path, int order, SteadyResidual& result,
                           EvaluationCounts& counts) const override;
  EvaluationFault extended_residual(const BasicPath<Extended>& path,
                                    BasicSteadyResidual<Extended>& result) const override;

 protected:
  using Model::Model;

  /// What the effects that occur contribute, with constant constraints. What else is constant, and whether M
  /// is symmetric, is for the model to say.
  Structure structure_of_effects() const;
};

}  // namespace eigentrail
