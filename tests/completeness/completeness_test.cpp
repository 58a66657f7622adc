// Random families: no flutter, divergence or real collision missing or invented.
#include <gtest/gtest.h>

#include <string>

#include "completeness/discrepancies.hpp"
#include "completeness/few_modes.hpp"

namespace eigentrail::test::completeness_test {
namespace {

class RandomFamilyTrace : public testing::TestWithParam<int> {};

TEST_P(RandomFamilyTrace, HasAllEventsOfTheReference) {
  const RandomFamily family = random_family(static_cast<std::uint64_t>(GetParam()));
  const CompletenessReport report = check_completeness(family);
  SCOPED_TRACE(std::string(name_of(family.kind)) + ", " + std::to_string(family.size()) + " coordinates");
  EXPECT_TRUE(report.discrepancies.empty()) << report.problems();
  EXPECT_TRUE(report.reference.doubts.empty()) << report.problems();
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomFamilyTrace, testing::Range(1, 35),
                         [](const auto& tested) { return "seed_" + std::to_string(tested.param); });

/// Steps towards a collision of two modes, which were followed one by one, shorter than the distance at which
/// places are the same; a second collision of the two is 7e-6 away.
TEST(RandomFamilies, HaveCollisionsBesideWhichStepsAreShort) {
  const CompletenessReport report = check_completeness(random_family(953));
  EXPECT_TRUE(report.passed()) << report.problems();
}

/// Proportional damping a M + b K: where a(p) b = 1, all overdamped modes pass through s = -1/b. Such a fan
/// is neither a collision of all, nor of those of which one is at their mean.
TEST(RandomFamilies, HaveNoCollisionOfAllOverdampedModes) {
  for (const bool reversed : {false, true}) {
    const CompletenessReport report = check_completeness(random_family(603), reversed);
    EXPECT_TRUE(report.passed()) << report.problems();
  }
}

/// A pair meets the real axis while it is followed together with another one. Rounding tells which of the
/// other two eigenvalues, conjugates of each other, is close to it: they stay, or go, together.
TEST(RandomFamilies, HaveAPairOnTheAxisBesideAnotherPair) {
  const CompletenessReport report = check_completeness(random_family(184));
  EXPECT_TRUE(report.passed()) << report.problems();
}

/// The slowest two or three modes of a family, of up to thirty: modes that nobody follows meet them.
class FewModesOfRandomFamily : public testing::TestWithParam<int> {};

TEST_P(FewModesOfRandomFamily, HaveTheEventsOfATraceOfAll) {
  for (const std::string& problem : check_few_modes(random_family(GetParam()), {2, 3, 4}).problems)
    ADD_FAILURE() << problem;
}

INSTANTIATE_TEST_SUITE_P(Seeds, FewModesOfRandomFamily,
                         testing::Values(6, 14, 19, 28, 97, 98, 119, 150, 176, 183, 209, 322, 337, 357),
                         [](const auto& tested) { return "seed_" + std::to_string(tested.param); });

}  // namespace
}  // namespace eigentrail::test::completeness_test
