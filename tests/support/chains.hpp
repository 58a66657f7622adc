// Rotating chains of point masses, of any size, and models that convert the matrices of another model from
// sparse to dense or the reverse.
#pragma once

#include <string>

#include "eigentrail/model/model.hpp"

namespace eigentrail::test {

/// Three chains of `points` masses each, joined by rods, in the plane z = 0 of a frame that turns with omega
/// from 1 to 10 rad/s. They are hinged at radius 0.1 m, 120 degrees apart, of different lengths, and point
/// outwards; forces and drag on their tips bend them. Three freedoms for every three points.
std::string rotating_chains(int points);

/// A model that returns the linearizations of another model as dense or as sparse matrices.
class OtherKind final : public Model {
 public:
  enum class Kind { dense, sparse };

  /// `model` is referred to, not copied.
  OtherKind(const Model& model, Kind kind) : Model(model.description()), model_(model), kind_(kind) {}

  Vector initial_guess(const Vector& parameters) const override { return model_.initial_guess(parameters); }
  Structure structure(int traced_parameter) const override { return model_.structure(traced_parameter); }
  EvaluationFault residual(const Path& path, int order, SteadyResidual& result,
                           EvaluationCounts& counts) const override {
    return model_.residual(path, order, result, counts);
  }
  EvaluationFault linearize(const Path& path, int order, Linearization& result,
                            EvaluationCounts& counts) const override;

 private:
  const Model& model_;
  Kind kind_;
};

}  // namespace eigentrail::test
