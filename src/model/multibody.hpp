// Model of points and rigid bodies with elements and constraints. Coordinates: x, y, z of every point in the
// order of the scene, then origin and three directors of every body, inflows of rotors, and states of
// elements.
#pragma once

#include "model/assembly.hpp"

namespace eigentrail {

/// Structure of the equations of these elements and constraints together, as Model::structure, while the
/// `moving` parameters change: the traced one and the unknowns of trims.
Structure structure_of(std::initializer_list<const Assembly*> parts, const std::vector<int>& moving);

/// The traced parameter, and the trimmed ones, which follow it.
std::vector<int> moving_parameters(const ModelDescription& description, int traced_parameter);

/// The derivatives of the steady equations and conditions with respect to the trimmed parameters: `force`,
/// `constraint` and `trim` of `result`.
EvaluationFault differentiate_by_unknowns(const Model& model, const Path& at, TrimDerivatives& result,
                                          EvaluationCounts& counts);

/// The description with the costs of recorded equations added to its effects.
ModelDescription with_costs(ModelDescription description,
                            std::initializer_list<const RecordedEquations*> equations);

/// The expressions that are not constant, each once.
std::vector<Expression> varying(const std::vector<Expression>& quantities);

/// Solves the equations of the states of elements, the last `n_states` coordinates of a model, by Newton's
/// method, with points and bodies where x has them.
void settle_states(const Model& model, Eigen::Index n_states, const Vector& parameters, Vector& x);

class Multibody final : public Model {
 public:
  /// The costs of what is recorded are added to the description.
  Multibody(ModelDescription description, Assembly assembly, std::vector<Expression> guess);

  Vector initial_guess(const Vector& parameters) const override;
  Structure structure(int traced_parameter) const override;
  EvaluationFault residual(const Path& path, int order, SteadyResidual& result,
                           EvaluationCounts& counts) const override;
  EvaluationFault linearize(const Path& path, int order, Linearization& result,
                            EvaluationCounts& counts) const override;
  EvaluationFault trim_derivatives(const Path& at, TrimDerivatives& result,
                                   EvaluationCounts& counts) const override;
  std::vector<Expression> expressions() const override;
  EvaluationFault extended_residual(const BasicPath<Extended>& path,
                                    BasicSteadyResidual<Extended>& result) const override;
  EvaluationFault extended_linearization(const BasicPath<Extended>& path,
                                         BasicLinearization<Extended>& result) const override;

 private:
  Assembly assembly_;
  std::vector<Expression> guess_;  ///< one per coordinate of points and bodies
};

}  // namespace eigentrail
