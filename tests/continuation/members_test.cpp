// Sets of modes.
#include "continuation/tracks/members.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace eigentrail::test::members_test
