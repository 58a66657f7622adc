// Reference labels compared with analytic branches, and errors of the usual methods (rivals.hpp) on hard
// cases.
#include "hard_cases/rivals.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hard_cases/reference_labels.hpp"

namespace eigentrail::test::rivals_test {
namespace {

class ReferenceLabels : public testing::TestWithParam<HardCase> {};

TEST_P(ReferenceLabels, ReachEveryCoincidence) {
  const auto stretches = reference_labels(GetParam());
  EXPECT_FALSE(stretches.empty());
  for (const LabelledStretch& stretch : stretches) EXPECT_TRUE(stretch.complete()) << stretch.reason();
}

TEST_P(ReferenceLabels, FollowTheAnalyticBranches) {
  if (!GetParam().has_branches) return;
  const auto distance = [](Complex s, Complex mode) {
    return std::min(std::abs(s - mode), std::abs(s - std::conj(mode))) / std::max(std::abs(mode), 1e-12);
  };
  for (const LabelledStretch& stretch : reference_labels(GetParam())) {
    std::vector<std::size_t> branch_of;
    for (int k = 0; k <= 40; ++k) {
      const double p = stretch.low() + (stretch.high() - stretch.low()) * (k + 0.5) / 41.5;
      const auto modes = stretch(p);
      ASSERT_EQ(modes.size(), GetParam().branches.size());
      for (std::size_t i = 0; i < modes.size(); ++i) {
        if (k == 0) {
          std::vector<double> misses;
          for (const auto& branch : GetParam().branches) misses.push_back(distance(modes[i], branch(p)));
          branch_of.push_back(
              static_cast<std::size_t>(std::min_element(misses.begin(), misses.end()) - misses.begin()));
        }
        EXPECT_LT(distance(modes[i], GetParam().branches[branch_of[i]](p)), 1e-12) << "at " << p;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, ReferenceLabels, testing::ValuesIn(hard_cases()),
                         [](const auto& tested) { return tested.param.name; });

TEST(ReferenceLabelsOutside, AreRefused) {
  const auto stretches = reference_labels(hard_case("H01_veering_1em4"));
  ASSERT_EQ(stretches.size(), 1U);
  EXPECT_THROW((void)stretches[0](0.6), std::out_of_range);
}

int wrong_tracks(const std::string& name, int n_points, Carrier carrier) {
  const HardCase& c = hard_case(name);
  const GridLoci loci = loci_on_grid(c, n_points, carrier);
  EXPECT_TRUE(loci.completed) << loci.message;
  return count_wrong_tracks(c, loci);
}

constexpr Carrier carriers[] = {Carrier::nearest, Carrier::assignment, Carrier::assurance};

TEST(Rivals, AreRightWhereModesAreFarApart) {
  for (const Carrier carrier : carriers) EXPECT_EQ(wrong_tracks("C07_rod_twice", 50, carrier), 0);
}

// 100 points leave the meeting at p = 0 in the middle of a step.
TEST(Rivals, VectorsTakeAVeeringForACrossing) {
  EXPECT_EQ(wrong_tracks("H01_veering_1em9", 100, Carrier::nearest), 0);
  EXPECT_EQ(wrong_tracks("H01_veering_1em9", 100, Carrier::assignment), 0);
  EXPECT_EQ(wrong_tracks("H01_veering_1em9", 100, Carrier::assurance), 2);
}

TEST(Rivals, DistancesTakeACrossingForAVeering) {
  EXPECT_EQ(wrong_tracks("H03_hidden_crossing", 100, Carrier::nearest), 2);
  EXPECT_EQ(wrong_tracks("H03_hidden_crossing", 100, Carrier::assignment), 2);
  EXPECT_EQ(wrong_tracks("H03_hidden_crossing", 100, Carrier::assurance), 0);
}

TEST(Rivals, MislabelARotorOnFourHundredPoints) {
  EXPECT_GT(wrong_tracks("rotor_12", 400, Carrier::nearest), 0);
  EXPECT_GT(wrong_tracks("rotor_12", 400, Carrier::assurance), 0);
}

TEST(Rivals, ReportWhereTheEquilibriumEnds) {
  EXPECT_FALSE(loci_on_grid(hard_case("C05_pushed_pendulum"), 60, Carrier::assurance).completed);
}

}  // namespace
}  // namespace eigentrail::test::rivals_test
