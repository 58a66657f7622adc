// Time ratios to a grid of spectra at the same achieved error.
#include "bench/benchmarks.hpp"
#include "bench/families.hpp"
#include "bench/grid_rival.hpp"
#include "bench/text.hpp"
#include "hard_cases/catalogue.hpp"

namespace eigentrail::test {
namespace {

constexpr unsigned seed = 7;

/// A trace and the grid that does as well.
struct Contest {
  Recording exact;
  TimedTrace ours;
  double error = 0.0;  ///< achieved by both
  int points = 0;      ///< of the grid

  std::string our_text() const {
    return "error " + short_text(error) + "; ours " + time_text(ours.seconds) + " on " +
           std::to_string(ours.result.nodes) + " points";
  }
};

Contest contest(const Setting& setting, const TraceOptions& traced, const BenchOptions& options) {
  Contest result;
  result.exact = reference_of(setting, traced);
  result.ours = time_trace(setting, traced, options.repeats);
  const std::vector<double> tests = parameters_on(traced, options.smoke ? 101 : 2003, 0.382);
  const Recording recorded = record(setting, traced);
  result.error =
      largest_error(sample(recorded.path, tests), sample(result.exact.path, tests), result.exact.s_ref);
  result.points = points_for_spline(result.exact, traced, tests, result.error);
  return result;
}

std::string rival_text(const RivalTime& rival, int points) {
  std::string text = time_text(rival.seconds) + " on " + std::to_string(points) + " points";
  if (rival.measured < points) text += " (" + std::to_string(rival.measured) + " measured)";
  return text;
}

Figures against_grid(const std::string& name, const Setting& setting, const TraceOptions& traced,
                     const Contest& contest, double target, int most, const BenchOptions& options) {
  const RivalTime grid = time_grid(setting, traced, contest.points, most);
  const double saved = contest.points * saved_by_qr(setting, traced.from, options.repeats);
  return {{"QZ grid, matching, spline / ours, " + name, grid.seconds / contest.ours.seconds, at_least(target),
           contest.our_text() + "; grid " + rival_text(grid, contest.points)},
          {"the same with QR in place of QZ",
           (grid.seconds - saved) / contest.ours.seconds,
           {},
           "needs a regular mass"}};
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
  traced.modes = modes;
  const Contest fought = contest(setting, traced, options);
  const std::string name = "n = " + std::to_string(n) + ", " + std::to_string(modes) + " modes";
  Figures figures = against_grid(name, setting, traced, fought, 20.0, options.smoke ? 8 : 4, options);
  const ArnoldiTime arnoldi =
      time_arnoldi(setting, traced, fought.exact, 0.1 * traced.tolerance, fought.points, 50);
  figures.push_back({"shift-invert Arnoldi grid, spline / ours, " + name,
                     arnoldi.seconds / fought.ours.seconds, at_least(20.0),
                     std::to_string(arnoldi.steps) + " solves and one LU per point, no labels; " +
                         rival_text(arnoldi, fought.points)});
  return figures;
}

}  // namespace eigentrail::test
