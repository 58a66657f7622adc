// The verdict on a step: each reason to reject one, with the step beside it that has to pass.
#include "continuation/step/step_judgement.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/on_path.hpp"
#include "continuation/planted_search.hpp"

namespace eigentrail::test::step_judgement_test {
namespace {

using Kind = Verdict::Kind;

Verdict verdict_on(PlantedSearch& planted, const Step& step,
                   Uncertified uncertified = Uncertified::is_rejected, std::vector<TrackTest> tests = {}) {
  tests.resize(step.right.tracks.size(), TrackTest::strict);
  return judge(planted.family.problem(), planted.frame, planted.options, step, uncertified, tests,
               planted.family.counts);
}

/// Frequencies 2 + p, 2 - p and 5: two lines that cross at p = 0, and one far away.
Planted lines() {
  return Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.0, -1.0}, {5.0, 0.0}}));
}
std::vector<Complex> on_lines(double p) {
  return {(2.0 + p) * j, (2.0 - p) * j, 5.0 * j};
}

TEST(Judge, AcceptsAStepWithItsErrorAndItsCertificates) {
  PlantedSearch planted(lines());
  const PathNode left = planted.family.point(0.3, alone(on_lines(0.3)));
  const Verdict verdict = verdict_on(planted, planted.step(left, 0.4, alone(on_lines(0.4))));
  ASSERT_TRUE(verdict.accepted()) << verdict.reason;
  EXPECT_LT(verdict.error, 1.0);
  EXPECT_EQ(verdict.certified, std::vector<bool>(3, true));
  planted.options.certify = false;
  const Verdict without = verdict_on(planted, planted.step(left, 0.4, alone(on_lines(0.4))));
  EXPECT_TRUE(without.accepted());
  EXPECT_TRUE(without.certified.empty());
}

TEST(Judge, RejectsWhatIsInaccurate) {
  PlantedSearch planted(Planted({{Matrix{{1.0}}}, {}, {Matrix{{1.0}}, Matrix{{1.0}}}}, 1));
  const auto s = [](double p) { return std::vector<Complex>{std::sqrt(1.0 + p) * j}; };
  const PathNode left = planted.family.point(0.0, alone(s(0.0)));
  const Verdict verdict = verdict_on(planted, planted.step(left, 0.8, alone(s(0.8))));
  EXPECT_EQ(verdict.kind, Kind::inaccurate);
  EXPECT_GT(verdict.error, 1.0);
  EXPECT_TRUE(std::isfinite(verdict.error)) << "the next length follows from it";
}

TEST(Judge, FindsTwoTracksOnOneEigenpair) {
  PlantedSearch planted(lines());
  const PathNode left = planted.family.point(0.3, alone({5.0 * j, 2.3 * j, 2.3 * j}));
  const Verdict verdict = verdict_on(planted, planted.step(left, 0.4, alone({5.0 * j, 2.4 * j, 2.4 * j})));
  EXPECT_EQ(verdict.kind, Kind::merged);
  EXPECT_EQ(verdict.track, 2);
  EXPECT_EQ(verdict.error, INFINITY);
}

TEST(Judge, FindsASingleModeThatHasArrivedAtOneOfABlock) {
  PlantedSearch planted(lines());
  const std::vector<Together> from{{{2.3 * j, 1.7 * j}}, {{5.0 * j}}, {{2.3 * j}}};
  const std::vector<Together> to{{{2.4 * j, 1.6 * j}}, {{5.0 * j}}, {{2.4 * j}}};
  const PathNode left = planted.family.point(0.3, from);
  const Verdict verdict = verdict_on(planted, planted.step(left, 0.4, to));
  EXPECT_EQ(verdict.kind, Kind::merged);
  EXPECT_EQ(verdict.track, 2);
}

/// On a crossing two eigenvalues agree, and are two modes: their vectors are different.
TEST(Judge, TwoModesOfOneEigenvalueHaveNotMerged) {
  PlantedSearch planted(lines());
  planted.options.certify = false;
  const PathNode left = planted.family.point(0.3, alone(on_lines(0.3)));
  Step step = planted.step(left, 0.4, alone(on_lines(0.4)));
  step.right.tracks[1].roots = step.right.tracks[0].roots;
  const Verdict verdict = verdict_on(planted, step);
  EXPECT_TRUE(verdict.accepted()) << verdict.reason;
}

/// Half-width 0.02: within as much to both sides the vectors turn by a right angle's half.
struct Veering {
  static constexpr double eps = 0.02;
  static Planted family() {
    return Planted::frequencies({Matrix{{2.0, eps}, {eps, 2.0}}, Matrix{{1.0, 0.0}, {0.0, -1.0}}});
  }
  static std::vector<Complex> at(double p) {
    return {(2.0 - std::hypot(p, eps)) * j, (2.0 + std::hypot(p, eps)) * j};
  }
};

TEST(Judge, WithoutACertificateAShapeThatTurnsIsAnotherMode) {
  PlantedSearch planted(Veering::family());
  planted.options.tolerance = 1e-2;
  const PathNode left = planted.family.point(-Veering::eps, alone(Veering::at(-Veering::eps)));
  const auto to = [&](double p) { return planted.step(left, p, alone(Veering::at(p))); };
  EXPECT_NE(verdict_on(planted, to(Veering::eps)).kind, Kind::mismatch);
  planted.options.certify = false;
  const Verdict verdict = verdict_on(planted, to(Veering::eps));
  EXPECT_EQ(verdict.kind, Kind::mismatch);
  EXPECT_EQ(verdict.track, 0);
  EXPECT_EQ(verdict.error, INFINITY);
  EXPECT_TRUE(verdict_on(planted, to(-0.5 * Veering::eps)).accepted());
}

/// Followed across a crossing by their order in size: only a certificate, or their shapes, can object.
TEST(Judge, AnExchangeOfModesHasNoCertificate) {
  PlantedSearch planted(lines());
  planted.options.tolerance = 0.1;
  const PathNode left = planted.family.point(-1e-3, alone({1.999 * j, 2.001 * j, 5.0 * j}));
  const auto exchanged = [&] { return planted.step(left, 1e-3, alone({1.999 * j, 2.001 * j, 5.0 * j})); };
  const Verdict verdict = verdict_on(planted, exchanged());
  EXPECT_EQ(verdict.kind, Kind::uncertified);
  EXPECT_EQ(verdict.track, 0);
  EXPECT_LT(verdict.error, 1.0) << "the error is known, and accepted";
  EXPECT_EQ(verdict.certified, (std::vector<bool>{false, false, false}));
  // If the step may pass, the others' certificates count.
  EXPECT_EQ(verdict_on(planted, exchanged(), Uncertified::passes).certified,
            (std::vector<bool>{false, false, true}));
  EXPECT_EQ(verdict_on(planted, exchanged(), Uncertified::passes_by_shape).kind, Kind::mismatch);
  planted.options.certify = false;
  EXPECT_EQ(verdict_on(planted, exchanged()).kind, Kind::mismatch);
}

/// The same without the exchange: no certificate closes through the crossing, but the shapes agree.
TEST(Judge, LetsAStepPassByTheShapesOfItsModes) {
  PlantedSearch planted(lines());
  const PathNode left = planted.family.point(-1e-3, alone(on_lines(-1e-3)));
  const auto step = [&] { return planted.step(left, 1e-3, alone(on_lines(1e-3))); };
  EXPECT_EQ(verdict_on(planted, step()).kind, Kind::uncertified);
  const Verdict verdict = verdict_on(planted, step(), Uncertified::passes_by_shape);
  EXPECT_EQ(verdict.kind, Kind::uncertified);
  EXPECT_EQ(verdict.certified, (std::vector<bool>{false, false, true}));
}

/// Tracks that failed before pass by their shapes, and the step needs no shorter attempt.
TEST(Judge, TracksThatMayFailDoNotRejectAStep) {
  PlantedSearch planted(lines());
  const PathNode left = planted.family.point(-1e-3, alone(on_lines(-1e-3)));
  const auto step = [&] { return planted.step(left, 1e-3, alone(on_lines(1e-3))); };
  for (const TrackTest test : {TrackTest::lenient, TrackTest::none}) {
    const Verdict verdict = verdict_on(planted, step(), Uncertified::is_rejected, {test, test});
    EXPECT_TRUE(verdict.accepted());
    EXPECT_EQ(verdict.certified, (std::vector<bool>{false, false, true}));
    EXPECT_EQ(verdict_on(planted, step(), Uncertified::is_rejected, {test}).kind, Kind::uncertified)
        << "the second one may not";
  }
  planted.options.tolerance = 0.1;
  const PathNode from = planted.family.point(-1e-3, alone({1.999 * j, 2.001 * j, 5.0 * j}));
  const Step exchanged = planted.step(from, 1e-3, alone({1.999 * j, 2.001 * j, 5.0 * j}));
  EXPECT_EQ(verdict_on(planted, exchanged, Uncertified::is_rejected, {TrackTest::none, TrackTest::none}).kind,
            Kind::mismatch);
}

TEST(MayStayUncertified, IsAShareOfTheRangeOfTheCoordinate) {
  PathFrame frame{PathRange{0, 2.0, -2.0}};
  EXPECT_TRUE(may_stay_uncertified(frame, -4.0 * uncertified_share));
  EXPECT_FALSE(may_stay_uncertified(frame, 4.001 * uncertified_share));
  frame.plane = PathPlane{Vector::Zero(1), 1.0};
  EXPECT_TRUE(may_stay_uncertified(frame, 0.999 * uncertified_share));
  EXPECT_FALSE(may_stay_uncertified(frame, 1.001 * uncertified_share));
}

/// A pendulum on a spring hangs straight for every stiffness, and tilted above the critical one.
struct SpringPendulum {
  explicit SpringPendulum(const std::string& position)
      : setting(spring_pendulum(position, 20.0, 30.0)), problem(setting.problem()) {}
  PathNode at(double k) {
    PathNode node = differentiate_point(problem, point_from_guess(problem, k, counts), counts).value();
    for (Track& track : node.tracks) track.modes = track.arriving = {0};
    node.tracks.resize(1);
    return node;
  }
  Setting setting;
  PathProblem problem;
  RunCounts counts;
};
TEST(Judge, FindsThatAnEquilibriumLiesOnAnotherPath) {
  SpringPendulum on_this(hanging_tilted);
  SpringPendulum on_other(hanging_straight);
  PathFrame frame{PathRange{on_this.problem.traced, 20.0, 30.0}};
  const PathNode left = on_this.at(20.0);
  TraceOptions options = on_this.setting.options;
  options.certify = false;
  const auto verdict_to = [&](const PathNode& right) {
    std::vector<TrackTest> tests(right.tracks.size(), TrackTest::strict);
    return judge(on_this.problem, frame, options, {&left, right, 0.5}, Uncertified::passes, tests,
                 on_this.counts);
  };
  const Verdict verdict = verdict_to(on_other.at(20.5));
  EXPECT_EQ(verdict.kind, Kind::no_equilibrium);
  EXPECT_EQ(verdict.error, INFINITY);
  EXPECT_TRUE(verdict_to(on_this.at(20.5)).accepted());
}

/// Straight for every stiffness: x moves by rounding only, which has no order.
TEST(Judge, RoundingOfAnEquilibriumThatDoesNotMoveIsNoOtherPath) {
  SpringPendulum hanging(hanging_straight);
  PathFrame frame{PathRange{hanging.problem.traced, 20.0, 30.0}};
  const PathNode left = hanging.at(20.0);
  PathNode right = hanging.at(20.5);
  const Eigen::Index n = right.path.x.rows();
  right.path.x.col(0) += 1e-8 * Vector::LinSpaced(n, -1.0, 1.0);
  right.path.x.col(1) += 1e-7 * Vector::LinSpaced(n, 1.0, -1.0);
  TraceOptions options = hanging.setting.options;
  options.certify = false;
  std::vector<TrackTest> tests(right.tracks.size(), TrackTest::strict);
  const Verdict verdict =
      judge(hanging.problem, frame, options, {&left, right, 0.5}, Uncertified::passes, tests, hanging.counts);
  EXPECT_NE(verdict.kind, Kind::no_equilibrium);
}

}  // namespace
}  // namespace eigentrail::test::step_judgement_test
