// Prints what locating special points costs on the hard cases, and what bisection with a spectrum per
// evaluation would have cost (docs/developers/special-points.md).
//
//     event_cost
//
// Exit code 0.
#include <Eigen/LU>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>

#include "eigentrail/modes/spectrum.hpp"
#include "hard_cases/run_case.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test {
namespace {

struct Cost {
  double trace = 0.0, events = 0.0;  ///< LU
  int located = 0, most_retrackings = 0;

  void add(const TraceResult& result) {
    trace +=
        static_cast<double>(result.counts.modes.factorizations + result.counts.certificate_factorizations);
    events += static_cast<double>(result.counts.event_factorizations);
    located += static_cast<int>(result.events.size());
    for (const Event& event : result.events) {
      if (event.kind != EventKind::veering) most_retrackings = std::max(most_retrackings, event.retrackings);
    }
  }
};

double seconds(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  constexpr int repetitions = 20;
  for (int i = 0; i < repetitions; ++i) work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() / repetitions;
}

/// How many LU of the size of the pencil, plus one, take as long as its spectrum.
double lu_per_spectrum(const PathPoint& point) {
  const ReducedPencil& pencil = point.pencil;
  const ComplexMatrix matrix = ComplexMatrix::Random(pencil.size() + 1, pencil.size() + 1);
  double sink = 0.0;
  const double lu =
      seconds([&] { sink += std::abs(Eigen::PartialPivLU<ComplexMatrix>(matrix).matrixLU()(0, 0)); });
  const double spectrum = seconds([&] {
    sink += static_cast<double>(compute_spectrum(pencil.M[0], pencil.C[0], pencil.K[0]).modes.size());
  });
  return sink > 0.0 ? spectrum / lu : 0.0;
}

int growing(const PathPoint& point) {
  int count = 0;
  for (const StartingMode& mode :
       compute_spectrum(point.pencil.M[0], point.pencil.C[0], point.pencil.K[0]).modes)
    count += mode.s.real() > 0.0;
  return count;
}

/// Spectra until the number of growing modes has changed within `width`, from a bracket of length `step`.
int bisect(const PathProblem& problem, double p, double step, double width) {
  RunCounts counts;
  double a = p - 0.4 * step;
  double b = p + 0.6 * step;
  const int at_a = growing(point_from_guess(problem, a, counts));
  int spectra = 2;
  for (; b - a > width; ++spectra) {
    const double middle = 0.5 * (a + b);
    (growing(point_from_guess(problem, middle, counts)) == at_a ? a : b) = middle;
  }
  return spectra;
}

void print_shares() {
  std::printf("| tolerance | LU of the traces | for events | share | events | most re-trackings |\n");
  std::printf("|---|---|---|---|---|---|\n");
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
    Cost cost;
    for (const HardCase& hard_case : hard_cases()) {
      for (const bool reversed : {false, true})
        cost.add(trace_case(hard_case, {tolerance, reversed, 0.0}).result);
    }
    std::printf("| %.0e | %.0f | %.0f | %.1f %% | %d | %d |\n", tolerance, cost.trace, cost.events,
                100.0 * cost.events / cost.trace, cost.located, cost.most_retrackings);
  }
}

/// Points where the number of growing modes changes, one by one, at tolerance 1e-8.
void print_bisection() {
  constexpr double accuracy = 1e-9;  // of the parameter
  std::printf(
      "\n| case | events | spectra by bisection | our LU, at most | LU per spectrum (time) | factor |\n");
  constexpr int most_per_retracking = 3;  // a block of two, and the mode by itself
  std::printf("|---|---|---|---|---|---|\n");
  double least = INFINITY;
  for (const HardCase& hard_case : hard_cases()) {
    const RecordedTrace traced = trace_case(hard_case, {1e-8, false, 0.0});
    const Setting setting = make_setting(hard_case.scene);
    int spectra = 0;
    int events = 0;
    int ours = 0;
    for (const Event& event : traced.result.events) {
      if (event.kind != EventKind::flutter && event.kind != EventKind::divergence) continue;
      const auto node = static_cast<std::size_t>(event.node);
      if (node == 0 || node >= traced.nodes.size() || event.direction == 0) continue;
      const double step = std::abs(traced.nodes[node].p - traced.nodes[node - 1].p);
      spectra += bisect(setting.problem(), event.p, step, accuracy * std::max(1.0, std::abs(event.p)));
      ours += most_per_retracking * event.retrackings;
      ++events;
    }
    if (events == 0) continue;
    RunCounts counts;
    const double per_spectrum = lu_per_spectrum(point_from_guess(setting.problem(), hard_case.from, counts));
    const double factor = spectra * per_spectrum / ours;
    least = std::min(least, factor);
    std::printf("| %s | %d | %d | %d | %.0f | %.0f |\n", hard_case.name.c_str(), events, spectra, ours,
                per_spectrum, factor);
  }
  std::printf("\nleast factor %.0f\n", least);
}

}  // namespace
}  // namespace eigentrail::test

int main() {
  eigentrail::test::print_shares();
  eigentrail::test::print_bisection();
  return 0;
}
