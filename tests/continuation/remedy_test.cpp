// Remedies for rejected steps other than shorter ones.
#include "continuation/tracks/joining.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/planted_search.hpp"

namespace eigentrail::test::remedy_test {
namespace {

using Kind = Verdict::Kind;

/// Frequencies 2 + p, 2.2 - p (they cross at 0.1), 2.9 and 5; all or some are followed.
struct Lines {
  explicit Lines(const std::vector<Complex>& followed)
      : planted(Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.2, -1.0}, {2.9, 0.0}, {5.0, 0.0}}))),
        node(planted.family.point(0.0, alone(followed))) {
    for (Track& track : node.tracks) track.arriving = track.modes;
  }
  Remedy remedy(Kind kind, double h, Shorter shorter = Shorter::may_help, bool may_join = true) {
    rules.longest_step = 10.0 * std::abs(h);
    return find_remedy(planted.family.problem(), planted.frame, rules, {kind, 0, 1e-3, ""}, h, nullptr,
                       may_join, shorter, node, planted.family.counts);
  }
  PlantedSearch planted;
  JoiningRules rules;
  PathNode node;
};
const std::vector<Complex> all{2.0 * j, 2.2 * j, 2.9 * j, 5.0 * j};

TEST(FindRemedy, JoinsALostModeWithTheOneItMeets) {
  Lines lines(all);
  const Remedy remedy = lines.remedy(Kind::mode_lost, 0.15);
  EXPECT_EQ(remedy.changes.joined, 1);
  ASSERT_EQ(lines.node.tracks.size(), 3U);
  EXPECT_EQ(lines.node.tracks.back().modes, (std::vector<int>{0, 1}));
}

TEST(FindRemedy, DoesNothingWhereNothingIsMet) {
  Lines lines(all);
  EXPECT_FALSE(lines.remedy(Kind::mode_lost, 0.01).helps());
  EXPECT_FALSE(lines.remedy(Kind::no_equilibrium, 0.15).helps());
  EXPECT_FALSE(lines.remedy(Kind::mode_lost, 0.15, Shorter::may_help, false).helps()) << "may not join";
  EXPECT_EQ(lines.node.tracks.size(), 4U);
}

/// The certificate fails on every step: the nearest mode is taken along, and stays.
TEST(FindRemedy, KeepsANeighbourWithWhatCannotBeCertified) {
  Lines lines(all);
  EXPECT_FALSE(lines.remedy(Kind::uncertified, 0.001).helps());
  EXPECT_EQ(lines.remedy(Kind::uncertified, 0.001, Shorter::in_vain).changes.joined, 1);
  const Track& block = lines.node.tracks.back();
  EXPECT_EQ(block.modes, (std::vector<int>{0, 1}));
  EXPECT_GT(block.inseparable, 0.2);
  EXPECT_LT(block.inseparable, 1.0);
  // Formed at this point, without effect: it is not made larger here.
  const std::size_t last = lines.node.tracks.size() - 1;
  const Remedy again = find_remedy(lines.planted.family.problem(), lines.planted.frame, lines.rules,
                                   {Kind::uncertified, static_cast<int>(last), 1e-3, ""}, 0.001, nullptr,
                                   true, Shorter::in_vain, lines.node, lines.planted.family.counts);
  EXPECT_FALSE(again.helps());
}

/// Of a mode that is not followed: it becomes a guard mode.
TEST(FindRemedy, JoinsAModeWithAnUnfollowedOneThatItMeets) {
  Lines lines({2.0 * j, 5.0 * j});
  lines.rules.follows_all = false;
  const Remedy remedy = lines.remedy(Kind::mode_lost, 0.15);
  EXPECT_EQ(remedy.changes.joined, 1);
  ASSERT_EQ(lines.node.tracks.size(), 2U) << "other neighbours are dropped again";
  const Track& block = lines.node.tracks.back();
  ASSERT_EQ(block.size(), 2);
  EXPECT_EQ(block.modes, (std::vector<int>{0, Track::guard}));
  EXPECT_LT(std::abs(block.roots[1] - 2.2 * j), 1e-10);
}

TEST(FindRemedy, DoesNotLookForUnfollowedModesWhereAllAreFollowed) {
  Lines lines({2.0 * j, 5.0 * j});
  EXPECT_FALSE(lines.remedy(Kind::mode_lost, 0.15).helps());
}

}  // namespace
}  // namespace eigentrail::test::remedy_test
