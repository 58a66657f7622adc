// Numbers of real eigenvalues at both ends of a step, for the pair of s^2 + s + 1 - p, which becomes real at
// p = 0.75.
#include "continuation/events/step_checks.hpp"

#include <gtest/gtest.h>

#include "continuation/planted_search.hpp"

namespace eigentrail::test::overlooked_collision_test {
namespace {

struct Ends {
  Step step(double from, double to) {
    const auto roots = [](double p) -> Together {
      const Complex root = std::sqrt(Complex(p - 0.75));
      return {{-0.5 + root, -0.5 - root}};
    };
    left = planted.family.point(from, {roots(from)});
    return {&left, planted.family.point(to, {roots(to)}), to - from};
  }
  PlantedSearch planted{Planted({{Matrix{{1.0}}}, {Matrix{{1.0}}}, {Matrix{{1.0}}, Matrix{{-1.0}}}})};
  PathNode left;
};

TEST(OverlooksCollision, SeesThatAPairHasBecomeReal) {
  Ends ends;
  EXPECT_TRUE(overlooks_collision(ends.step(0.6, 0.9), {}));
  EXPECT_TRUE(overlooks_collision(ends.step(0.9, 0.6), {}));
}

TEST(OverlooksCollision, HasNothingToSayWhereThePairStaysWhatItIs) {
  Ends ends;
  EXPECT_FALSE(overlooks_collision(ends.step(0.5, 0.7), {}));
  EXPECT_FALSE(overlooks_collision(ends.step(0.8, 0.9), {}));
}

TEST(OverlooksCollision, LeavesOutWhatMeetsAtTheEnd) {
  Ends ends;
  Step step = ends.step(0.6, 0.9);
  step.meeting = {0};
  EXPECT_FALSE(overlooks_collision(step, {}));
}

/// At the collision, rounding decides whether the two are real.
TEST(OverlooksCollision, LeavesOutWhatCannotBeToldApart) {
  Ends ends;
  EXPECT_FALSE(overlooks_collision(ends.step(0.6, 0.75), {}));
  EXPECT_FALSE(overlooks_collision(ends.step(0.6, 0.75 + 1e-15), {}));
  EXPECT_TRUE(overlooks_collision(ends.step(0.6, 0.75 + 1e-12), {})) << "1e-6 apart";
  // Entries with errors of a hundred times as much as their size gives, as where large ones cancel.
  Step step = ends.step(0.6, 0.75 + 1e-12);
  step.right.tracks[0].pair.rounding = 1e-13;
  EXPECT_FALSE(overlooks_collision(step, {}));
}

}  // namespace
}  // namespace eigentrail::test::overlooked_collision_test
