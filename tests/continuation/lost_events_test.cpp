// Regression tests: events close to each other, and steps that are shortened to end at a meeting.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "support/scenes.hpp"

namespace eigentrail::test::lost_events_test {
namespace {

Setting family(const std::string& from, const std::string& to, const std::string& C, const std::string& K,
               const OptionTexts& overrides = {}) {
  return make_setting("[trace]\nparameter = \"p\"\nfrom = " + from + "\nto = " + to +
                          "\n[matrix_family]\nM = [ [[1, 0], [0, 1]] ]\nC = " + C + "\nK = " + K + "\n",
                      overrides);
}

// s^2 + (2 + p) s + 1: its pair meets at p = 0, s = -1. s^2 + p s + 4: flutter at p = 0, s = 2j.
TEST(LostEvents, FlutterBesideACollisionOfOtherModes) {
  const RecordedTrace trace = completed_trace(
      family("-0.5", "0.7", "[ [[2, 0], [0, 0]], [[1, 0], [0, 1]] ]", "[ [[1, 0], [0, 4]] ]"));
  const Event flutter = only_event(trace.result, EventKind::flutter);
  EXPECT_NEAR(flutter.p, 0.0, 1e-12);
  EXPECT_NEAR(flutter.s.imag(), 2.0, 1e-12);
  EXPECT_EQ(flutter.direction, -1);
  const Event collision = only_event(trace.result, EventKind::collision);
  EXPECT_NEAR(collision.s.real(), -1.0, 1e-8);
}

// s^2 + 2 d s + 1 - p: the pair meets at p = 1 - d^2, and one of the two real roots is zero at p = 1.
class DivergenceBehindCollision : public testing::TestWithParam<double> {};

TEST_P(DivergenceBehindCollision, IsAnEventOfItsOwn) {
  const double d = GetParam();
  std::ostringstream C;
  C << "[ [[" << 2.0 * d << ", 0], [0, 0.1]] ]";
  for (const bool upward : {true, false}) {
    SCOPED_TRACE(upward ? "upward" : "downward");
    const RecordedTrace trace = completed_trace(family(upward ? "0" : "1.5", upward ? "1.5" : "0", C.str(),
                                                       "[ [[1, 0], [0, 9]], [[-1, 0], [0, 0]] ]"));
    const Event collision = only_event(trace.result, EventKind::collision);
    const Event divergence = only_event(trace.result, EventKind::divergence);
    EXPECT_NEAR(collision.p, 1.0 - d * d, 1e-10);
    EXPECT_NEAR(divergence.p, 1.0, 1e-10);
    EXPECT_EQ(divergence.direction, 1);
  }
}

// From far apart to a distance in p of 1e-14, a few units of rounding.
INSTANTIATE_TEST_SUITE_P(Damping, DivergenceBehindCollision,
                         testing::Values(0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7),
                         [](const auto& checked) { return "case_" + std::to_string(checked.index); });

// s^2 + (1.8 - 2 p) s + 1 - p: flutter at p = 0.9; where (p - 0.9)^2 = 1 - p the pair meets on the real axis;
// one of its real roots is zero at p = 1. The mode that begins where the pair meets must know that its parent
// has become unstable on the step that ends there.
TEST(LostEvents, DivergenceOfAModeWhoseParentHasJustBecomeUnstable) {
  const RecordedTrace trace = record_trace(family("0", "1.5", "[ [[1.8, 0], [0, 0.1]], [[-2, 0], [0, 0]] ]",
                                                  "[ [[1, 0], [0, 9]], [[-1, 0], [0, 0]] ]"));
  const Event flutter = only_event(trace.result, EventKind::flutter);
  const Event divergence = only_event(trace.result, EventKind::divergence);
  EXPECT_NEAR(flutter.p, 0.9, 1e-12);
  EXPECT_NEAR(divergence.p, 1.0, 1e-12);
  EXPECT_EQ(divergence.direction, -1);
}

// Without damping the pair meets at zero and leaves the imaginary axis there. This is one event, not two.
TEST(LostEvents, CollisionAtZeroIsNoDivergenceToo) {
  const RecordedTrace trace =
      record_trace(family("0", "1.5", "[ [[0, 0], [0, 0]] ]", "[ [[1, 0], [0, 9]], [[-1, 0], [0, 0]] ]"));
  EXPECT_EQ(events_of(trace.result, EventKind::collision).size(), 1U);
  EXPECT_TRUE(events_of(trace.result, EventKind::divergence).empty());
}

// Modes 1 and 2 meet at p = 1/2, where a step is cut. There, mode 3 passes a bump a thousandth as wide as the
// range, which the step that was cut has not seen.
TEST(LandedSteps, AreJudgedAnew) {
  const Setting setting = make_setting(
      "[trace]\nparameter = \"p\"\nfrom = 0\nto = 1\ntolerance = 1e-6\n[matrix_family]\n"
      "M = [ [[1, 0, 0], [0, 1, 0], [0, 0, 1]] ]\n"
      "K = [ [[1, \"p\", 0], [\"-p\", 2, 0], [0, 0, \"9 + exp(-((p - 0.5) / 1e-3)^2)\"]] ]\n");
  const RecordedTrace trace = completed_trace(setting);
  for (int i = -40; i <= 40; ++i) {
    const double p = 0.5 + 1e-4 * i;
    const double expected = std::sqrt(9.0 + std::exp(-std::pow((p - 0.5) / 1e-3, 2)));
    const ComplexVector found = trace.eigenvalues_at(p);
    double nearest = INFINITY;
    for (const Complex s : found) nearest = std::min(nearest, std::abs(s - Complex(0.0, expected)));
    EXPECT_LT(nearest, 1e-6 * expected) << "at p = " << p;
  }
}

// Every stored step ends at the point that follows it, however often it was cut on its way.
TEST(LandedSteps, EndAtTheirPoints) {
  const RecordedTrace trace = record_trace(scene_setting("ground_resonance"));
  ASSERT_EQ(trace.steps.size() + 1, trace.nodes.size());
  for (std::size_t i = 0; i < trace.steps.size(); ++i) {
    EXPECT_DOUBLE_EQ(trace.nodes[i].p + trace.steps[i].length, trace.nodes[i + 1].p);
    EXPECT_EQ(trace.steps[i].parameter(1, 0), trace.nodes[i + 1].p);
  }
}

/// A stiffness that changes within 1e-3 of the range: two modes collide and diverge on its way down and up.
/// Beside the collisions rounding is above this tolerance, and no step is short enough for it. Steps that
/// rounding shortens are not to stay short.
TEST(LostEvents, NoneWhereTheToleranceIsBelowRounding) {
  for (const bool upward : {true, false}) {
    SCOPED_TRACE(upward ? "upward" : "downward");
    const RecordedTrace trace =
        completed_trace(family(upward ? "0" : "1", upward ? "1" : "0", "[ [[0.066, 0.02], [-0.02, 0.3]] ]",
                               "[ [[\"2.5 - 3.5*exp(-1e6*(p-0.3137)^2)\", 3], [3, 17]] ]",
                               {{"tolerance", "1e-11"}, {"max_nodes", "1000"}}));
    EXPECT_EQ(events_of(trace.result, EventKind::collision).size(), 2U);
    EXPECT_EQ(events_of(trace.result, EventKind::divergence).size(), 2U);
  }
}

}  // namespace
}  // namespace eigentrail::test::lost_events_test
