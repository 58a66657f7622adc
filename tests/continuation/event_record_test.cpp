// The sensitivities that are kept with an event.
#include "continuation/events/event_record.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/planted_points.hpp"

namespace eigentrail::test::event_record_test {
namespace {

/// A mass m on a spring k: s^2 = -k / m. The stiffness is also there under another name.
struct MassOnSpring {
  explicit MassOnSpring(Chart chart)
      : setting(
            make_setting("[parameters]\nk = 8.0\nm = 2.0\nstiffness = \"k\"\n[trace]\nparameter = \"k\"\n"
                         "from = 5\nto = 10\n[[point]]\nname = \"a\"\nmass = \"m\"\nposition = [0, 0, 0]\n"
                         "[[fixed]]\npoint = \"a\"\ncoordinate = \"x\"\n[[fixed]]\npoint = \"a\"\n"
                         "coordinate = \"y\"\n[[guided_spring]]\npoint = \"a\"\ndirection = [0, 0, 1]\n"
                         "stiffness = \"stiffness\"\n")),
        problem(setting.problem()),
        point(point_from_guess(problem, 8.0, counts)) {
    InvariantPair start = point.pairs.at(0);
    start.chart = chart;
    start.Lambda(0, 0) = chart_value(start.Lambda(0, 0), chart);
    point.pairs = {correct_pair(PencilAtPoint(point.pencil, chart), start, problem.reference(chart),
                                problem.corrector, counts.modes)};
    node = differentiate_point(problem, point, counts).value();
  }
  Setting setting;
  PathProblem problem;
  RunCounts counts;
  PathPoint point;
  PathNode node;
};

/// ds/dk = j / (2 sqrt(k m)) and ds/dm = -j sqrt(k / m) / (2 m). A frequency stays the same with dk/dm = k /
/// m.
TEST(KeepSensitivities, AreThoseOfTheClosedFormInEitherChart) {
  for (const Chart chart : {Chart::finite, Chart::reciprocal}) {
    MassOnSpring at(chart);
    const Track& track = at.node.tracks[0];
    const auto moves = [&](const Track& along_path, const PathNode&, const Track& along_q) {
      const std::vector<Complex> root{track.roots[0]};
      return -(mean_slope(along_q, root) / mean_slope(along_path, root)).real();
    };
    Event event;
    keep_sensitivities(at.problem, solved_point(at.problem, at.node, at.counts), at.node, track, {0}, moves,
                       event, at.counts);
    const int k = at.setting.parameter("k"), m = at.setting.parameter("m");
    EXPECT_LT(std::abs(event.sensitivity[k] - 0.125 * j), 1e-12);
    EXPECT_LT(std::abs(event.sensitivity[m] + 0.5 * j), 1e-12);
    EXPECT_NEAR(event.shift[m], 4.0, 1e-11);
    EXPECT_TRUE(std::isnan(event.shift[k])) << "it is the parameter of the trace";
    const int defined = at.setting.parameter("stiffness");
    EXPECT_TRUE(std::isnan(event.sensitivity[defined].real()) && std::isnan(event.shift[defined]));
  }
}

}  // namespace
}  // namespace eigentrail::test::event_record_test
