// The walk to a zero or an extremum of a criterion, and where on a step criteria begin, with places in closed
// form.
#include "continuation/events/criterion_walk.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "continuation/planted_oscillator.hpp"

namespace eigentrail::test::criterion_walk_test {
namespace {

const RoundingThresholds default_rounding;

using Sought = CriterionTarget::Sought;

struct Located {
  bool done = false;
  FoundEvents found;
};

/// Locates on a step of the first eigenvalue of the first track.
Located locate_on(const PlantedOscillator& planted, const Step& step, const CriterionTarget& target, double t,
                  double excitation = 0.0) {
  ComplexMatrix constant = ComplexMatrix::Zero(1, 2);
  constant(0, 0) = excitation;
  const HermiteInterpolant interpolant(step.h, constant, constant);
  CriteriaOnStep on_step(step, 0, interpolant, default_rounding);
  Located located;
  located.done = locate(planted.search, on_step, 0, target, t, located.found);
  return located;
}

const Criterion flutter{EventKind::flutter, 0.0};

/// c = 0.2, k = 1 + p: damping ratio 0.1 / sqrt(1 + p), and the decrement that belongs to it.
TEST(Locate, FindsRequestedValuesInEitherChart) {
  const auto ratio_at = [](double p) { return 0.1 / std::sqrt(1.0 + p); };
  const double ratio = ratio_at(0.23);
  const double decrement = 2.0 * std::numbers::pi * ratio / std::sqrt(1.0 - ratio * ratio);
  PlantedOscillator planted({0.2}, {1.0, 1.0});
  const double frequency = planted.root(0.23).imag();
  for (const Chart chart : {Chart::finite, Chart::reciprocal}) {
    const Step step = planted.single(0.0, 0.4, chart);
    for (const Criterion& criterion :
         {Criterion{EventKind::damping_ratio, ratio}, Criterion{EventKind::log_decrement, decrement}}) {
      const Located located = locate_on(planted, step, {criterion, true}, 0.4);
      ASSERT_EQ(located.found.events.size(), 1U);
      const Event& event = located.found.events[0];
      EXPECT_EQ(event.kind, criterion.kind);
      EXPECT_EQ(event.value, criterion.value);
      EXPECT_NEAR(event.p, 0.23, 1e-12);
      EXPECT_EQ(event.direction, 1);
    }
  }
  planted.options.events.excitation = Expression::parse("0.5", {});
  const Criterion resonance{EventKind::resonance, 2.0 * frequency};
  const Located located = locate_on(planted, planted.single(0.0, 0.4), {resonance, true}, 0.4, 0.5);
  ASSERT_EQ(located.found.events.size(), 1U);
  EXPECT_NEAR(located.found.events[0].p, 0.23, 1e-12);
  EXPECT_EQ(located.found.events[0].direction, 1) << "Im s grows";
}

TEST(Locate, AFlatExtremumIsRounding) {
  PlantedOscillator planted({0.2, 0.0, 1.0}, {1.0});
  const CriterionTarget target{{EventKind::extremum, 0.0}, true, Sought::extremum};
  const Step step = planted.single(-0.2, 0.3);
  // The ratio changes by 0.03 over half the step.
  planted.options.tolerance = 0.1;
  const Located located = locate_on(planted, step, target, 0.5);
  EXPECT_TRUE(located.done);
  EXPECT_TRUE(located.found.events.empty());
}

TEST(Locate, LeavesZerosOfOtherStepsToThem) {
  PlantedOscillator planted({0.2, -1.0}, {1.0});
  // A little outside: may be lost between two steps. Farther outside: found there.
  const Located near = locate_on(planted, planted.single(0.1, 0.199), {flutter, true}, 0.9);
  EXPECT_TRUE(near.done);
  EXPECT_EQ(near.found.events.size(), 1U);
  const Located far = locate_on(planted, planted.single(0.1, 0.18), {flutter, true}, 0.9);
  EXPECT_TRUE(far.done);
  EXPECT_TRUE(far.found.events.empty());
}

TEST(Locate, FailsWhereThereIsNoZero) {
  PlantedOscillator planted({0.2, 0.1}, {1.0});
  const Located located = locate_on(planted, planted.single(-0.1, 0.1), {flutter, true}, 0.5);
  EXPECT_FALSE(located.done);
  EXPECT_TRUE(located.found.events.empty());
}

/// For comparison: the zero of the dense output of order 1 is farther off than the walk, by far.
TEST(Locate, IsMoreAccurateThanTheDenseOutput) {
  PlantedOscillator planted({0.2}, {1.0, 1.0}, 1);
  const Step step = planted.single(0.0, 0.9);
  const Criterion criterion{EventKind::damping_ratio, 0.1 / std::sqrt(1.5)};
  const HermiteInterpolant none(step.h, ComplexMatrix::Zero(1, 2), ComplexMatrix::Zero(1, 2));
  CriteriaOnStep on_step(step, 0, none, default_rounding);
  double from = 0.0, to = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (from + to);
    (on_step.value(criterion, 0, middle) < 0.0 ? from : to) = middle;
  }
  const Located located = locate_on(planted, step, {criterion, true}, 0.5);
  ASSERT_EQ(located.found.events.size(), 1U);
  const double miss = std::abs(located.found.events[0].p - 0.5);
  EXPECT_LT(miss, 1e-12);
  EXPECT_GT(std::abs(0.9 * from - 0.5), 1e5 * std::max(miss, 1e-13));
}

/// A pair that meets on the real axis at p = 0.75: its criteria begin a little behind that point.
TEST(CriteriaOnStep, BeginsWhereEigenvaluesCanBeDistinguished) {
  PlantedOscillator planted({1.0}, {1.0, -1.0});
  const auto both = [](double p) {
    const double root = std::sqrt(p - 0.75);
    return std::vector<Together>{{{-0.5 + root, -0.5 - root}}};
  };
  planted.left = planted.family.point(0.75, {{{-0.5, -0.5}}});
  planted.left.tracks[0].departure = Track::Departure{1e-4, ComplexVector{{-0.49, -0.51}}};
  const Step step = planted.step(planted.left, 0.85, both(0.85));
  const HermiteInterpolant none(step.h, ComplexMatrix::Zero(1, 2), ComplexMatrix::Zero(1, 2));
  CriteriaOnStep on_step(step, 0, none, default_rounding);
  EXPECT_NEAR(on_step.begin(), 1e-3, 1e-12);
  // The roots differ by 2 sqrt(p - 0.75), so that their error is that of the square over this.
  EXPECT_GT(on_step.rounding(0, 0.0), 1e-9);
  EXPECT_LT(on_step.rounding(0, on_step.begin()), 1e-11);
  EXPECT_LT(on_step.rounding(0, 0.4), 0.2 * on_step.rounding(0, on_step.begin()));
  EXPECT_NEAR(on_step.value(flutter, 0, 0.4), -0.3, 1e-6);
  EXPECT_NEAR(on_step.value(flutter, 1, 0.4), -0.7, 1e-6);
  // Beyond the ends: those at the ends.
  EXPECT_LT(std::abs(on_step.member_near(0, -1.0) - (-0.49)), 1e-8);
  EXPECT_LT(std::abs(on_step.member_near(0, 2.0) - planted.root(0.85)), 1e-12);
}

}  // namespace
}  // namespace eigentrail::test::criterion_walk_test
