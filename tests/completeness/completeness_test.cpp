// Random families: no flutter, divergence, real collision or narrow veering missing or invented.
#include <gtest/gtest.h>

#include <string>

#include "completeness/discrepancies.hpp"
#include "completeness/exceptional_points.hpp"
#include "completeness/few_modes.hpp"
#include "support/seeds.hpp"

namespace eigentrail::test::completeness_test {
namespace {

class OfRandomFamily : public testing::TestWithParam<int> {
 protected:
  const RandomFamily family_ = random_family(static_cast<std::uint64_t>(GetParam()));

  void expect_none(const std::vector<std::string>& problems) const {
    for (const std::string& problem : problems) ADD_FAILURE() << problem;
    if (!problems.empty()) ADD_FAILURE() << name_of(family_.kind) << "\n" << family_.scene();
  }
};

class RandomFamilyTrace : public OfRandomFamily {};

TEST_P(RandomFamilyTrace, HasAllEventsOfTheReferenceInBothDirections) {
  expect_none(check_completeness(family_));
}

/// 953: Steps towards a collision of two modes, which were followed one by one, shorter than the distance at
/// which places are the same; a second collision of the two is 7e-6 away.
/// 603: Proportional damping a M + b K: where a(p) b = 1, all overdamped modes pass through s = -1/b. Such a
/// fan is neither a collision of all, nor of those of which one is at their mean.
/// 184: A pair meets the real axis while it is followed together with another one. Rounding tells which of
/// the other two eigenvalues, conjugates of each other, is close to it: they stay, or go, together.
INSTANTIATE_TEST_SUITE_P(Hard, RandomFamilyTrace, testing::Values(953, 603, 184), seed_name);
INSTANTIATE_TEST_SUITE_P(Seeds, RandomFamilyTrace, first_seeds(34), seed_name);

class NarrowVeerings : public OfRandomFamily {};

TEST_P(NarrowVeerings, AreThoseOfASearchAtComplexParameters) {
  const VeeringComparison found =
      compare_veerings(family_.matrices, family_.from, family_.to, trace_family(family_).result.events);
  expect_none(found.missing);
  expect_none(found.invented);
}

INSTANTIATE_TEST_SUITE_P(Seeds, NarrowVeerings, first_seeds(3), seed_name);

/// The slowest two to four modes of a family, of up to thirty: modes that nobody follows meet them.
class FewModesOfRandomFamily : public OfRandomFamily {};

TEST_P(FewModesOfRandomFamily, HaveTheEventsOfATraceOfAll) {
  expect_none(check_few_modes(family_, {2, 3, 4}));
}

INSTANTIATE_TEST_SUITE_P(Hard, FewModesOfRandomFamily,
                         testing::Values(6, 14, 19, 28, 97, 98, 119, 150, 176, 183, 209, 322, 337, 357),
                         seed_name);
INSTANTIATE_TEST_SUITE_P(Seeds, FewModesOfRandomFamily, first_seeds(3), seed_name);

}  // namespace
}  // namespace eigentrail::test::completeness_test
