// Sets of modes, and members of a block.
#include "continuation/tracks/members.hpp"

#include <gtest/gtest.h>

#include "continuation/planted_points.hpp"

namespace eigentrail::test::members_test {
namespace {

using Modes = std::vector<int>;

TEST(SortedModes, AreAscendingAndEachThereOnce) {
  EXPECT_EQ(sorted_modes({3, 0, 3, 1, 0}), (Modes{0, 1, 3}));
}

TEST(SortedModes, LeaveOutConjugatesAndGuards) {
  EXPECT_EQ(sorted_modes({2, Track::no_mode, 1, Track::guard}), (Modes{1, 2}));
  EXPECT_TRUE(sorted_modes({Track::no_mode, Track::guard}).empty());
  EXPECT_TRUE(sorted_modes({}).empty());
}

TEST(United, HasWhatEitherHasOnce) {
  EXPECT_EQ(united({0, 2, 5}, {1, 2, 7}), (Modes{0, 1, 2, 5, 7}));
  EXPECT_EQ(united({}, {1}), (Modes{1}));
  EXPECT_EQ(united({1}, {}), (Modes{1}));
  EXPECT_TRUE(united({}, {}).empty());
}

class PointOfFour : public testing::Test {
 protected:
  Planted family = Planted::frequencies(uncoupled(Matrix{{1.0, 0.1}, {1.3, 0.2}, {1.8, 0.3}, {4.0, 0.4}}));
  PathNode node = family.point(0.0, {{{1.0 * j}}, {{1.8 * j, 1.3 * j}}, {{4.0 * j}}});
};

TEST_F(PointOfFour, MembersAreNamedByTheirIndicesInTheBlock) {
  const std::vector<Complex> both = roots_of(node.tracks[1], {1, 0});
  ASSERT_EQ(both.size(), 2U);
  EXPECT_EQ(both[0], node.tracks[1].roots[1]);
  EXPECT_EQ(both[1], node.tracks[1].roots[0]);
  EXPECT_TRUE(roots_of(node.tracks[1], {}).empty());
}

}  // namespace
}  // namespace eigentrail::test::members_test
