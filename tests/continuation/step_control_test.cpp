#include "eigentrail/continuation/step_control.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace eigentrail::test::step_control_test {
namespace {

TEST(StepControl, FirstStepIsTheGivenOne) {
  EXPECT_EQ(StepControl(3, 0.2, 2.5, 1e-10).propose(10.0), 0.2);
  EXPECT_EQ(StepControl(3, 7.0, 2.5, 1e-10).propose(10.0), 2.5);
}

TEST(StepControl, LandsOnTheEndWithoutASliver) {
  const StepControl control(3, 1.0, 2.5, 1e-11 * 10.0);
  EXPECT_EQ(control.propose(1.01), 1.01);
  EXPECT_EQ(control.propose(0.3), 0.3);
  EXPECT_EQ(control.propose(1.8), 0.9);
  EXPECT_EQ(control.propose(2.5), 1.0);
}

TEST(StepControl, NeverExceedsTheLongestStep) {
  const StepControl control(3, 0.5, 0.5, 1e-10);
  EXPECT_LE(control.propose(0.505), 0.5);
  EXPECT_LE(control.propose(0.75), 0.5);
}

TEST(StepControl, NeverFallsBelowTheShortest) {
  EXPECT_EQ(StepControl(3, 1e-20, 2.5, 1e-10).propose(10.0), 1e-10);
}

TEST(StepControl, SettlesWhereTheErrorIsAThirdOfTheTolerance) {
  // A function whose error is (h / 0.7)^8 of the tolerance everywhere.
  StepControl control(3, 0.05, 50.0, 1e-11 * 100.0);
  double h = 0.0;
  for (int i = 0; i < 30; ++i) {
    h = control.propose(100.0);
    const double error = std::pow(h / 0.7, 8);
    error <= 1.0 ? control.accept(h, error) : control.reject(h, error);
  }
  EXPECT_NEAR(std::pow(h / 0.7, 8), 0.3, 0.01);
}

TEST(StepControl, FollowsASingularityWithoutRejections) {
  // Distance to a singularity at 10: error (h / (10 - p))^8 scaled so that h is a third of the distance.
  StepControl control(3, 0.5, 10.0, 1e-11 * 10.0);
  double p = 0.0;
  int rejected = 0;
  int accepted = 0;
  while (10.0 - p > 1e-3) {
    const double h = control.propose(10.0 - p);
    const double error = std::pow(3.0 * h / (10.0 - p), 8);
    if (error <= 1.0) {
      control.accept(h, error);
      p += h;
      ++accepted;
    } else {
      control.reject(h, error);
      ++rejected;
    }
  }
  EXPECT_LE(rejected, 2);
  EXPECT_LT(accepted, 60);
}

TEST(StepControl, ErrorsThatAreRoundingShortenNoStep) {
  // A certificate that does not close has made steps short; series are exact on them.
  StepControl control(3, 0.1, 10.0, 1e-10);
  control.accept(0.1, 0.2);
  double h = control.propose(100.0);
  control.reject(h, INFINITY);
  h = control.propose(100.0);
  for (int i = 0; i < 5; ++i) {
    control.accept(h, 0.0);
    EXPECT_GE(control.propose(100.0), h);
    h = control.propose(100.0);
  }
  // From rounding to an error of the step there is no trend.
  control.accept(h, 0.3);
  EXPECT_NEAR(control.propose(100.0), h, 1e-12);
}

TEST(StepControl, FailedStepsShrinkUntilExhausted) {
  StepControl control(2, 0.1, 0.25, 1e-11 * 1.0);
  int tries = 0;
  while (!control.exhausted() && tries < 1000) {
    control.reject(control.propose(1.0), INFINITY);
    ++tries;
  }
  EXPECT_LT(tries, 40);
}

TEST(StepControl, GrowsByTheRootOfTheErrorsOrder) {
  // The error of the interpolant of order q goes with h^(2q+2): the next step aims at three tenths of what is
  // accepted.
  for (int order = 1; order <= 4; ++order) {
    StepControl control(order, 1.0, 50.0, 1e-10);
    control.accept(1.0, 0.01);
    EXPECT_NEAR(control.step(), std::min(std::pow(30.0, 1.0 / (2.0 * order + 2.0)), 2.5), 1e-12)
        << "order " << order;
  }
}

TEST(StepControl, DoesNotGrowRightAfterARejection) {
  StepControl control(3, 1.0, 50.0, 1e-10);
  control.reject(1.0, 8.0);
  const double h = control.step();
  EXPECT_LT(h, 1.0);
  control.accept(h, 1e-6);
  EXPECT_EQ(control.step(), h);
  control.accept(h, 1e-6);
  EXPECT_GT(control.step(), h);
}

}  // namespace
}  // namespace eigentrail::test::step_control_test
