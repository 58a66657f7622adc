// Multibody models with many coordinates and few freedoms: time with sparse and with dense matrices.
#include <memory>

#include "bench/benchmarks.hpp"
#include "bench/text.hpp"
#include "bench/timed_trace.hpp"
#include "bench/timing.hpp"
#include "support/chains.hpp"

namespace eigentrail::test {
namespace {

TraceOptions ten_modes_of(const Setting& setting) {
  TraceOptions options = setting.options;
  options.tolerance = 1e-6;
  options.modes.count = 10;
  return options;
}

std::string account(const TraceResult& result) {
  const RunCounts& c = result.counts;
  const auto share = [&](double seconds) { return percent(seconds, result.seconds); };
  return std::to_string(result.nodes) + " points, " + std::to_string(result.rejections.total()) +
         " tried again; equilibrium " + share(c.equilibrium_seconds) + ", reduction " +
         share(c.reduction_seconds) + ", modes " + share(c.modes_seconds) + ", series " +
         share(c.differentiation_seconds) + ", certificate " + share(c.certificate_seconds) + " of the run";
}

/// Times both kinds of matrices on ten modes.
void compare_kinds(const Setting& setting, const std::string& what, const BenchOptions& options,
                   Figures& figures) {
  const TraceOptions traced = ten_modes_of(setting);
  Setting dense;
  dense.model = std::make_unique<OtherKind>(*setting.model, OtherKind::Kind::dense);
  TimedTrace by_sparse, by_dense;
  Rounds rounds;
  for (int i = 0; i < options.repeats; ++i) {
    by_sparse = time_trace(setting, traced);
    by_dense = time_trace(dense, traced);
    rounds.add({by_dense.seconds, by_sparse.seconds});
  }
  const RunCounts& counts = by_sparse.result.counts;
  const std::string size = ", " + what + ", 10 modes";
  figures.push_back({"dense / sparse matrices, time of a trace" + size,
                     rounds.ratio(0, 1),
                     {},
                     time_text(rounds.seconds(0)) + ", " + account(by_dense.result) + " / " +
                         time_text(rounds.seconds(1)) + ", " + account(by_sparse.result)});
  figures.push_back({"share of equilibrium and reduction" + size,
                     (counts.equilibrium_seconds + counts.reduction_seconds) / by_sparse.result.seconds,
                     at_most(0.5)});
}

}  // namespace

Figures chains(const BenchOptions& options) {
  Figures figures;
  for (const int points : options.smoke ? std::vector<int>{12} : std::vector<int>{12, 20, 40, 55}) {
    compare_kinds(make_setting(rotating_chains(points)),
                  std::to_string(9 * points) + " coordinates, " + std::to_string(3 * points) + " freedoms",
                  options, figures);
  }
  return figures;
}

Figures blades(const BenchOptions& options) {
  Figures figures;
  compare_kinds({prepare_trace(read_scene(EIGENTRAIL_THREE_BLADES), {})},
                "40 bodies, 480 coordinates, 78 freedoms", options, figures);
  return figures;
}

}  // namespace eigentrail::test
