#include "continuation/tracks/completeness.hpp"

#include <gtest/gtest.h>

#include "eigentrail/continuation/point_modes.hpp"
#include "eigentrail/modes/regroup.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::completeness_test {
namespace {

Setting family(const std::string& stiffness) {
  return make_setting(
      "[trace]\nparameter = \"p\"\nfrom = 0\nto = 1\n[matrix_family]\n"
      "M = [ [[1, 0, 0], [0, 1, 0], [0, 0, 1]] ]\nK = [ " +
      stiffness + ", [[1, 0, 0], [0, 2, 0], [0, 0, 3]] ]\n");
}

struct Tracked {
  explicit Tracked(const std::string& stiffness) : setting(family(stiffness)), problem(setting.problem()) {
    node = differentiate_point(problem, point_from_guess(problem, 0.0, counts), counts).value();
  }
  bool is_doubtful() const { return has_doubtful_track(node, problem); }

  Setting setting;
  PathProblem problem;
  RunCounts counts;
  PathNode node;
};

const std::string coupled = "[[4, 1, 0], [1, 6, 1], [0, 1, 9]]";

TEST(DoubtfulTrack, SameEigenpairTwiceIs) {
  Tracked tracked(coupled);
  // The same eigenvector times a complex factor.
  tracked.node.tracks.push_back(tracked.node.tracks[1]);
  tracked.node.tracks.back().pair.Z *= Complex(0.6, 0.8);
  EXPECT_TRUE(tracked.is_doubtful());
}

/// Beside an exceptional point rounding moves an eigenvalue by much more than that of simple ones.
TEST(Followed, IsAnEigenvalueThatDiffersByItsRounding) {
  const Tracked tracked(coupled);
  Track again = tracked.node.tracks[1];
  again.roots[0] += 1e-6;
  again.pair.Lambda(0, 0) += 1e-6;
  EXPECT_FALSE(is_followed(tracked.problem, tracked.node, again));
  again.pair.rounding = 1e-5;
  EXPECT_TRUE(is_followed(tracked.problem, tracked.node, again));
  again.pair.Z = tracked.node.tracks[0].pair.Z;
  EXPECT_FALSE(is_followed(tracked.problem, tracked.node, again));
}

/// One conjugate beside the other is the same mode, of which the first track stays.
TEST(Conjugates, AreOneMode) {
  Tracked tracked(coupled);
  for (std::size_t i = 0; i < tracked.node.tracks.size(); ++i)
    tracked.node.tracks[i].modes = {static_cast<int>(i)};
  const std::vector<Track> own = tracked.node.tracks;
  Track conjugate = own[1];
  conjugate.pair.Z = (Complex(0.6, 0.8) * conjugate.pair.Z).conjugate();
  conjugate.pair.Lambda = conjugate.pair.Lambda.conjugate().eval();
  conjugate.roots = conjugate.roots.conjugate().eval();
  conjugate.modes = {7};
  tracked.node.tracks.push_back(conjugate);
  ModeNumbers numbers;
  numbers.count = 8;
  const Completion found = complete(tracked.problem, true, tracked.node, numbers, tracked.counts);
  ASSERT_EQ(found.pairs.size(), 1u);
  EXPECT_EQ(found.pairs[0].kept, own[1].modes[0]);
  EXPECT_EQ(found.pairs[0].ended, 7);
  EXPECT_EQ(found.added, 0);
  EXPECT_FALSE(found.doubtful);
  EXPECT_EQ(tracked.node.tracks.size(), own.size());
}

TEST(Conjugates, OfOthersAreNone) {
  Tracked tracked(coupled);
  for (Track& track : tracked.node.tracks) track.modes = {0};
  ModeNumbers numbers;
  EXPECT_TRUE(complete(tracked.problem, true, tracked.node, numbers, tracked.counts).pairs.empty());
}

TEST(DoubtfulTrack, OneEigenvalueWithTwoVectorsIsNot) {
  EXPECT_FALSE(Tracked("[[4, 0, 0], [0, 4, 0], [0, 0, 9]]").is_doubtful());
}

TEST(DoubtfulTrack, MemberOfABlockIs) {
  Tracked tracked(coupled);
  std::vector<Track>& tracks = tracked.node.tracks;
  const InvariantPair both = join_pairs({&tracks[0].pair, &tracks[1].pair}, false);
  InvariantPair block =
      correct_pair(PencilAtPoint(tracked.node.pencil), both, tracked.problem.s_ref, {}, tracked.counts.modes);
  ASSERT_EQ(block.status, PairStatus::converged);
  const Track joined = differentiate_track(tracked.problem, tracked.node, std::move(block), tracked.counts);
  const Track single = tracks[1];
  tracks = {tracks[2], joined};
  EXPECT_FALSE(tracked.is_doubtful());
  // In both orders of the tracks.
  tracks = {joined, single};
  EXPECT_TRUE(tracked.is_doubtful());
  tracks = {single, joined};
  EXPECT_TRUE(tracked.is_doubtful());
}

TEST(DoubtfulTrack, OneThatSolvesThePencilNoLongerIs) {
  Tracked tracked(coupled);
  tracked.node.tracks[2].pair.backward_error = 1e-7;
  EXPECT_TRUE(tracked.is_doubtful());
}

}  // namespace
}  // namespace eigentrail::test::completeness_test
