// A rotor in an oil film whose coefficients come from a function: called a few times, then traced.
#include <cmath>
#include <cstdio>

#include "eigentrail/continuation/trace.hpp"
#include "eigentrail/model/function_family.hpp"

using namespace eigentrail;

/// Stands for a program that takes minutes for every speed (rad/s). The film turns with half the speed of the
/// rotor, so its damping also pushes the rotor sideways.
MatricesAt rotor(double speed) {
  const double mass = 100.0, stiffness = 4e6;
  const double damping = 5000.0 / std::sqrt(1.0 + std::pow(speed / 150.0, 2));
  const double sideways = damping * speed / 2.0;
  MatricesAt matrices;
  matrices.M = mass * Matrix::Identity(2, 2);
  matrices.C = damping * Matrix::Identity(2, 2);
  matrices.K = Matrix(2, 2);
  matrices.K << stiffness, sideways, -sideways, stiffness;
  return matrices;
}

int main() {
  FunctionFamilyOptions family_options;
  family_options.parameter = "speed";
  family_options.unit = "rad/s";
  family_options.from = 10.0;
  family_options.to = 600.0;
  family_options.tolerance = 1e-10;  // of every entry
  family_options.state_names = {"x", "y"};
  const FunctionFamily model(rotor, family_options);
  std::printf("calls: %d, pieces: %zu\n", model.calls(), model.pieces().size());

  TraceOptions options;
  options.parameter = "speed";
  options.from = 10.0;
  options.to = 600.0;
  options.tolerance = 1e-8;
  const TraceResult result = trace(model, options, {});
  for (const Event& event : result.events) {
    if (event.kind == EventKind::flutter) std::printf("oil whirl from %.6f rad/s\n", event.p);
  }
  std::printf("%s after %d points\n",
              result.status == TraceStatus::completed ? "complete" : result.message.c_str(), result.nodes);
  return result.status == TraceStatus::completed ? 0 : 1;
}
