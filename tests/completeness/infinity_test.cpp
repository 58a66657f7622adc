// Random families with massless freedoms whose stiffness passes zero: at every point of the trace the modes
// are the whole finite spectrum.
#include <gtest/gtest.h>

#include <string>

#include "completeness/massless_family.hpp"
#include "support/seeds.hpp"

namespace eigentrail::test::infinity_test {
namespace {

class MasslessFamilyTrace : public testing::TestWithParam<int> {};

TEST_P(MasslessFamilyTrace, HasTheWholeSpectrumInBothDirections) {
  const MasslessFamily family = massless_family(static_cast<std::uint64_t>(GetParam()));
  for (const bool reversed : {false, true}) {
    for (const std::string& problem : check_massless(family, reversed))
      ADD_FAILURE() << problem << (reversed ? ", reversed\n" : "\n") << family.scene();
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, MasslessFamilyTrace, first_seeds(12), seed_name);

/// x'' + x + 0.3 y = 0 and 0.3 x + p y = 0: s^2 = 0.09 / p - 1, infinite at p = 0.
TEST(MasslessFamily, HasTheSpectrumOfTheClosedForm) {
  MasslessFamily family;
  family.unmixed.M = {Matrix{{1.0, 0.0}, {0.0, 0.0}}};
  family.unmixed.C = {Matrix::Zero(2, 2)};
  family.unmixed.K = {Matrix{{1.0, 0.3}, {0.3, 0.0}}, Matrix{{0.0, 0.0}, {0.0, 1.0}}};
  family.matrices = family.unmixed;
  for (const double p : {-0.8, 0.01, 0.5}) {
    const Complex s = std::sqrt(Complex(0.09 / p - 1.0));
    for (const Complex found : family.spectrum(p))
      EXPECT_LT(std::min(std::abs(found - s), std::abs(found + s)), 1e-12 * std::abs(s));
  }
  ASSERT_EQ(family.places_of_infinity().size(), 1U);
  EXPECT_NEAR(family.places_of_infinity()[0], 0.0, 1e-15);
}

}  // namespace
}  // namespace eigentrail::test::infinity_test
