#include "eigentrail/core/extended.hpp"

#include <gtest/gtest.h>

#include "eigentrail/scene/expression.hpp"

namespace eigentrail::test::extended_test {
namespace {

/// A few units in the last of 113 bits.
constexpr double rounding = 1e-33;

double size(const Extended& x) {
  return std::abs(static_cast<double>(x));
}

TEST(Extended, HoldsWhatADoubleLoses) {
  const Extended small = 0x1p-100;
  EXPECT_EQ(static_cast<double>((Extended(1.0) + small) - Extended(1.0)), 0x1p-100);
}

TEST(Extended, RootsAndQuotientsAreRoundedWith113Bits) {
  const Extended root = sqrt(Extended(2.0));
  EXPECT_LT(size(root * root - Extended(2.0)), rounding);
  EXPECT_LT(size(Extended(1.0) / Extended(3.0) * Extended(3.0) - Extended(1.0)), rounding);
}

TEST(Extended, FunctionsSatisfyTheirIdentities) {
  const Extended x = 0.7;
  EXPECT_LT(size(sin(x) * sin(x) + cos(x) * cos(x) - Extended(1.0)), rounding);
  EXPECT_LT(size(cosh(x) * cosh(x) - sinh(x) * sinh(x) - Extended(1.0)), rounding);
  EXPECT_LT(size(tan(x) - sin(x) / cos(x)), rounding);
  EXPECT_LT(size(tanh(x) - sinh(x) / cosh(x)), rounding);
  EXPECT_LT(size(log(exp(x)) - x), rounding);
  EXPECT_LT(size(sin(asin(x)) - x), rounding);
  EXPECT_LT(size(cos(acos(x)) - x), rounding);
  EXPECT_LT(size(tan(atan(x)) - x), rounding);
}

TEST(Extended, IsNotFiniteWhereADoubleIsNot) {
  EXPECT_TRUE(isfinite(Extended(1e300)));
  EXPECT_FALSE(isfinite(Extended(1.0) / Extended(0.0)));
  EXPECT_FALSE(isfinite(sqrt(Extended(-1.0))));
}

TEST(Extended, ExpressionsOfAScene) {
  using Scalar = Series<Extended, 0>;
  const std::vector<Scalar> parameters{Extended(-3.0), Extended(2.0)};
  const Expression power = Expression::parse("a^b / 7 + a^2", {"a", "b"});
  const Extended value = power.evaluate(std::span<const Scalar>(parameters))[0];
  EXPECT_LT(size(value - (Extended(9.0) / Extended(7.0) + Extended(9.0))), 10 * rounding);
}

}  // namespace
}  // namespace eigentrail::test::extended_test
