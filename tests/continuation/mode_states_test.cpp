// The modes at a point as they are handed out: eigenvalues, slopes and shapes against closed forms.
#include "continuation/tracks/mode_copies.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/planted_search.hpp"

namespace eigentrail::test::mode_states_test {
namespace {

const ModeState& of_mode(const std::vector<ModeState>& states, int mode) {
  return *std::find_if(states.begin(), states.end(), [mode](const ModeState& s) { return s.mode == mode; });
}

TEST(ModeStates, OfSingleModesAndBlocksAreAlike) {
  const Matrix w{{2.0, 1.0}, {2.6, -1.0}, {5.0, 0.5}};
  for (const auto& tracks :
       {alone({2.0 * j, 2.6 * j, 5.0 * j}), std::vector<Together>{{{2.0 * j, 2.6 * j, 5.0 * j}}}}) {
    Planted family = Planted::frequencies(uncoupled(w));
    PathNode node = family.point(0.0, tracks);
    for (Track& track : node.tracks) track.arriving = track.modes;
    const auto states = mode_states(node, family.problem().traced);
    ASSERT_EQ(states.size(), 3U);
    for (int mode = 0; mode < 3; ++mode) {
      const ModeState& state = of_mode(states, mode);
      EXPECT_LT(std::abs(state.s - w(mode, 0) * j), 1e-12);
      EXPECT_LT(std::abs(state.slope - w(mode, 1) * j), 1e-10);
      EXPECT_GT(std::abs(state.shape[mode]), 1e6 * std::abs(state.shape[(mode + 1) % 3]));
    }
  }
}

/// In the chart of 1/s, s and ds/dp are the same.
TEST(ModeStates, DoNotDependOnTheChart) {
  Planted family = Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}}));
  PathNode node = family.point(0.0, {{{2.0 * j}, Chart::reciprocal}});
  node.tracks[0].arriving = node.tracks[0].modes;
  const auto states = mode_states(node, family.problem().traced);
  EXPECT_LT(std::abs(states[0].s - 2.0 * j), 1e-12);
  EXPECT_LT(std::abs(states[0].slope - j), 1e-11);
}

TEST(ModeStates, HaveNoSlopeWhereEigenvaluesCoincide) {
  Planted family = Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.0, -1.0}}));
  PathNode node = family.point(0.0, {{{2.0 * j, 2.0 * j}}});
  node.tracks[0].arriving = node.tracks[0].modes;
  for (const ModeState& state : mode_states(node, family.problem().traced))
    EXPECT_TRUE(std::isnan(state.slope.imag()));
}

TEST(ModeStates, IncludeModesThatEndOrBeginThere) {
  Planted family = Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.6, -1.0}}));
  PathNode node = family.point(0.0, {{{2.0 * j, 2.6 * j}}});
  node.tracks[0].arriving = {0, Track::no_mode};
  node.tracks[0].modes = {0, 4};
  const auto states = mode_states(node, family.problem().traced);
  ASSERT_EQ(states.size(), 2U);
  EXPECT_LT(std::abs(of_mode(states, 4).s - 2.6 * j), 1e-12);
}

}  // namespace
}  // namespace eigentrail::test::mode_states_test
