// Time of spectra on a grid divided by the time of a trace with the same achieved error.
#include "bench/benchmarks.hpp"
#include "bench/families.hpp"
#include "bench/grid_rival.hpp"
#include "bench/text.hpp"
#include "bench/timed_trace.hpp"
#include "bench/timing.hpp"
#include "hard_cases/catalogue.hpp"

namespace eigentrail::test {
namespace {

constexpr unsigned seed = 7;

/// A trace, and the number of points of a grid with the same error.
struct Contest {
  Recording exact;
  double error = 0.0;  ///< achieved error of both
  int points = 0;      ///< number of grid points
};

Contest contest(const Setting& setting, const TraceOptions& traced, const BenchOptions& options) {
  Contest result;
  result.exact = reference_of(setting, traced);
  const std::vector<double> tests = parameters_on(traced, options.smoke ? 101 : 2003, 0.382);
  const Recording recorded = record(setting, traced);
  result.error =
      largest_error(sample(recorded.path, tests), sample(result.exact.path, tests), result.exact.s_ref);
  result.points = points_for_spline(result.exact, traced, tests, result.error);
  return result;
}

std::string rival_text(double seconds, int points, int measured) {
  std::string text = time_text(seconds) + " on " + std::to_string(points) + " points";
  if (measured < points) text += " (" + std::to_string(measured) + " measured)";
  return text;
}

Figures against_grid(const std::string& name, const Setting& setting, const TraceOptions& traced,
                     const Contest& contest, double target, int most, const BenchOptions& options) {
  TimedTrace timed;
  RivalTime grid;
  Rounds rounds;
  for (int i = 0; i < options.repeats; ++i) {
    timed = time_trace(setting, traced);
    grid = time_grid(setting, traced, contest.points, most);
    rounds.add({grid.seconds, timed.seconds});
  }
  return {{"QZ grid, matching, spline / ours, " + name, rounds.ratio(0, 1), at_least(target),
           "error " + short_text(contest.error) + "; ours " + time_text(rounds.seconds(1)) + " on " +
               std::to_string(timed.result.nodes) + " points; grid " +
               rival_text(rounds.seconds(0), contest.points, grid.measured)}};
}

Figure against_arnoldi(const std::string& name, const Setting& setting, const TraceOptions& traced,
                       const Contest& contest, double target, int most, const BenchOptions& options) {
  ArnoldiTime arnoldi;
  Rounds rounds;
  for (int i = 0; i < options.repeats; ++i) {
    const double ours = time_trace(setting, traced).seconds;
    arnoldi = time_arnoldi(setting, traced, contest.exact, 0.1 * traced.tolerance, contest.points, most);
    rounds.add({arnoldi.seconds, ours});
  }
  return {"shift-invert Arnoldi grid, spline / ours, " + name, rounds.ratio(0, 1), at_least(target),
          std::to_string(arnoldi.steps) + " solves and one LU per point, no labels; " +
              rival_text(rounds.seconds(0), contest.points, arnoldi.measured)};
}

TraceOptions traced_at(const Setting& setting, double tolerance) {
  TraceOptions options = setting.options;
  options.tolerance = tolerance;
  return options;
}

constexpr int all_points = 1'000'000;

}  // namespace

Figures rotating_mass(const BenchOptions& options) {
  const Setting setting = make_setting(hard_case("C01_rotating_mass").scene);
  const TraceOptions traced = traced_at(setting, options.smoke ? 1e-5 : 1e-8);
  return against_grid("rotating mass 100 -> 5 rad/s", setting, traced, contest(setting, traced, options),
                      15.0, all_points, options);
}

Figures veerings(const BenchOptions& options) {
  const int n = options.smoke ? 4 : 20;
  const Setting setting = gyroscopic_family(n, seed, {});
  const TraceOptions traced = traced_at(setting, options.smoke ? 1e-4 : 1e-8);
  return against_grid("n = " + std::to_string(n) + ", all modes", setting, traced,
                      contest(setting, traced, options), 8.0, all_points, options);
}

Figures few_modes(const BenchOptions& options) {
  const int n = options.smoke ? 12 : 200;
  const int modes = options.smoke ? 3 : 6;
  const Setting setting = gyroscopic_family(n, seed, {});
  TraceOptions traced = traced_at(setting, options.smoke ? 1e-4 : 1e-6);
  traced.modes.count = modes;
  const Contest fought = contest(setting, traced, options);
  const std::string name = "n = " + std::to_string(n) + ", " + std::to_string(modes) + " modes";
  Figures figures = against_grid(name, setting, traced, fought, 20.0, options.smoke ? 8 : 5, options);
  figures.push_back(against_arnoldi(name, setting, traced, fought, 20.0, 50, options));
  return figures;
}

}  // namespace eigentrail::test
