// What a tighter tolerance costs, and what the order of the series saves.
#include "bench/benchmarks.hpp"
#include "bench/families.hpp"
#include "bench/text.hpp"
#include "bench/timed_trace.hpp"
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

TimedTrace timed(const Setting& setting, double tolerance, int order, const BenchOptions& options) {
  TraceOptions trace_options = setting.options;
  trace_options.tolerance = tolerance;
  trace_options.order = order;
  return time_trace(setting, trace_options, options.repeats);
}

std::string text_of(const TimedTrace& trace) {
  return time_text(trace.seconds) + " on " + std::to_string(trace.result.nodes) + " points";
}

}  // namespace

Figures tolerance(const BenchOptions& options) {
  Figures figures;
  for (const auto& [name, setting] : settings(options)) {
    const TimedTrace tight = timed(setting, 1e-10, 3, options);
    const TimedTrace loose = timed(setting, 1e-6, 3, options);
    figures.push_back({"time at tolerance 1e-10 / 1e-6, " + name, tight.seconds / loose.seconds, at_most(4.0),
                       text_of(tight) + " / " + text_of(loose)});
  }
  return figures;
}

Figures order(const BenchOptions& options) {
  Figures figures;
  const double tolerance = options.smoke ? 1e-6 : 1e-10;
  for (const auto& [name, setting] : settings(options)) {
    const TimedTrace third = timed(setting, tolerance, 3, options);
    BenchOptions once = options;
    once.repeats = 1;  // long
    const TimedTrace first = timed(setting, tolerance, 1, once);
    figures.push_back({"time of order 1 / order 3 at tolerance " + short_text(tolerance) + ", " + name,
                       first.seconds / third.seconds, at_least(2.5),
                       text_of(first) + " / " + text_of(third)});
  }
  return figures;
}

}  // namespace eigentrail::test
