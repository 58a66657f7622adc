#include "properties/scaled_model.hpp"

#include <ostream>

namespace eigentrail::test {

void PrintTo(const Units& units, std::ostream* out) {
  *out << units.name;
}

std::vector<Units> other_units() {
  std::vector<Units> units;
  const auto add = [&](const std::string& name, double time, double mass, double length, bool beside) {
    units.push_back({name, time, mass, length, beside});
  };
  for (const bool large : {true, false}) {
    const double factor = large ? 1e6 : 1e-6;
    const std::string size = large ? "large_" : "small_";
    add(size + "times", factor, 1.0, 1.0, false);
    add(size + "masses", 1.0, factor, 1.0, false);
    add(size + "lengths", 1.0, 1.0, factor, false);
    add(size + "lengths_beside_angles", 1.0, 1.0, factor, true);
  }
  return units;
}

double factorizations(const RunCounts& counts) {
  return static_cast<double>(counts.modes.factorizations + counts.modes.modal_bases +
                             counts.certificate_factorizations + counts.certificate_bases +
                             counts.event_factorizations);
}

ScaledModel::ScaledModel(const Model& model, const Units& units)
    : Model(model.description()),
      model_(model),
      lengths_(Vector::Constant(model.n_coordinates(), 1.0 / units.length)),
      of_mass_(units.mass),
      of_damping_(units.mass / units.time),
      of_stiffness_(units.mass / (units.time * units.time)) {
  if (!units.beside_angles) return;
  for (Eigen::Index i = 0; i < lengths_.size(); i += 2) lengths_[i] = 1.0;
}

Path ScaledModel::in_old_units(const Path& path) const {
  return {path.parameters, lengths_.asDiagonal() * path.x, path.lambda / of_stiffness_};
}

Matrix ScaledModel::scaled(const Matrix& A, double factor) const {
  return factor * lengths_.asDiagonal() * A * lengths_.asDiagonal();
}

Vector ScaledModel::initial_guess(const Vector& parameters) const {
  return lengths_.cwiseInverse().asDiagonal() * model_.initial_guess(parameters);
}

EvaluationFault ScaledModel::residual(const Path& path, int order, SteadyResidual& result,
                                      EvaluationCounts& counts) const {
  auto fault = model_.residual(in_old_units(path), order, result, counts);
  result.force = (of_stiffness_ * lengths_.asDiagonal() * result.force).eval();
  return fault;
}

EvaluationFault ScaledModel::linearize(const Path& path, int order, Linearization& result,
                                       EvaluationCounts& counts) const {
  auto fault = model_.linearize(in_old_units(path), order, result, counts);
  for (SystemMatrix& M : result.M) M = scaled(M.dense(), of_mass_);
  for (SystemMatrix& C : result.C) C = scaled(C.dense(), of_damping_);
  for (SystemMatrix& K : result.K) K = scaled(K.dense(), of_stiffness_);
  for (SystemMatrix& A : result.A) A = Matrix(A.dense() * lengths_.asDiagonal());
  return fault;
}

CoefficientMatrices ScaledModel::coefficient_matrices(const Vector& parameters, int traced) const {
  CoefficientMatrices coefficients = model_.coefficient_matrices(parameters, traced);
  for (Matrix& M : coefficients.M) M = scaled(M, of_mass_);
  for (Matrix& C : coefficients.C) C = scaled(C, of_damping_);
  for (Matrix& K : coefficients.K) K = scaled(K, of_stiffness_);
  return coefficients;
}

}  // namespace eigentrail::test
