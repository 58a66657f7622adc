// Time per mode and step against one complex LU of the same size, and how it grows.
#include <cmath>
#include <vector>

#include "bench/benchmarks.hpp"
#include "bench/families.hpp"
#include "bench/text.hpp"
#include "bench/timed_trace.hpp"
#include "bench/timing.hpp"
#include "eigentrail/core/complex_lu.hpp"

namespace eigentrail::test {
namespace {

constexpr unsigned seed = 7;

TraceOptions few_modes_of(const Setting& setting, int modes, bool certify) {
  TraceOptions options = setting.options;
  options.tolerance = 1e-6;
  options.modes.count = modes;
  options.certify = certify;
  return options;
}

/// Time of one complex LU.
double lu_seconds(int n) {
  const ComplexMatrix matrix = ComplexMatrix::Random(n, n);
  const int inner = std::max(1, 20'000'000 / (n * n * n));
  Eigen::Index sink = 0;
  const double seconds = median_seconds(3, [&] {
    for (int i = 0; i < inner; ++i) sink += ComplexLu(matrix).size();
  });
  return sink > 0 ? seconds / inner : 0.0;
}

/// Shares of the stages in the time of a run.
std::string stages(const TimedTrace& timed) {
  const RunCounts& c = timed.result.counts;
  const double all = timed.result.seconds;
  return "modes " + percent(c.modes_seconds, all) + ", series " + percent(c.differentiation_seconds, all) +
         ", certificate " + percent(c.certificate_seconds, all) + ", events " +
         percent(c.events_seconds, all) + ", completeness " + percent(c.matching_seconds, all) +
         " of the run";
}

std::string account(const TimedTrace& timed, double seconds) {
  return time_text(seconds) + " on " + std::to_string(timed.result.nodes) + " points, " +
         std::to_string(timed.result.rejections.total()) + " tried again; " + stages(timed);
}

/// `spacing` as in families.hpp.
void add_step_figures(int n, double spacing, bool certify, std::optional<Target> target,
                      const BenchOptions& options, Figures& figures) {
  constexpr int modes = 6;
  const Setting setting = gyroscopic_family(n, seed, {}, spacing);
  TimedTrace timed;
  Rounds rounds;
  enum Work : std::size_t { mode_step, lu };
  for (int i = 0; i < options.repeats; ++i) {
    timed = time_trace(setting, few_modes_of(setting, modes, certify));
    rounds.add({timed.seconds_per_mode_step(), lu_seconds(n)});
  }
  const std::string what = " per mode and step / complex LU, n = " + std::to_string(n) + ", certificate " +
                           (certify ? "on" : "off") + (spacing == apart ? ", modes apart" : "");
  const auto steps = static_cast<double>(std::max(1L, timed.result.mode_steps));
  const auto per_step = [&](std::uint64_t count) { return short_text(static_cast<double>(count) / steps); };
  const RunCounts& counts = timed.result.counts;
  figures.push_back({"time" + what, rounds.ratio(mode_step, lu), target,
                     std::to_string(timed.result.nodes - 1) + " steps of " + std::to_string(modes) +
                         " modes, " + std::to_string(timed.result.rejections.total()) + " tried again; " +
                         per_step(counts.modes.factorizations) + " LU, " + per_step(counts.modes.solves) +
                         " solves, " + per_step(counts.certificate_factorizations) +
                         " LU of the certificate; LU " + time_text(rounds.seconds(lu)) + "; " +
                         stages(timed)});
}

struct Growth {
  std::vector<double> x, seconds;
  std::string text;

  void measure(double at, const Setting& setting, const TraceOptions& traced, int repeats) {
    std::vector<double> times;
    for (int i = 0; i < repeats; ++i) times.push_back(time_trace(setting, traced).seconds);
    x.push_back(at);
    seconds.push_back(median(times));
    text += (text.empty() ? "" : ", ") + short_text(at) + ": " + time_text(seconds.back());
  }
};

}  // namespace

Figures step_time(const BenchOptions& options) {
  Figures figures;
  const std::vector<int> sizes = options.smoke ? std::vector<int>{10, 20} : std::vector<int>{50, 200};
  const auto target_of = [](int n) { return at_most(n <= 50 ? 2.5 : 1.6); };
  for (const int n : sizes) add_step_figures(n, close, false, target_of(n), options, figures);
  for (const int n : sizes) add_step_figures(n, close, true, {}, options, figures);
  for (const int n : sizes) add_step_figures(n, apart, false, {}, options, figures);
  return figures;
}

Figures growth(const BenchOptions& options) {
  Growth with_size, with_modes;
  for (const int n : options.smoke ? std::vector<int>{8, 16} : std::vector<int>{25, 50, 100, 200}) {
    const Setting setting = gyroscopic_family(n, seed, {});
    with_size.measure(n, setting, few_modes_of(setting, 6, true), options.repeats);
  }
  const int n_fixed = options.smoke ? 8 : 50;
  const Setting setting = gyroscopic_family(n_fixed, seed, {});
  for (const int modes : options.smoke ? std::vector<int>{2, 4} : std::vector<int>{3, 6, 12, 25, 50})
    with_modes.measure(modes, setting, few_modes_of(setting, modes, true), options.repeats);
  return {{"exponent of time in n, 6 modes", exponent(with_size.x, with_size.seconds), {}, with_size.text},
          {"exponent of time in the number of modes, n = 50",
           exponent(with_modes.x, with_modes.seconds),
           {},
           with_modes.text}};
}

Figures symmetric(const BenchOptions& options) {
  const int n = options.smoke ? 8 : 100;
  const Setting undamped = undamped_family(n, seed, {});
  const Setting general = gyroscopic_family(n, seed, {});
  const auto time = [&](const Setting& setting) {
    TraceOptions all = setting.options;
    all.tolerance = 1e-6;
    all.certify = false;
    return time_trace(setting, all);
  };
  enum Work : std::size_t { damped_step, undamped_step, damped_run, undamped_run };
  TimedTrace symmetric, damped;
  Rounds rounds;
  for (int i = 0; i < options.repeats; ++i) {
    symmetric = time(undamped);
    damped = time(general);
    rounds.add({damped.seconds_per_mode_step(), symmetric.seconds_per_mode_step(), damped.seconds,
                symmetric.seconds});
  }
  return {{"damped gyroscopic / undamped symmetric, all modes, n = " + std::to_string(n) +
               ", time per mode and step without certificate",
           rounds.ratio(damped_step, undamped_step), at_least(4.0),
           "undamped " + account(symmetric, rounds.seconds(undamped_run)) + "; general " +
               account(damped, rounds.seconds(damped_run))}};
}

Figures threads(const BenchOptions& options) {
  const int n = options.smoke ? 40 : 100;
  const int modes = options.smoke ? 16 : 40;
  const Setting setting = gyroscopic_family(n, seed, {});
  TraceOptions with = few_modes_of(setting, modes, true);
  TimedTrace timed;
  Rounds rounds;  // on the wall
  for (int i = 0; i < options.repeats; ++i) {
    std::vector<double> seconds;
    for (const int count : {1, 2}) {
      with.threads = count;
      timed = time_trace(setting, with);
      seconds.push_back(timed.result.seconds);
    }
    rounds.add(seconds);
  }
  return {{"speed-up by a second thread, " + std::to_string(modes) + " modes of n = " + std::to_string(n),
           rounds.ratio(0, 1), at_least(1.6),
           time_text(rounds.seconds(0)) + " / " + time_text(rounds.seconds(1)) + " on the wall, " +
               std::to_string(timed.result.nodes) + " points"}};
}

}  // namespace eigentrail::test
