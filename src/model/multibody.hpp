// Model of points and rigid bodies with elements and constraints. Coordinates: x, y, z of every point in the
// order of the scene, then origin and three directors of every body, inflows of rotors, and states of
// elements.
#pragma once

#include "model/assembly.hpp"

namespace eigentrail {

/// The traced parameter, and the trimmed ones, which follow it.
std::vector<int> moving_parameters(const ModelDescription& description, int traced_parameter);

/// The derivatives of the steady equations and conditions with respect to the trimmed parameters: `force`,
/// `constraint` and `trim` of `result`.
EvaluationFault differentiate_by_unknowns(const Model& model, const Path& at, TrimDerivatives& result,
                                          EvaluationCounts& counts);

/// The expressions that are not constant, each once.
std::vector<Expression> varying(const std::vector<Expression>& quantities);

/// Solves the equations of the states of elements, the last coordinates of a model, by Newton's method, with
/// points and bodies where x has them.
void settle_states(const Model& model, const Vector& parameters, Vector& x);

/// A model of recorded equations: those of an Assembly, or of a rotor of equal blades (RotorEquations).
template <class Equations>
class RecordedModel final : public Model {
 public:
  /// `guess`: by coordinate of points and bodies of the scene. The costs of what is recorded are added to the
  /// description.
  RecordedModel(ModelDescription description, Equations equations, std::vector<Expression> guess)
      : Model(equations.with_costs(std::move(description))),
        equations_(std::move(equations)),
        guess_(std::move(guess)) {}

  Vector initial_guess(const Vector& parameters) const override {
    const Vector si = equations_.data().parameters.in_si(parameters);
    Vector x = Vector::Zero(n_coordinates());
    for (std::size_t i = 0; i < guess_.size(); ++i) x[equations_.coordinate(i)] = guess_[i].value(si);
    settle_states(*this, parameters, x);
    return x;
  }
  Structure structure(int traced_parameter) const override {
    return equations_.structure(moving_parameters(description(), traced_parameter));
  }
  EvaluationFault residual(const Path& path, int order, SteadyResidual& result,
                           EvaluationCounts& counts) const override {
    return equations_.residual(path, order, result, counts);
  }
  EvaluationFault linearize(const Path& path, int order, Linearization& result,
                            EvaluationCounts& counts) const override {
    return equations_.linearize(path, order, result, counts);
  }
  EvaluationFault trim_derivatives(const Path& at, TrimDerivatives& result,
                                   EvaluationCounts& counts) const override {
    if (auto fault = differentiate_by_unknowns(*this, at, result, counts)) return fault;
    return equations_.trim_rows(at, result, counts);
  }
  std::vector<Expression> expressions() const override { return varying(equations_.data().quantities); }
  EvaluationFault extended_residual(const BasicPath<Extended>& path,
                                    BasicSteadyResidual<Extended>& result) const override {
    EvaluationCounts counts = new_counts();
    return equations_.residual(path, 0, result, counts);
  }
  EvaluationFault extended_linearization(const BasicPath<Extended>& path,
                                         BasicLinearization<Extended>& result) const override {
    EvaluationCounts counts = new_counts();
    return equations_.linearize(path, 0, result, counts);
  }

 private:
  Equations equations_;
  std::vector<Expression> guess_;
};

using Multibody = RecordedModel<Assembly>;

}  // namespace eigentrail
