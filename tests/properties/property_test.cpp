// Families with planted special points, traced: every value, every event, every label.
#include <gtest/gtest.h>

#include "properties/run_family.hpp"
#include "support/seeds.hpp"

namespace eigentrail::test::property_test {
namespace {

class PlantedFamilyTrace : public testing::TestWithParam<int> {};

TEST_P(PlantedFamilyTrace, HasExactValuesEventsAndLabels) {
  const auto seed = static_cast<std::uint64_t>(GetParam());
  const PlantedFamily family = planted_family(seed);
  const FamilyReport report = run_family(family, setting_of(seed));
  EXPECT_GT(report.labels.labels, 100);
  EXPECT_EQ(report.problems(), "") << family.description() << family.as_case().scene;
}

INSTANTIATE_TEST_SUITE_P(Seeds, PlantedFamilyTrace, first_seeds(50), seed_name);

/// Regression test: two crossings of one pair are so close that the second one was missed, and labels behind
/// it were exchanged; or that the modes cross at a small angle, and rounding made a narrow veering of one
/// (932).
INSTANTIATE_TEST_SUITE_P(CloseCrossings, PlantedFamilyTrace, testing::Values(263, 637, 659, 932), seed_name);

/// Regression test: narrow veerings were located from series only, and beside other ones some were invented;
/// a veering of one freedom. Seen from beyond the ends of a step a veering was dismissed for good, because
/// the dense output there did not tell its modes (518), and was listed again some steps later (867). Of two
/// that share a mode one was lost, because the dense output told its modes on no step (595).
INSTANTIATE_TEST_SUITE_P(NarrowVeerings, PlantedFamilyTrace,
                         testing::Values(508, 518, 591, 595, 613, 867, 965), seed_name);

/// Regression test: real eigenvalues beside others, whose blocks did not converge, or were not joined with
/// what they met, so that steps became tiny.
INSTANTIATE_TEST_SUITE_P(CloseRealEigenvalues, PlantedFamilyTrace, testing::Values(151, 999), seed_name);

/// Collisions so close to each other that rounding of the matrices moves them by more than 1e-9.
INSTANTIATE_TEST_SUITE_P(IllConditioned, PlantedFamilyTrace, testing::Values(336, 803), seed_name);

}  // namespace
}  // namespace eigentrail::test::property_test
