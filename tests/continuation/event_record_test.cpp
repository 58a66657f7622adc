// What is kept with an event: slopes, shape and sensitivities.
#include "continuation/events/event_record.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/on_path.hpp"
#include "continuation/planted_search.hpp"

namespace eigentrail::test::event_record_test {
namespace {

/// Frequencies 2 + p, 2.3 - p and 5 + 0.5 p.
struct Lines {
  Lines() : planted(Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.3, -1.0}, {5.0, 0.5}}))) {}
  PathNode node(const std::vector<Together>& tracks) { return planted.family.point(0.0, tracks); }
  PlantedSearch planted;
};

TEST(MeanSlope, IsThatOfTheChosenEigenvalues) {
  Lines lines;
  const PathNode node = lines.node({{{2.0 * j, 2.3 * j, 5.0 * j}}});
  const Track& track = node.tracks[0];
  EXPECT_LT(std::abs(mean_slope(track, {2.0 * j}) - j), 1e-11);
  EXPECT_LT(std::abs(mean_slope(track, {2.0 * j, 2.3 * j})), 1e-11);
  EXPECT_LT(std::abs(mean_slope(track, {2.0 * j, 2.3 * j, 5.0 * j}) - 0.5 / 3.0 * j), 1e-11);
}

TEST(MeanSlope, IsNotKnownOfOneOfTwoThatCoincide) {
  PlantedSearch planted(
      Planted::frequencies({Matrix{{2.0, 0.0}, {0.0, 2.0}}, Matrix{{1.0, 0.0}, {0.0, -1.0}}}));
  const PathNode node = planted.family.point(0.0, {{{2.0 * j, 2.0 * j}}});
  EXPECT_TRUE(std::isnan(mean_slope(node.tracks[0], {2.0 * j}).real()));
  EXPECT_LT(std::abs(mean_slope(node.tracks[0], {2.0 * j, 2.0 * j})), 1e-10);
}

TEST(KeepShape, TakesTheEigenvectorOfTheMember) {
  Lines lines;
  const PathNode node = lines.node({{{2.0 * j, 2.3 * j}}, {{5.0 * j}}});
  for (const int member : {0, 1}) {
    Event event;
    keep_shape(node, node.tracks[0], {member}, 0.05, event);
    ASSERT_EQ(event.shape.size(), 3);
    EXPECT_NEAR(std::abs(event.shape[member]), 1.0, 1e-10);
    EXPECT_NEAR(event.shape.norm(), 1.0, 1e-10);
  }
}

/// Two lines that meet at p = 0.15, as functions of p and of a shift q of the first one: dp/dq = -1/2.
TEST(ShiftOfMeeting, IsTheRatioOfTheSlopes) {
  Lines lines;
  const PathNode along_p = lines.planted.family.point(0.15, {{{2.15 * j, 2.15 * j}}});
  PlantedSearch shifted(Planted::frequencies(uncoupled(Matrix{{2.15, 1.0}, {2.15, 0.0}, {5.0, 0.0}})));
  const PathNode along_q = shifted.family.point(0.0, {{{2.15 * j, 2.15 * j}}});
  const double shift = shift_of_meeting(along_p.tracks[0], along_q.tracks[0], EventKind::crossing, {0, 1});
  EXPECT_NEAR(shift, -0.5, 1e-3) << "at a double eigenvalue, known to the square root of rounding";
  EXPECT_TRUE(std::isnan(shift_of_meeting(along_p.tracks[0], along_q.tracks[0], EventKind::veering, {0, 1})));
  EXPECT_TRUE(
      std::isnan(shift_of_meeting(along_p.tracks[0], along_q.tracks[0], EventKind::crossing, {0, 1, 2})));
}

TEST(SolvedPoint, IsTheOneBehindTheNode) {
  Lines lines;
  const PathNode node = lines.node(alone({2.0 * j, 2.3 * j, 5.0 * j}));
  RunCounts counts;
  const PathPoint point = solved_point(lines.planted.family.problem(), node, counts);
  EXPECT_EQ(point.status, PointStatus::computed);
  EXPECT_EQ(point.p, node.p);
}

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

/// sin(angle) = p / unit has its fold at p = unit, whatever mass and length are.
TEST(KeepFoldSensitivities, AreThoseOfThePlaceOfTheFold) {
  OnPath at(pushed_pendulum({.mass = 3.0, .length = 0.7, .unit = 2.0, .to = 2.4}), 1.9);
  at.take_plane();
  const PathNode node = at.on_fold();
  ASSERT_NEAR(node.p, 2.0, 1e-12);
  Event event;
  keep_fold_sensitivities(at.problem, node, event, at.counts);
  EXPECT_NEAR(event.shift[at.setting.parameter("unit")], 1.0, 1e-8);
  EXPECT_NEAR(event.shift[at.setting.parameter("mass")], 0.0, 1e-8);
  EXPECT_NEAR(event.shift[at.setting.parameter("length")], 0.0, 1e-8);
  EXPECT_TRUE(std::isnan(event.shift[at.setting.parameter("p")]));
}

}  // namespace
}  // namespace eigentrail::test::event_record_test
