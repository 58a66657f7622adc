// Equilibria of slender beams: the load is added in steps where damped steps become short.
#include <gtest/gtest.h>

#include <cmath>

#include "eigentrail/steady/equilibrium.hpp"
#include "steady/heavy_elastica.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::slender_beams_test {
namespace {

/// Bent until it hangs.
class SlenderBeams : public testing::TestWithParam<double> {};

TEST_P(SlenderBeams, FindTheirEquilibriumUnderTheirWeight) {
  const double weight = GetParam();
  const HeavyCantilever beam(weight, "elements = 40");
  const Equilibrium& found = beam.found;
  ASSERT_EQ(found.status, SteadyStatus::converged) << found.report.message;
  EXPECT_FALSE(found.report.relaxed);
  EXPECT_LT(found.report.iterations, 200);
  const Vector tip = heavy_elastica(weight);
  EXPECT_NEAR(beam.tip()[0], tip[0], 1e-4);
  EXPECT_NEAR(beam.tip()[2], -std::abs(tip[1]), 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Weights, SlenderBeams,
                         testing::Values(1.0, 1.5, 2.0, 2.4, 2.5, 2.51, 3.0, 10.0, 30.0));

}  // namespace
}  // namespace eigentrail::test::slender_beams_test
