// Which modes are followed together because their exceptional points limit the step.
#include "continuation/tracks/joining.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/planted_search.hpp"
#include "continuation/step/step_error.hpp"

namespace eigentrail::test::joining_test {
namespace {

/// Frequencies 2 -+ hypot(p, eps), and 5.
struct Veering {
  explicit Veering(double half_width)
      : eps(half_width),
        planted(Planted::frequencies({Matrix{{2.0, half_width, 0.0}, {half_width, 2.0, 0.0}, {0.0, 0.0, 5.0}},
                                      Matrix{{1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, {0.0, 0.0, 0.0}}})) {}
  std::vector<Together> modes(double p) const {
    const double half = std::hypot(p, eps);
    return alone({(2.0 - half) * j, (2.0 + half) * j, 5.0 * j});
  }
  Step step(double from, double to) {
    left = planted.family.point(from, modes(from));
    return planted.step(left, to, modes(to));
  }
  double eps;
  PlantedSearch planted;
  PathNode left;
};

TEST(HelpfulPartners, AreThoseWithWhichTheErrorFalls) {
  Veering veering(0.02);
  const Step step = veering.step(-0.08, 0.06);
  const JoiningRules rules{1e-8, 3.0, 0.14};
  const double error = track_error(veering.planted.family.problem(), rules.tolerance, 0.0, step, 0);
  ASSERT_GT(error, 1.0);
  const auto candidates = find_partners(step.right, 0, 0.1, rules.parting_reach);
  const auto chosen = helpful_partners(veering.planted.family.problem(), rules, step, 0, error, candidates);
  ASSERT_EQ(chosen.size(), 1U);
  EXPECT_EQ(chosen[0].track, 1U);
}

TEST(HelpfulPartners, AreNoneWhereABlockIsNotBetter) {
  Veering veering(0.02);
  const Step step = veering.step(-0.08, 0.06);
  const JoiningRules rules{1e-8, 3.0, 0.14};
  // The third mode has nothing to do with the error of the first.
  const auto chosen =
      helpful_partners(veering.planted.family.problem(), rules, step, 0, 10.0, {{false, 2, 0.1}});
  EXPECT_TRUE(chosen.empty());
  EXPECT_TRUE(helpful_partners(veering.planted.family.problem(), rules, step, 0, 10.0, {}).empty());
}

TEST(HelpfulPartners, AreNotThoseThatTheStepDoesNotBeginWith) {
  Veering veering(0.02);
  Step step = veering.step(-0.08, 0.06);
  const JoiningRules rules{1e-8, 3.0, 0.14};
  step.right.tracks.push_back(
      step.right.tracks[1]);  // was added at the right end, out of range at the left one
  EXPECT_TRUE(
      helpful_partners(veering.planted.family.problem(), rules, step, 0, 1e3, {{false, 3, 0.1}}).empty());
  PathNode left = *step.left;
  step.left = &left;
  left.tracks[1].lineage = 7;  // ended on the step, and another one has its place
  EXPECT_TRUE(
      helpful_partners(veering.planted.family.problem(), rules, step, 0, 1e3, {{false, 1, 0.1}}).empty());
}

TEST(RegroupLimitingModes, JoinsWhatLimitsTheSteps) {
  Veering veering(0.02);
  Step step = veering.step(-0.08, -0.03);
  const JoiningRules rules{1e-9, 3.0, 0.05};
  PathNode left = *step.left;
  step.left = &left;
  for (std::size_t i = 0; i < step.right.tracks.size(); ++i)
    left.tracks[i].lineage = step.right.tracks[i].lineage = i + 1;
  const Regroupings done = regroup_limiting_modes(veering.planted.family.problem(), rules, step, 0.05,
                                                  veering.planted.family.counts);
  EXPECT_EQ(done.joined, 1);
  ASSERT_EQ(step.right.tracks.size(), 2U);
  EXPECT_EQ(step.right.tracks[1].size(), 2);
}

TEST(RegroupLimitingModes, LeavesAccurateModesAlone) {
  Veering veering(0.5);
  Step step = veering.step(-0.08, -0.07);
  const Regroupings done = regroup_limiting_modes(veering.planted.family.problem(), {1e-6, 3.0, 0.01}, step,
                                                  0.01, veering.planted.family.counts);
  EXPECT_EQ(done.joined + done.charts, 0);
  EXPECT_EQ(step.right.tracks.size(), 3U);
}

}  // namespace
}  // namespace eigentrail::test::joining_test
