// Which mode is which eigenvalue of a block, before and behind a point.
#include "continuation/tracks/mode_order.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/planted_search.hpp"

namespace eigentrail::test::mode_order_test {
namespace {

using Modes = std::vector<int>;

/// Frequencies 2 + p and 2.6 - p, which cross at p = 0.3.
TEST(OrderArrival, FollowsEigenvaluesFromTheLeftEnd) {
  PlantedSearch planted(Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.6, -1.0}})));
  const PathNode left = planted.family.point(0.0, {{{2.0 * j, 2.6 * j}}});
  Step step = planted.step(left, 0.25, {{{2.35 * j, 2.25 * j}}});  // the wrong way round
  order_arrival(step);
  const Track& track = step.right.tracks[0];
  EXPECT_EQ(track.modes, (Modes{0, 1}));
  EXPECT_TRUE(track.told_apart);
  EXPECT_LT(std::abs(track.roots[0] - 2.25 * j), 1e-10);
  EXPECT_LT(std::abs(track.roots[1] - 2.35 * j), 1e-10);
}

/// On the crossing the order behind it is that of the slopes.
TEST(OrderDeparture, KeepsTheDirectionThroughACrossing) {
  PlantedSearch planted(Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.6, -1.0}})));
  const PathNode left = planted.family.point(0.0, {{{2.0 * j, 2.6 * j}}});
  Step step = planted.step(left, 0.3, {{{2.3 * j, 2.3 * j}}});
  order_arrival(step);
  ModeNumbers numbers{2};
  EXPECT_TRUE(order_departure(step, {true}, numbers, {}).empty());
  const Track& track = step.right.tracks[0];
  ASSERT_TRUE(track.departure);
  for (int i = 0; i < 2; ++i) {
    const double slope = track.modes[static_cast<std::size_t>(i)] == 0 ? 1.0 : -1.0;
    EXPECT_LT(std::abs(track.departure->roots[i] - (2.3 + slope * track.departure->distance) * j), 1e-6);
  }
}

/// A pair becomes two real modes: a mode begins. It gets the same number when that happens again.
TEST(SettleRealBlock, NumbersWhatBeginsOnTheRealAxis) {
  const auto block = [](Complex a, Complex b, Modes modes) {
    Track track;
    track.roots = ComplexVector{{a, b}};
    track.pair.is_real = true;
    track.pair.Lambda = ComplexMatrix::Identity(2, 2);
    track.modes = std::move(modes);
    return track;
  };
  ModeNumbers numbers{5};
  Track apart = block(-1.0, -2.0, {3, Track::no_mode});
  const std::vector<Birth> births = settle_real_block(apart, apart.modes, numbers);
  ASSERT_EQ(births.size(), 1U);
  EXPECT_EQ(births[0].parent, 3);
  EXPECT_EQ(births[0].born, 5);
  EXPECT_EQ(numbers.count, 6);
  EXPECT_EQ(apart.modes, (Modes{3, 5}));
  Track pair = block({-1.5, 0.5}, {-1.5, -0.5}, {3, 5});
  EXPECT_TRUE(settle_real_block(pair, pair.modes, numbers).empty());
  EXPECT_EQ(std::count(pair.modes.begin(), pair.modes.end(), Track::no_mode), 1);
  const int left_over = *std::max_element(pair.modes.begin(), pair.modes.end());
  Track again = block(-1.2, -1.8, {left_over, Track::no_mode});
  settle_real_block(again, again.modes, numbers);
  std::sort(again.modes.begin(), again.modes.end());
  EXPECT_EQ(again.modes, (Modes{3, 5})) << "the same numbers as before";
  EXPECT_EQ(numbers.count, 6);
}

TEST(SettleRealBlock, LeavesGuardsAlone) {
  Track track;
  track.roots = ComplexVector{{-1.0, -2.0}};
  track.pair.is_real = true;
  track.pair.Lambda = ComplexMatrix::Identity(2, 2);
  track.modes = {0, Track::guard};
  ModeNumbers numbers{1};
  EXPECT_TRUE(settle_real_block(track, track.modes, numbers).empty());
  EXPECT_EQ(track.modes, (Modes{0, Track::guard}));
}

/// Modes 3 and 5 were a pair. Then 3 meets an eigenvalue that nobody follows, while 5 goes on elsewhere:
/// behind that pair a new mode begins, and no second mode 5.
TEST(SettleRealBlock, NeverGivesANumberThatIsInUse) {
  Track track;
  track.pair.is_real = true;
  track.pair.Lambda = ComplexMatrix::Identity(2, 2);
  for (const bool meets_a_guard : {true, false}) {
    ModeNumbers numbers{6, {{3, 5}, {5, 3}}};
    if (meets_a_guard) {
      track.roots = ComplexVector{{Complex(-1.5, 0.5), Complex(-1.5, -0.5)}};
      track.modes = {3, Track::guard};
      EXPECT_TRUE(settle_real_block(track, {3, 5}, numbers).empty());
      EXPECT_EQ(track.modes, (Modes{3, Track::no_mode}));
      EXPECT_TRUE(numbers.partners.empty());
    }
    track.roots = ComplexVector{{-1.0, -2.0}};
    track.modes = {3, Track::no_mode};
    const std::vector<Birth> births = settle_real_block(track, {3, 5}, numbers);
    ASSERT_EQ(births.size(), 1U);
    EXPECT_EQ(births[0].born, 6);
    EXPECT_EQ(track.modes, (Modes{3, 6}));
  }
}

}  // namespace
}  // namespace eigentrail::test::mode_order_test
