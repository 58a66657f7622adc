// Modes that may be followed together, from their meetings in closed form: before, beside and behind a step.
#include "continuation/tracks/regrouping.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/meeting_families.hpp"

namespace eigentrail::test::find_partners_test {
namespace {

constexpr double rounding = 1e-12;  ///< of series of modes some tenths apart, of order one

TEST(FindPartners, DoNotDependOnTheUnitOfTheParameter) {
  for (const double unit : {1e-12, 1e-9, 1e9}) {
    Planted family = Planted::frequencies(
        uncoupled(Matrix{{2.0, 1.0 / unit}, {2.6, -1.0 / unit}, {5.0, 0.0}, {9.0, 0.0}}));
    const PathNode node = family.point(0.0, alone(at_zero));
    const auto partners = find_partners(node, 0, 0.1 * unit, 3.0);
    ASSERT_EQ(partners.size(), 1U) << unit;
    EXPECT_EQ(partners[0].track, 1U);
    EXPECT_NEAR(partners[0].distance / unit, 0.2, 1e-7);
  }
}

TEST(FindPartners, AreSymmetricAndNearestFirst) {
  // 2 + p meets 2.3 at 0.3 and 2.5 at 0.5; those two never meet.
  Planted family = Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.5, 0.0}, {2.3, 0.0}}));
  const PathNode node = family.point(0.0, alone({2.0 * j, 2.5 * j, 2.3 * j}));
  const auto partners = find_partners(node, 0, 0.1, 5.0);
  ASSERT_EQ(partners.size(), 2U);
  EXPECT_EQ(partners[0].track, 2U);
  EXPECT_EQ(partners[1].track, 1U);
  for (const std::size_t other : {1U, 2U}) {
    const auto back = find_partners(node, other, 0.1, 5.0);
    ASSERT_EQ(back.size(), 1U);
    EXPECT_EQ(back[0].track, 0U);
    EXPECT_NEAR(back[0].distance, partners[other == 2U ? 0 : 1].distance, rounding);
  }
}

class FindPartnersOfVeering : public testing::TestWithParam<double> {};

/// 20 +- sqrt(p^2 + eps^2): they meet at +- j eps. The series of the discriminant is exact, those of the
/// modes are not.
TEST_P(FindPartnersOfVeering, DistanceIsThatOfTheExceptionalPoint) {
  const double eps = GetParam();
  Planted family = Planted::frequencies({Matrix{{20.0, eps}, {eps, 20.0}}, Matrix{{1.0, 0.0}, {0.0, -1.0}}});
  const double start = 0.2;
  const double apart = std::hypot(start, eps);
  const PathNode node = family.point(-start, alone({(20.0 - apart) * j, (20.0 + apart) * j}));
  const auto partners = find_partners(node, 0, 2.0 * start, 0.5);
  ASSERT_EQ(partners.size(), 1U);
  EXPECT_EQ(partners[0].track, 1U);
  EXPECT_FALSE(partners[0].conjugate);
  EXPECT_NEAR(partners[0].distance, eps, 1e-10 / eps);
}

INSTANTIATE_TEST_SUITE_P(HalfWidths, FindPartnersOfVeering, testing::Values(0.1, 1e-2, 1e-3, 1e-4));

/// A veering of half-width 0.1, on a step of twice the radius of convergence of the series. Outside of that
/// radius the series suggest a meeting with a conjugate four units away. It must not come before the true
/// partner.
TEST(FindPartners, ConjugateFarAwayIsNotTheNearest) {
  constexpr double eps = 0.1;
  Planted family = Planted::frequencies({Matrix{{2.0, eps}, {eps, 2.0}}, Matrix{{1.0, 0.0}, {0.0, -1.0}}});
  const double apart = std::hypot(0.2, eps);
  const PathNode node = family.point(-0.2, alone({(2.0 - apart) * j, (2.0 + apart) * j}));
  const auto partners = find_partners(node, 0, 0.4, 0.5);
  ASSERT_FALSE(partners.empty());
  EXPECT_FALSE(partners[0].conjugate);
  EXPECT_EQ(partners[0].track, 1U);
}

TEST(FindPartners, IsAModesOwnConjugateBeforeTheRealAxis) {
  Planted family = towards_the_axis(0.5);
  const PathNode node = family.point(0.5, alone({upper(0.5, 0.5), far_away}));
  const auto partners = find_partners(node, 0, 0.1, 2.0);
  ASSERT_EQ(partners.size(), 1U);
  EXPECT_TRUE(partners[0].conjugate);
  EXPECT_EQ(partners[0].track, 0U);
  EXPECT_NEAR(partners[0].distance, 0.15, rounding);
  EXPECT_TRUE(find_partners(node, 0, 0.1, 1.0).empty());
  EXPECT_TRUE(find_partners(node, 1, 0.1, 2.0).empty());
}

TEST(LimitingPartners, AreAsSingularAsTheModeItself) {
  Planted family = towards_the_axis(0.5);
  const PathNode node = family.point(0.74, alone({upper(0.5, 0.74), far_away}));
  const auto limiting = limiting_partners(node, 0, 0.01, 2.0);
  ASSERT_EQ(limiting.size(), 1U);
  EXPECT_TRUE(limiting[0].conjugate);
  EXPECT_FALSE(may_limit(node, 0, {false, 1, 0.0}));
  EXPECT_TRUE(may_limit(node, 1, {false, 0, 0.0}));
}

TEST(FindPartners, RealModeHasNoConjugate) {
  Planted family = towards_the_axis(0.5);
  // Behind the collision, at p = 0.76: s = -0.5 +- 0.1, which meet each other behind the step.
  const PathNode node = family.point(0.76, alone({Complex(-0.4), Complex(-0.6), far_away}));
  const auto partners = find_partners(node, 0, 0.005, 2.5);
  ASSERT_EQ(partners.size(), 1U);
  EXPECT_FALSE(partners[0].conjugate);
  EXPECT_EQ(partners[0].track, 1U);
  // The root lies where the series ceases to converge, which magnifies rounding.
  EXPECT_NEAR(partners[0].distance, 0.01, 1e-8);
}

TEST(FindPartners, ChartsDoNotMatter) {
  Planted family = crossing();
  PathNode node = family.point(0.0, alone(at_zero));
  ASSERT_TRUE(change_chart(family.problem(), node, 1, family.counts));
  const auto partners = find_partners(node, 0, 0.1, 3.0);
  ASSERT_EQ(partners.size(), 1U);
  EXPECT_EQ(partners[0].track, 1U);
  // 1 / (2.6 - p) is no polynomial: its series to p^5 places the crossing to some (0.3 / 2.6)^6.
  EXPECT_NEAR(partners[0].distance, 0.2, 1e-3);
}

/// A block of 2 +- 0.1 and a single mode 3 - p, which meets the upper member of the block at p = 0.9. The
/// search must use the members of the block and not their mean.
TEST(FindPartners, BlockIsMetWhereItsMembersAre) {
  Planted family = Planted::frequencies(uncoupled(Matrix{{1.9, 0.0}, {2.1, 0.0}, {3.0, -1.0}}));
  const PathNode node = family.point(0.0, {{{1.9 * j, 2.1 * j}}, {{3.0 * j}}});
  const auto partners = find_partners(node, 1, 0.85, 0.1);
  ASSERT_EQ(partners.size(), 1U);
  EXPECT_LE(partners[0].distance, 0.05 + rounding);
}

/// A wide block of 11 and 16 + p, and a mode 15 + p between them. Mean and radius of the block alone would
/// have it meet the member at 11, from which it moves away.
TEST(FindPartners, WideBlockIsNotMetWhereItsDiscIs) {
  Planted family = Planted::frequencies(uncoupled(Matrix{{11.0, 0.0}, {16.0, 1.0}, {15.0, 1.0}}));
  PathNode node = family.point(0.0, alone({11.0 * j, 16.0 * j, 15.0 * j}));
  ASSERT_TRUE(join(family.problem(), node, 0, {{false, 1, 0.0}}, family.counts));
  ASSERT_EQ(node.tracks.size(), 2U);
  EXPECT_TRUE(find_partners(node, 1, 8.0, 0.4).empty());
  EXPECT_TRUE(find_partners(node, 0, 8.0, 0.4).empty());
}

}  // namespace
}  // namespace eigentrail::test::find_partners_test
