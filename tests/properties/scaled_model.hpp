// The same system measured in other units of time, mass and length.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "eigentrail/continuation/path_node.hpp"
#include "eigentrail/model/model.hpp"

namespace eigentrail::test {

/// How many new units one old unit has: numbers of masses become `mass` times as large, and eigenvalues 1 /
/// `time`.
struct Units {
  std::string name;
  double time = 1.0, mass = 1.0;
  double length = 1.0;         ///< of coordinates
  bool beside_angles = false;  ///< only every second coordinate is a length
};

void PrintTo(const Units& units, std::ostream* out);

/// Every unit by 10^+-6, lengths also beside angles.
std::vector<Units> other_units();

/// All that a trace has factored: for its modes, its certificate and its events.
double factorizations(const RunCounts& counts);

/// A model in other units: with x = L y, M' = m L M L, C' = m L C L / t, K' = m L K L / t^2, A' = A L. The
/// equations keep their parameters. Keeps a reference to the model.
class ScaledModel : public Model {
 public:
  ScaledModel(const Model& model, const Units& units);

  Vector initial_guess(const Vector& parameters) const override;
  Structure structure(int traced) const override { return model_.structure(traced); }
  EvaluationFault residual(const Path& path, int order, SteadyResidual& result,
                           EvaluationCounts& counts) const override;
  EvaluationFault linearize(const Path& path, int order, Linearization& result,
                            EvaluationCounts& counts) const override;
  CoefficientMatrices coefficient_matrices(const Vector& parameters, int traced) const override;
  std::vector<Expression> expressions() const override { return model_.expressions(); }
  std::vector<double> kinks(int traced) const override { return model_.kinks(traced); }

 private:
  Path in_old_units(const Path& path) const;
  Matrix scaled(const Matrix& A, double factor) const;

  const Model& model_;
  Vector lengths_;                              ///< old units in a new one, per coordinate
  double of_mass_, of_damping_, of_stiffness_;  ///< m, m / t, m / t^2 in the new units
};

}  // namespace eigentrail::test
