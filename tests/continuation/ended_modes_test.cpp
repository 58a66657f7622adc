// Modes that end, and are found again.
#include "continuation/tracks/ended_modes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "continuation/planted_search.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::ended_modes_test {
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

/// Two freedoms with mass, and one without whose stiffness p passes zero: s runs to infinity like 1 /
/// sqrt(p).
TraceResult through_infinity(const std::string& from, const std::string& to, ComplexVector& at_the_end) {
  const RecordedTrace trace = record_trace(make_setting(R"([trace]
parameter = "p"
from = )" + from + "\nto = " + to + R"(
[matrix_family]
M = [[[1, 0, 0], [0, 1, 0], [0, 0, 0]]]
K = [[[1, 0.1, 0.3], [0.1, 4, 0.2], [0.3, 0.2, 0]], [[0, 0, 0], [0, 0, 0], [0, 0, 1]]]
)"));
  at_the_end = trace.eigenvalues_of_node(trace.nodes.size() - 1);
  return trace.result;
}

/// The magnitudes at which a mode ends, and is added again, are shares of the largest one at the start: this
/// varies them by a factor of ten.
TEST(ModeThatRunsToInfinity, LeavesTheSameModesWhereverTheTraceBegins) {
  ComplexVector far, near;
  ASSERT_EQ(through_infinity("1", "-1", far).status, TraceStatus::completed);
  ASSERT_EQ(through_infinity("0.0003", "-1", near).status, TraceStatus::completed);
  const auto finite = [](const ComplexVector& all) {
    std::vector<double> found;
    for (const Complex s : all) {
      if (std::isfinite(s.real())) found.push_back(s.imag());
    }
    std::sort(found.begin(), found.end());
    return found;
  };
  // The unstable one: 1 - (0.3^2 + 0.2^2) / p is about the square of the largest eigenvalue.
  EXPECT_GT(std::sqrt(0.13 / 0.0003 - 1.0), 10.0 * 2.0);
  ASSERT_EQ(finite(far).size(), 2U);
  ASSERT_EQ(finite(near).size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(finite(far)[i], finite(near)[i], 1e-6);
}

}  // namespace
}  // namespace eigentrail::test::ended_modes_test
