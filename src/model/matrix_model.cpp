#include "eigentrail/model/matrix_model.hpp"

#include <stdexcept>

namespace eigentrail {

Vector MatrixModel::initial_guess(const Vector&) const {
  return Vector::Zero(n_coordinates());
}

EvaluationFault MatrixModel::residual(const Path& path, int order, SteadyResidual& result,
                                      EvaluationCounts&) const {
  if (!path.x.isZero(0.0) || !path.lambda.isZero(0.0))
    throw std::invalid_argument("MatrixModel: expected the equilibrium x = 0, lambda = 0");
  result.force = VectorSeries::Zero(n_coordinates(), order + 1);
  result.constraint = VectorSeries::Zero(n_constraints(), order + 1);
  return {};
}

EvaluationFault MatrixModel::extended_residual(const BasicPath<Extended>&,
                                               BasicSteadyResidual<Extended>& result) const {
  result.force = ExtendedMatrix::Zero(n_coordinates(), 1);
  result.constraint = ExtendedMatrix::Zero(n_constraints(), 1);
  return {};
}

Structure MatrixModel::structure_of_effects() const {
  Structure result;
  for (const Effect& effect : description().effects) {
    if (effect.count == 0) continue;
    result.damped = result.damped || effect.contribution.dissipative;
    result.gyroscopic = result.gyroscopic || effect.contribution.gyroscopic;
    result.circulatory = result.circulatory || effect.contribution.circulatory;
  }
  result.constant_constraints = true;
  result.fixed_equilibrium = true;
  result.known_equilibrium = true;
  return result;
}

}  // namespace eigentrail
