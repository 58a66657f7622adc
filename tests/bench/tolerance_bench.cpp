// Cost of a tighter tolerance, and saving by a higher order of the series.
#include <array>

#include "bench/benchmarks.hpp"
#include "bench/families.hpp"
#include "bench/text.hpp"
#include "bench/timed_trace.hpp"
#include "bench/timing.hpp"
#include "hard_cases/catalogue.hpp"

namespace eigentrail::test {
namespace {

struct Named {
  std::string name;
  Setting setting;
};

std::vector<Named> settings(const BenchOptions& options) {
  std::vector<Named> list;
  list.push_back({"rotating mass", make_setting(hard_case("C01_rotating_mass").scene)});
  const int n = options.smoke ? 6 : 20;
  list.push_back({"gyroscopic n = " + std::to_string(n), gyroscopic_family(n, 7, {})});
  return list;
}

/// One way to trace a scene.
struct Way {
  double tolerance = 0.0;
  int order = 3;
};

/// The time of one way / that of another.
Figure compare(const std::string& quantity, const Setting& setting, const std::array<Way, 2>& ways,
               Target target, const BenchOptions& options) {
  Rounds rounds;
  std::array<int, 2> points{};
  for (int i = 0; i < options.repeats; ++i) {
    std::vector<double> seconds;
    for (std::size_t w = 0; w < ways.size(); ++w) {
      TraceOptions trace_options = setting.options;
      trace_options.tolerance = ways[w].tolerance;
      trace_options.order = ways[w].order;
      const TimedTrace timed = time_trace(setting, trace_options);
      seconds.push_back(timed.seconds);
      points[w] = timed.result.nodes;
    }
    rounds.add(seconds);
  }
  const auto text = [&](std::size_t w) {
    return time_text(rounds.seconds(w)) + " on " + std::to_string(points[w]) + " points";
  };
  return {quantity, rounds.ratio(0, 1), target, text(0) + " / " + text(1)};
}

}  // namespace

Figures tolerance(const BenchOptions& options) {
  Figures figures;
  for (const auto& [name, setting] : settings(options)) {
    figures.push_back(compare("time at tolerance 1e-10 / 1e-6, " + name, setting, {{{1e-10}, {1e-6}}},
                              at_most(4.0), options));
  }
  return figures;
}

Figures order(const BenchOptions& options) {
  Figures figures;
  const double tolerance = options.smoke ? 1e-6 : 1e-10;
  for (const auto& [name, setting] : settings(options)) {
    figures.push_back(compare("time of order 1 / order 3 at tolerance " + short_text(tolerance) + ", " + name,
                              setting, {{{tolerance, 1}, {tolerance, 3}}}, at_least(2.5), options));
  }
  return figures;
}

}  // namespace eigentrail::test
