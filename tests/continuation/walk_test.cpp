// The safeguarded iteration that locates events, on functions with known roots.
#include "continuation/events/walk.hpp"

#include <gtest/gtest.h>

namespace eigentrail::test::walk_test {
namespace {

WalkRules rules_of(double resolution) {
  WalkRules rules;
  rules.resolution = resolution;
  return rules;
}

/// Newton's method for the root of x^2 - 2.
Sight to_root_of_two(double x) {
  return {Sight::Kind::seen, (2.0 - x * x) / (2.0 * x)};
}

TEST(Walk, NewtonsMethodSettlesOnARoot) {
  const Walk found = walk(1.0, rules_of(1e-12), to_root_of_two);
  EXPECT_EQ(found.end, WalkEnd::settled);
  EXPECT_NEAR(found.position + found.move, std::sqrt(2.0), 1e-15);
  EXPECT_LE(found.looks, 6);
}

TEST(Walk, EndsOutsideItsInterval) {
  WalkRules rules = rules_of(1e-12);
  rules.begin = 0.0;
  rules.end = 1.2;
  const Walk found = walk(1.0, rules, to_root_of_two);
  EXPECT_EQ(found.end, WalkEnd::outside);
  EXPECT_EQ(found.looks, 1);
}

TEST(Walk, IntervalsMayRunBackward) {
  WalkRules rules = rules_of(1e-12);
  rules.begin = 0.0;
  rules.end = -2.0;
  const Walk found = walk(-1.0, rules, to_root_of_two);
  EXPECT_EQ(found.end, WalkEnd::settled);
  EXPECT_NEAR(found.position + found.move, -std::sqrt(2.0), 1e-15);
}

TEST(Walk, RoundingBeyondTheEndCountsAsTheEnd) {
  WalkRules rules = rules_of(1e-12);
  rules.begin = 0.0;
  rules.end = 1.5;
  rules.slack = 1e-9;
  double last = 0.0;
  const auto look = [&last](double x) {
    last = x;
    return Sight{Sight::Kind::seen, x < 1.5 ? 1.5 + 5e-10 - x : 0.0};
  };
  EXPECT_EQ(walk(1.0, rules, look).end, WalkEnd::settled);
  EXPECT_EQ(last, 1.5);
}

/// If moves no longer decrease, the iteration has converged if they are at the rounding level. If they are
/// far above it, the iteration has failed.
TEST(Walk, TellsRoundingFromWandering) {
  const auto restless = [](double) { return Sight{Sight::Kind::seen, 1e-10}; };
  WalkRules rules = rules_of(1e-13);
  rules.rounding = 1e-9;
  EXPECT_EQ(walk(0.0, rules, restless).end, WalkEnd::settled);
  rules.rounding = 1e-11;
  rules.free_moves = 0;
  EXPECT_EQ(walk(0.0, rules, restless).end, WalkEnd::wandering);
  rules.free_moves = most_looks;
  EXPECT_EQ(walk(0.0, rules, restless).end, WalkEnd::exhausted);
}

TEST(Walk, EndsWhereALookSaysSo) {
  using Kind = Sight::Kind;
  for (const auto& [kind, end] :
       {std::pair(Kind::absent, WalkEnd::absent), std::pair(Kind::failed, WalkEnd::failed),
        std::pair(Kind::settled, WalkEnd::settled)}) {
    const Walk found = walk(3.0, rules_of(0.0), [kind = kind](double) { return Sight{kind, 0.25}; });
    EXPECT_EQ(found.end, end);
    EXPECT_EQ(found.looks, 1);
    EXPECT_EQ(found.position, 3.0);
  }
}

/// For comparison: without an interval the same method diverges from a start where the slope is small.
TEST(Walk, WithoutAnIntervalNewtonsMethodRunsAway) {
  const auto arctangent = [](double x) { return Sight{Sight::Kind::seen, -std::atan(x) * (1.0 + x * x)}; };
  EXPECT_NE(walk(2.0, rules_of(1e-12), arctangent).end, WalkEnd::settled);
  WalkRules rules = rules_of(1e-12);
  rules.begin = -3.0;
  rules.end = 3.0;
  EXPECT_EQ(walk(2.0, rules, arctangent).end, WalkEnd::outside);
}

}  // namespace
}  // namespace eigentrail::test::walk_test
