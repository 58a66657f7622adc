// A model that is given by its matrices, M(p) x'' + C(p) x' + K(p) x + A(p)^T lambda = 0 with A(p) x = 0: its
// equilibrium is x = 0, lambda = 0 for all parameters.
#pragma once

#include <stdexcept>

#include "eigentrail/model/model.hpp"

namespace eigentrail {

class MatrixModel : public Model {
 public:
  Vector initial_guess(const Vector&) const override { return Vector::Zero(n_coordinates()); }
  /// Throws std::invalid_argument for another x or lambda than the equilibrium.
  EvaluationFault residual(const Path& path, int order, SteadyResidual& result,
                           EvaluationCounts&) const override {
    if (!path.x.isZero(0.0) || !path.lambda.isZero(0.0))
      throw std::invalid_argument("MatrixModel: expected the equilibrium x = 0, lambda = 0");
    result.force = VectorSeries::Zero(n_coordinates(), order + 1);
    result.constraint = VectorSeries::Zero(n_constraints(), order + 1);
    return {};
  }
  EvaluationFault extended_residual(const BasicPath<Extended>&,
                                    BasicSteadyResidual<Extended>& result) const override {
    result.force = ExtendedMatrix::Zero(n_coordinates(), 1);
    result.constraint = ExtendedMatrix::Zero(n_constraints(), 1);
    return {};
  }

 protected:
  using Model::Model;

  /// What the effects that occur contribute, with constant constraints. What else is constant, and whether M
  /// is symmetric, is for the model to say.
  Structure structure_of_effects() const {
    Structure result;
    for (const Effect& effect : description().effects) {
      if (effect.count > 0) result.add(effect.contribution);
    }
    result.constant_constraints = true;
    result.fixed_equilibrium = true;
    result.known_equilibrium = true;
    return result;
  }
};

}  // namespace eigentrail
