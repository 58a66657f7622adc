// Eigenvalues and criteria of one track on a step, and the walk to a zero or an extremum.
#include "continuation/events/criterion_walk.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/planted_search.hpp"

namespace eigentrail::test {
namespace {

HermiteInterpolant no_excitation() {
  return {1.0, ComplexMatrix::Zero(1, 2), ComplexMatrix::Zero(1, 2)};
}

/// Frequencies 2 + p and 2.6 - p in one block.
struct Lines {
  Lines()
      : planted(Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.6, -1.0}}))),
        left(planted.family.point(0.0, {{{2.0 * j, 2.6 * j}}})),
        step(planted.step(left, 0.2, {{{2.2 * j, 2.4 * j}}})) {}
  PlantedSearch planted;
  PathNode left;
  Step step;
};

TEST(CriteriaOnStep, GivesTheEigenvaluesOfTheDenseOutput) {
  Lines lines;
  const HermiteInterpolant excitation = no_excitation();
  CriteriaOnStep on_step(lines.step, 0, excitation);
  EXPECT_EQ(on_step.begin(), 0.0);
  EXPECT_EQ(on_step.noise(), 0.0);
  for (const double t : {0.0, 0.3, 1.0}) {
    EXPECT_LT(std::abs(on_step.root(0, t) - (2.0 + 0.2 * t) * j), 1e-12);
    EXPECT_LT(std::abs(on_step.root(1, t) - (2.6 - 0.2 * t) * j), 1e-12);
  }
  EXPECT_LT(std::abs(on_step.member_near(0, 1.7) - 2.2 * j), 1e-12) << "the nearest end";
  const Criterion twice{EventKind::resonance, 0.0};
  EXPECT_NEAR(on_step.value(twice, 0, 0.5), 2.1, 1e-12) << "Im s minus no excitation";
}

TEST(AxisWidth, GrowsWithTheConditionUpToItsLimit) {
  const CriterionThresholds thresholds;
  Track track;
  track.pair.condition = 1.0;
  const double good = axis_width(thresholds, track);
  track.pair.condition = 1e3;
  EXPECT_GT(axis_width(thresholds, track), 100.0 * good);
  track.pair.condition = 1e30;
  EXPECT_EQ(axis_width(thresholds, track), thresholds.on_axis);
}

/// s^2 + 2 d s + 4 with d = 0.02 + 0.3 (p - 0.1)^2 - level.
struct Bending {
  explicit Bending(double lowered) : level(lowered), planted(matrices(lowered)) {}
  static Planted matrices(double lowered) {
    return Planted({{Matrix{{1.0}}},
                    {Matrix{{2.0 * (0.023 - lowered)}}, Matrix{{-0.12}}, Matrix{{0.6}}},
                    {Matrix{{4.0}}}});
  }
  Complex root(double p) const {
    const double d = 0.02 + 0.3 * (p - 0.1) * (p - 0.1) - level;
    return {-d, std::sqrt(4.0 - d * d)};
  }
  /// Whether the walk from t on the step from 0 to 0.25 succeeds, and what it finds.
  bool find(CriterionTarget target, double t, FoundEvents& found) {
    const PathNode left = planted.family.point(0.0, alone({root(0.0)}));
    const Step step = planted.step(left, 0.25, alone({root(0.25)}));
    const HermiteInterpolant excitation = no_excitation();
    CriteriaOnStep on_step(step, 0, excitation);
    return locate(planted.search, step, on_step, {0, 0}, target, t, found);
  }
  double level;
  PlantedSearch planted;
};

TEST(Locate, WalksToAZero) {
  Bending bending(0.02 + 0.3 * 0.01);  // d = 0.3 ((p - 0.1)^2 - 0.01): zeros at 0 and 0.2
  FoundEvents found;
  EXPECT_TRUE(bending.find({{EventKind::flutter}, true, CriterionTarget::Sought::zero}, 0.7, found));
  ASSERT_EQ(found.events.size(), 1U);
  EXPECT_NEAR(found.events[0].p, 0.2, 1e-12);
  EXPECT_EQ(found.events[0].direction, -1);
  EXPECT_GT(found.events[0].retrackings, 0);
}

TEST(Locate, WalksToAnExtremumOfTheDampingRatio) {
  Bending bending(0.0);
  FoundEvents found;
  EXPECT_TRUE(bending.find({{EventKind::extremum}, true, CriterionTarget::Sought::extremum}, 0.5, found));
  ASSERT_EQ(found.events.size(), 1U);
  EXPECT_NEAR(found.events[0].p, 0.1, 1e-10);
  EXPECT_NEAR(found.events[0].value, 0.01, 1e-12);
  EXPECT_EQ(found.events[0].direction, 1) << "a minimum";
}

/// The least value stays above zero: the walk finds the extremum, and it is no zero.
TEST(Locate, FindsNoTouchWhereTheFunctionStaysAway) {
  Bending bending(0.0);
  FoundEvents found;
  bending.find({{EventKind::flutter}, true, CriterionTarget::Sought::touch}, 0.4, found);
  EXPECT_TRUE(found.events.empty());
}

TEST(Locate, FindsBothZerosBesideATouch) {
  Bending bending(0.02 + 0.3 * 1e-4);  // zeros at 0.09 and 0.11
  FoundEvents found;
  EXPECT_TRUE(bending.find({{EventKind::flutter}, true, CriterionTarget::Sought::touch}, 0.42, found));
  ASSERT_EQ(found.events.size(), 2U);
  EXPECT_NEAR(std::min(found.events[0].p, found.events[1].p), 0.09, 1e-11);
  EXPECT_NEAR(std::max(found.events[0].p, found.events[1].p), 0.11, 1e-11);
}

}  // namespace
}  // namespace eigentrail::test
