// Time of a trace with the order that it chooses, compared with the fastest order.
#include <algorithm>
#include <cmath>

#include "bench/benchmarks.hpp"
#include "bench/families.hpp"
#include "bench/text.hpp"
#include "bench/timed_trace.hpp"
#include "bench/timing.hpp"

namespace eigentrail::test {
namespace {

struct NamedFamily {
  std::string name;
  Setting setting;
};

Setting few_of(int n, const std::string& modes) {
  return gyroscopic_family(n, 7, {{"modes", modes}});
}

std::vector<NamedFamily> settings(bool smoke) {
  std::vector<NamedFamily> list;
  list.push_back({"pendulum", scene_setting("pendulum")});
  if (smoke) return list;
  for (const char* name : {"rotating_mass", "spring_pendulum", "ziegler_column"})
    list.push_back({name, scene_setting(name)});
  list.push_back({"chain of 4", hanging_chain()});
  list.push_back({"n = 6, all modes", few_of(6, "all")});
  list.push_back({"n = 20, all modes", few_of(20, "all")});
  list.push_back({"n = 50, 6 modes", few_of(50, "6")});
  return list;
}

/// Time of a trace; infinite where it would have far too many points or ends early.
double seconds_of_order(const Setting& setting, TraceOptions options, int order) {
  // Never the fastest there, and thousands of points.
  if (std::pow(options.tolerance, -1.0 / (2.0 * order + 2.0)) > 150.0) return INFINITY;
  options.order = order;
  try {
    return time_trace(setting, options).seconds;
  } catch (const std::runtime_error&) {
    return INFINITY;
  }
}

/// Times of the orders from 1 to 4.
std::vector<double> times_of_orders(const Setting& setting, const TraceOptions& options, int repeats,
                                    std::string& text) {
  Rounds rounds;
  for (int i = 0; i < repeats; ++i) {
    std::vector<double> round;
    for (int order = 1; order <= 4; ++order) round.push_back(seconds_of_order(setting, options, order));
    rounds.add(round);
  }
  std::vector<double> times;
  for (std::size_t i = 0; i < 4; ++i) {
    times.push_back(rounds.seconds(i));
    text += (i > 0 ? ", " : "") + (std::isfinite(times[i]) ? time_text(times[i]) : "–");
  }
  return times;
}

}  // namespace

Figures order_choice(const BenchOptions& options) {
  Figures figures;
  for (const auto& [name, setting] : settings(options.smoke)) {
    for (int digits = 2; digits <= (options.smoke ? 4 : 12); digits += 2) {
      TraceOptions trace_options = setting.options;
      trace_options.tolerance = std::pow(10.0, -digits);
      std::string text;
      const std::vector<double> times = times_of_orders(setting, trace_options, options.repeats, text);
      trace_options.order.reset();
      const int chosen = trace(*setting.model, trace_options, {}).order;
      figures.push_back(
          {"time of the order chosen / of the best, " + name + ", tolerance 1e-" + std::to_string(digits),
           times[static_cast<std::size_t>(chosen - 1)] / *std::min_element(times.begin(), times.end()),
           at_most(1.2), "order " + std::to_string(chosen) + "; " + text});
    }
  }
  return figures;
}

}  // namespace eigentrail::test
