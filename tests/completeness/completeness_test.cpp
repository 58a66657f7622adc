// Fifty random families: no flutter, divergence or real collision missing or invented.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "completeness/discrepancies.hpp"

namespace eigentrail::test {
namespace {

/// Seeds that fail, with all that fails in them. Where one of them passes its line is to be removed.
const std::map<int, std::vector<std::string>> known_failures = {
    // Damping ratio some 1e-5: a pair meets on the real axis, and 3.5e-10 behind one of the two real
    // eigenvalues passes zero. The divergence counts as the collision.
    {44, {"missing divergence at a collision"}},
};

class RandomFamilyTrace : public testing::TestWithParam<int> {};

TEST_P(RandomFamilyTrace, HasAllEventsOfTheReference) {
  const RandomFamily family = random_family(static_cast<std::uint64_t>(GetParam()));
  const CompletenessReport report = check_completeness(family);
  SCOPED_TRACE(std::string(name_of(family.kind)) + ", " + std::to_string(family.size()) + " coordinates");
  std::vector<std::string> failures;
  for (const Discrepancy& discrepancy : report.discrepancies) failures.push_back(discrepancy.what);
  const auto known = known_failures.find(GetParam());
  EXPECT_EQ(failures, known == known_failures.end() ? std::vector<std::string>() : known->second)
      << report.problems();
  EXPECT_TRUE(report.reference.doubts.empty()) << report.problems();
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomFamilyTrace, testing::Range(1, 51),
                         [](const auto& tested) { return "seed_" + std::to_string(tested.param); });

}  // namespace
}  // namespace eigentrail::test
