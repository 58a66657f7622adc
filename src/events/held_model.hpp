// A model with one of its parameters held at another value than the declared one.
#pragma once

#include "eigentrail/model/model.hpp"

namespace eigentrail {

class HeldModel final : public Model {
 public:
  /// `value` in the parameter's unit. The model must outlive the object.
  HeldModel(const Model& model, int parameter, double value)
      : Model(held(model.description(), parameter, value)), model_(model) {}

  Vector initial_guess(const Vector& parameters) const override { return model_.initial_guess(parameters); }
  Structure structure(int traced) const override { return model_.structure(traced); }
  EvaluationFault residual(const Path& path, int order, SteadyResidual& result,
                           EvaluationCounts& counts) const override {
    return model_.residual(path, order, result, counts);
  }
  EvaluationFault linearize(const Path& path, int order, Linearization& result,
                            EvaluationCounts& counts) const override {
    return model_.linearize(path, order, result, counts);
  }

 private:
  static ModelDescription held(ModelDescription description, int parameter, double value) {
    std::vector<Parameter> list;
    for (std::size_t i = 0; i < description.parameters.size(); ++i) list.push_back(description.parameters[i]);
    list[static_cast<std::size_t>(parameter)].value = value;
    description.parameters = Parameters(std::move(list));
    return description;
  }

  const Model& model_;
};

}  // namespace eigentrail
