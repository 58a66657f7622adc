// Traces the hard cases in other units and prints where points, factorizations or events change.
//
//     unit_sweep [--tolerance T] [--case NAME]
//
// A line per case and units in which points or LU differ by more than a fifth, or the events; all lines with
// --case. Exit code 1 if there is one. Scenes with constraints have coordinates of one unit and are not
// traced with lengths beside angles.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>

#include "hard_cases/catalogue.hpp"
#include "properties/scaled_model.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test {
namespace {

TraceResult traced(const HardCase& hard_case, const std::string& tolerance, const Units* units) {
  Setting setting = make_setting(hard_case.scene, {{"tolerance", tolerance}, {"max_nodes", "2000"}});
  if (units == nullptr) return record_trace(setting).result;
  const std::unique_ptr<Model> own = std::move(setting.model);
  setting.model = std::make_unique<ScaledModel>(*own, *units);
  return record_trace(setting).result;
}

bool changes(double own, double other) {
  constexpr double most = 0.2;
  return std::abs(other - own) > most * own;
}

int run(int argc, char** argv) {
  std::string tolerance = "1e-6", only;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::strcmp(argv[i], "--tolerance") == 0) tolerance = argv[i + 1];
    if (std::strcmp(argv[i], "--case") == 0) only = argv[i + 1];
  }
  int runs = 0;
  int changed = 0;
  std::printf(
      "| case | units | points | LU of modes | of the certificate | of events | events "
      "|\n|---|---|---|---|---|---|---|\n");
  for (const HardCase& hard_case : hard_cases()) {
    if (!only.empty() && hard_case.name != only) continue;
    const TraceResult own = traced(hard_case, tolerance, nullptr);
    const bool has_constraints = make_setting(hard_case.scene).model->n_constraints() > 0;
    for (const Units& units : other_units()) {
      if (units.beside_angles && has_constraints && only.empty()) continue;
      const TraceResult other = traced(hard_case, tolerance, &units);
      const bool differs = other.status != own.status || changes(own.nodes, other.nodes) ||
                           changes(factorizations(own.counts), factorizations(other.counts)) ||
                           own.events.size() != other.events.size();
      ++runs;
      changed += differs;
      if (!differs && only.empty()) continue;
      const auto pair = [](auto a, auto b) { return std::to_string(a) + " → " + std::to_string(b); };
      std::printf(
          "| %s | %s | %s | %s | %s | %s | %s | %s\n", hard_case.name.c_str(), units.name.c_str(),
          pair(own.nodes, other.nodes).c_str(),
          pair(own.counts.modes.factorizations, other.counts.modes.factorizations).c_str(),
          pair(own.counts.certificate_factorizations, other.counts.certificate_factorizations).c_str(),
          pair(own.counts.event_factorizations, other.counts.event_factorizations).c_str(),
          pair(own.events.size(), other.events.size()).c_str(), other.message.c_str());
      std::fflush(stdout);
    }
  }
  std::printf("\n%d runs, %d changed\n", runs, changed);
  return changed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace eigentrail::test

int main(int argc, char** argv) {
  return eigentrail::test::run(argc, argv);
}
