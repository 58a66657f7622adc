// Fifty families with planted special points, traced: every value, every event, every label.
#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <string>

#include "properties/run_family.hpp"

namespace eigentrail::test {
namespace {

/// Seeds of which something does not hold yet; never a certified label. They run all the same, and the test
/// fails when one of them starts to pass, so that it is taken off the list.
const std::map<int, std::string>& open_seeds() {
  static const std::map<int, std::string> seeds{
      {11, "reports a collision twice, as a veering of half-width 1e-12 as well"},
      {7, "stalls where two real roots come close and a crossing lies beside them"},
  };
  return seeds;
}

class PlantedFamilyTrace : public testing::TestWithParam<int> {};

TEST_P(PlantedFamilyTrace, HasExactValuesEventsAndLabels) {
  const auto seed = static_cast<std::uint64_t>(GetParam());
  const PlantedFamily family = planted_family(seed);
  const FamilyReport report = run_family(family, setting_of(seed));
  EXPECT_GT(report.labels.labels, 100);
  EXPECT_EQ(report.labels.wrong, 0) << report.problems() << "\n" << family.description();
  const auto open = open_seeds().find(GetParam());
  if (open == open_seeds().end()) {
    EXPECT_TRUE(report.passed()) << report.problems() << "\n" << family.description();
  } else {
    EXPECT_FALSE(report.passed()) << "passes now; take it off the list of open seeds: " << open->second;
    std::printf("open: %s: %s\n", open->second.c_str(), report.problems().c_str());
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, PlantedFamilyTrace, testing::Range(1, 51),
                         [](const auto& tested) { return "seed_" + std::to_string(tested.param); });

/// Regression test: two crossings of one pair are so close that the second one was missed, and labels behind
/// it were exchanged.
INSTANTIATE_TEST_SUITE_P(CloseCrossings, PlantedFamilyTrace, testing::Values(263, 637, 659),
                         [](const auto& tested) { return "seed_" + std::to_string(tested.param); });

}  // namespace
}  // namespace eigentrail::test
