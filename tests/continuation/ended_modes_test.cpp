// Modes that end, and are found again.
#include "continuation/tracks/ended_modes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/planted_search.hpp"

namespace eigentrail::test {
namespace {

std::vector<Complex> on_lines(double p) {
  return {(2.0 + p) * j, (2.6 - p) * j, 5.0 * j};
}

struct Lines {
  Lines()
      : planted(Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.6, -1.0}, {5.0, 0.0}}))),
        node(planted.family.point(0.0, alone(on_lines(0.0)))) {
    text = end_track(planted.family.problem(), node, 1, ended);
  }
  /// The other two modes at p.
  PathNode others(double p) {
    const std::vector<Complex> s = on_lines(p);
    PathNode there = planted.family.point(p, alone({s[0], s[2]}));
    there.tracks[1].modes = {2};
    return there;
  }
  std::vector<std::string> look(PathNode& there) {
    return find_again(planted.family.problem(), there, ended, planted.family.counts);
  }
  PlantedSearch planted;
  PathNode node;
  std::vector<EndedTrack> ended;
  std::string text;
};

TEST(EndTrack, LeavesTheOthersAndSaysWhichItWas) {
  Lines lines;
  EXPECT_EQ(lines.node.tracks.size(), 2U);
  EXPECT_EQ(lines.ended.size(), 1U);
  EXPECT_NE(lines.text.find("mode 2 (s = "), std::string::npos) << lines.text;
  EXPECT_NE(lines.text.find("2.6j"), std::string::npos) << lines.text;
}

TEST(FindAgain, GivesTheModeItsNumberBack) {
  Lines lines;
  PathNode there = lines.others(0.05);
  EXPECT_EQ(lines.look(there).size(), 1U);
  EXPECT_TRUE(lines.ended.empty());
  ASSERT_EQ(there.tracks.size(), 3U);
  EXPECT_EQ(there.tracks[2].modes, std::vector<int>{1});
  EXPECT_EQ(there.tracks[2].arriving, std::vector<int>{1});
  EXPECT_LT(std::abs(there.tracks[2].roots[0] - 2.55 * j), 1e-10);
  EXPECT_LT(std::abs(there.tracks[2].functions(0, 1) + j), 1e-9) << "with its series";
}

/// The mode is followed already, under another number.
TEST(FindAgain, DoesNotAddWhatAnotherTrackHas) {
  Lines lines;
  PathNode there = lines.planted.family.point(0.05, alone(on_lines(0.05)));
  EXPECT_TRUE(lines.look(there).empty());
  EXPECT_EQ(there.tracks.size(), 3U);
}

/// Where the shape is another one it is not the same mode, and after some points it is no longer looked for.
TEST(FindAgain, GivesUp) {
  Lines lines;
  lines.ended[0].track.series.Z[0].setConstant(1.0);
  lines.ended[0].track.pair.Z.setConstant(1.0);
  for (int i = 0; i < 100 && !lines.ended.empty(); ++i) {
    PathNode there = lines.others(0.05);
    EXPECT_TRUE(lines.look(there).empty());
    EXPECT_EQ(there.tracks.size(), 2U);
  }
  EXPECT_TRUE(lines.ended.empty());
}

}  // namespace
}  // namespace eigentrail::test
