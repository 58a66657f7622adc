// A mode between the points of the trace: its eigenvalue and series against closed forms, alone and in
// blocks, up to where it is no longer simple.
#include "continuation/events/nearby_mode.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/on_path.hpp"
#include "continuation/planted_search.hpp"

namespace eigentrail::test::nearby_mode_test {
namespace {

constexpr double rounding = 1e-12;

TEST(UpperMember, IsTheOneWithImSAboveInEitherChart) {
  const Complex s(-0.3, 2.0);
  EXPECT_EQ(upper_member(s, Chart::finite), s);
  EXPECT_EQ(upper_member(std::conj(s), Chart::finite), s);
  const Complex mu = 1.0 / s;
  EXPECT_LT(mu.imag(), 0.0);
  EXPECT_EQ(upper_member(mu, Chart::reciprocal), mu);
  EXPECT_EQ(upper_member(std::conj(mu), Chart::reciprocal), mu);
  EXPECT_EQ(upper_member(-1.5, Chart::finite), Complex(-1.5));
  EXPECT_EQ(upper_member(-1.5, Chart::reciprocal), Complex(-1.5));
}

/// Two frequencies 2 + p and 2.6 - p that cross at 0.3, and one of them far away.
Planted crossing() {
  return Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.6, -1.0}, {5.0, 0.0}}));
}

TEST(LookAtMode, GivesASingleModeWithItsSeries) {
  PlantedSearch planted(crossing());
  const PathNode left = planted.family.point(0.0, alone({5.0 * j, 2.0 * j}));
  const auto mode = look_at_mode(planted.solver, left, 1, 2.1 * j, 0.1, ModeFunction::eigenvalue);
  ASSERT_TRUE(mode);
  EXPECT_EQ(mode->solved.node.tracks.size(), 1U);
  EXPECT_EQ(mode->solved.node.p, 0.1);
  EXPECT_LT(std::abs(mode->root - 2.1 * j), rounding);
  EXPECT_LT(distance(mode->series, ComplexVector{{2.1 * j, j}}), rounding);
  EXPECT_EQ(mode->gap, INFINITY);
  EXPECT_FALSE(mode->is_mean);
}

TEST(LookAtMode, PicksTheExpectedOneOfABlock) {
  PlantedSearch planted(crossing());
  const PathNode left = planted.family.point(0.0, {{{2.0 * j, 2.6 * j}}});
  const auto falling = look_at_mode(planted.solver, left, 0, 2.48 * j, 0.1, ModeFunction::eigenvalue);
  ASSERT_TRUE(falling);
  EXPECT_LT(distance(falling->series, ComplexVector{{2.5 * j, -1.0 * j}}), rounding);
  const auto rising = look_at_mode(planted.solver, left, 0, 2.12 * j, 0.1, ModeFunction::eigenvalue);
  ASSERT_TRUE(rising);
  EXPECT_LT(distance(rising->series, ComplexVector{{2.1 * j, j}}), rounding);
}

/// The conjugate is followed; the upper member is what the criteria are of.
TEST(LookAtMode, GivesTheUpperMember) {
  PlantedSearch planted(crossing());
  const PathNode left = planted.family.point(0.0, alone({-2.0 * j}));
  const auto mode = look_at_mode(planted.solver, left, 0, -2.1 * j, 0.1, ModeFunction::eigenvalue);
  ASSERT_TRUE(mode);
  EXPECT_LT(distance(mode->series, ComplexVector{{2.1 * j, j}}), rounding);
}

/// Closer than 1e-3 the two are computed as a block. The other eigenvalue's share must not enter.
TEST(LookAtMode, TellsTwoApartThatAreClose) {
  PlantedSearch planted(crossing());
  const PathNode left = planted.family.point(0.0, {{{2.0 * j, 2.6 * j}}});
  for (const double beside : {1e-2, 1e-4, 1e-6}) {
    const double p = 0.3 - beside;
    const auto mode = look_at_mode(planted.solver, left, 0, (2.0 + p) * j, p, ModeFunction::eigenvalue);
    ASSERT_TRUE(mode) << beside;
    EXPECT_LT(std::abs(mode->root - (2.0 + p) * j), rounding) << beside;
    // Slopes lose what the eigenvectors lose.
    EXPECT_LT(std::abs(mode->series[1] - j), 1e-13 / beside + rounding) << beside;
  }
}

/// s^2 + 2 d s + 1 - p: the pair -d +- j sqrt(1 - p - d^2) meets the real axis at p = 1 - d^2.
struct Colliding {
  Colliding() : planted(Planted({{Matrix{{1.0}}}, {Matrix{{2.0 * d}}}, {Matrix{{1.0}}, Matrix{{-1.0}}}})) {
    const Complex s(-d, std::sqrt(0.5 - d * d));
    left = planted.family.point(0.5, {{{s, std::conj(s)}}});
  }
  std::optional<NearbyMode> look(double p, ModeFunction wanted) {
    const Complex root = std::sqrt(Complex(p - (1.0 - d * d)));
    return look_at_mode(planted.solver, left, 0, -d + root, p - 0.5, wanted);
  }
  static constexpr double d = 0.5;
  PlantedSearch planted;
  PathNode left;
};

TEST(LookAtMode, GivesThePairOfARealBlock) {
  Colliding colliding;
  const auto mode = colliding.look(0.55, ModeFunction::eigenvalue);
  ASSERT_TRUE(mode);
  const double w = std::sqrt(0.2);
  EXPECT_LT(std::abs(mode->root - Complex(-0.5, w)), rounding);
  EXPECT_LT(std::abs(mode->series[1] + 0.5 / w * j), rounding);
}

/// At the exceptional point neither has a series; their mean has one.
TEST(LookAtMode, AtAnExceptionalPointOnlyTheMeanHasASeries) {
  Colliding colliding;
  const auto one = colliding.look(0.75, ModeFunction::eigenvalue);
  ASSERT_TRUE(one);
  EXPECT_LT(one->gap, 1e-6);
  const bool knows = one->series.size() > 1 && std::abs(one->series[1]) < 1e3;
  EXPECT_FALSE(knows) << "a square root has no slope at zero";
  const auto mean = colliding.look(0.75, ModeFunction::pair_mean);
  ASSERT_TRUE(mean);
  EXPECT_TRUE(mean->is_mean);
  EXPECT_LT(distance(mean->series, ComplexVector{{-0.5}}), rounding);
  EXPECT_NEAR(mean->root.real(), -0.5, rounding);
}

/// The product 1 - p knows nothing of the exceptional point, not even on it.
TEST(LookAtMode, TheProductOfAPairIsSmoothWhereThePairMeets) {
  Colliding colliding;
  for (const double p : {0.55, 0.75, 0.8}) {
    const auto product = colliding.look(p, ModeFunction::product);
    ASSERT_TRUE(product);
    EXPECT_LT(distance(product->series, ComplexVector{{1.0 - p, -1.0}}), rounding) << p;
  }
}

/// Damping 1e-12: Re s is known to its own digits, not to those of |s|.
TEST(LookAtMode, GivesASmallRealPartToItsOwnDigits) {
  constexpr double d = 1e-12;
  PlantedSearch planted(Planted({{Matrix{{1.0}}}, {Matrix{{2.0 * d}}}, {Matrix{{1.0}}, Matrix{{1.0}}}}));
  const PathNode left = planted.family.point(0.0, alone({{-d, 1.0}}));
  const auto mode =
      look_at_mode(planted.solver, left, 0, {-d, std::sqrt(1.3)}, 0.3, ModeFunction::eigenvalue);
  ASSERT_TRUE(mode);
  EXPECT_NEAR(mode->root.real(), -d, 1e-6 * d);
}

}  // namespace
}  // namespace eigentrail::test::nearby_mode_test
