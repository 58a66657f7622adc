// Separation margins of critical speeds from operating ranges.
#include "eigentrail/continuation/operating_range.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace eigentrail::test::operating_range_test {
namespace {

const double infinite = std::numeric_limits<double>::infinity();

/// An eigenvalue with this damping ratio.
Complex damped(double ratio) {
  return {-ratio, std::sqrt(1.0 - ratio * ratio)};
}

TEST(AmplificationFactor, IsOneOverTwiceTheDampingRatio) {
  EXPECT_DOUBLE_EQ(amplification_factor(damped(0.05)), 10.0);
  EXPECT_EQ(amplification_factor({0.0, 3.0}), infinite);
  EXPECT_EQ(amplification_factor({0.1, 3.0}), infinite) << "the mode grows";
}

TEST(ApiMargin, FollowsTheFormulasOfTheStandard) {
  // 17 (1 - 1/(AF - 1.5)) percent below the range, 10 more above; at most 16 and 26.
  EXPECT_EQ(api_margin(2.499, true), 0.0);
  EXPECT_EQ(api_margin(2.499, false), 0.0);
  EXPECT_NEAR(api_margin(2.5, true), 0.0, 1e-15);
  EXPECT_NEAR(api_margin(2.5, false), 0.10, 1e-15);
  EXPECT_NEAR(api_margin(5.0, true), 0.17 * (1.0 - 1.0 / 3.5), 1e-15);
  EXPECT_NEAR(api_margin(5.0, false), 0.10 + 0.17 * (1.0 - 1.0 / 3.5), 1e-15);
  EXPECT_DOUBLE_EQ(api_margin(infinite, true), 0.16);
  EXPECT_DOUBLE_EQ(api_margin(infinite, false), 0.26);
}

TEST(Separation, IsAFractionOfTheNearerEnd) {
  const OperatingRanges operating{{{5000.0, 7000.0}}, 0.15};
  const Separation below = *separation(operating, 4650.0, damped(0.01));
  EXPECT_DOUBLE_EQ(below.distance, 350.0 / 5000.0);
  EXPECT_EQ(below.wanted, 0.15);
  EXPECT_TRUE(below.is_too_close());
  EXPECT_FALSE(separation(operating, 4200.0, damped(0.01))->is_too_close());
  const Separation above = *separation(operating, 7700.0, damped(0.01));
  EXPECT_DOUBLE_EQ(above.distance, 0.1);
  EXPECT_TRUE(above.is_too_close());
  EXPECT_TRUE(separation(operating, 6000.0, damped(0.01))->inside);
  EXPECT_TRUE(separation(operating, 6000.0, damped(0.01))->is_too_close());
}

TEST(Separation, ByTheStandardDependsOnDamping) {
  const OperatingRanges operating{{{5000.0, 7000.0}}, {}};
  EXPECT_TRUE(separation(operating, 4650.0, damped(0.01))->is_too_close());
  EXPECT_FALSE(separation(operating, 4650.0, damped(0.19))->is_too_close()) << "7 %, 4.7 % wanted";
  EXPECT_FALSE(separation(operating, 6000.0, damped(0.21))->is_too_close()) << "AF below 2.5";
}

TEST(Separation, IsTheOneToWhichMostIsWanting) {
  const OperatingRanges operating{{{1000.0, 2000.0}, {2150.0, 3000.0}}, 0.1};
  EXPECT_EQ(separation(operating, 2080.0, damped(0.01))->range.from, 2150.0) << "3.3 % below, 4 % above";
  EXPECT_FALSE(separation({}, 2080.0, damped(0.01)).has_value());
}

TEST(Separation, FromARangeThatBeginsAtRestIsDefined) {
  EXPECT_TRUE(separation({{{0.0, 100.0}}, 0.1}, 0.0, damped(0.01))->inside);
  EXPECT_FALSE(separation({{{0.0, 0.0}}, 0.1}, 5.0, damped(0.01))->is_too_close());
}

TEST(OperatingRanges, AreWrittenAsTheSceneHasThem) {
  EXPECT_EQ(ranges_text({{{3000.0, 3600.0}, {8000.0, 9000.5}}, 0.15}), "3000 to 3600, 8000 to 9000.5");
  EXPECT_EQ(margin_text({{}, 0.15}), "0.15");
  EXPECT_EQ(margin_text({}), "API 684");
}

}  // namespace
}  // namespace eigentrail::test::operating_range_test
