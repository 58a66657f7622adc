#include "eigentrail/continuation/route_choice.hpp"

#include <gtest/gtest.h>

namespace eigentrail::test::order_choice_test {
namespace {

TEST(OrderChoice, HigherOrderForTighterTolerance) {
  for (const Eigen::Index freedoms : {1, 20, 200}) {
    int last = 1;
    for (const double tolerance : {1e-1, 1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13}) {
      const int order = cheapest_order({freedoms, true}, tolerance);
      EXPECT_GE(order, last) << tolerance;
      last = order;
    }
    EXPECT_EQ(last, 4);
  }
}

TEST(OrderChoice, HigherOrderForDearerPoints) {
  // Where the LU is what costs, more coefficients come nearly free.
  EXPECT_EQ(cheapest_order({2, true}, 1e-2), 1);
  EXPECT_EQ(cheapest_order({2, true}, 1e-4), 2);
  EXPECT_EQ(cheapest_order({2, true}, 1e-6), 3);
  EXPECT_EQ(cheapest_order({1000, true}, 1e-6), 4);
  for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8})
    EXPECT_GE(cheapest_order({50, true}, tolerance), cheapest_order({50, false}, tolerance));
}

TEST(OrderChoice, PointsAreThoseOfARotatingMass) {
  // Counted with orders 1 to 4 at 1e-4 and 1e-8 from 100 to 5 rad/s: docs/developers/accuracy.md.
  const double unit = 18 / relative_points(2, 1e-4);
  const int at_1e_4[] = {35, 18, 15, 14};
  const int at_1e_8[] = {262, 61, 33, 23};
  for (int order = 1; order <= 4; ++order) {
    EXPECT_NEAR(unit * relative_points(order, 1e-4) / at_1e_4[order - 1], 1.0, 0.2) << order;
    EXPECT_NEAR(unit * relative_points(order, 1e-8) / at_1e_8[order - 1], 1.0, 0.2) << order;
  }
}

}  // namespace
}  // namespace eigentrail::test::order_choice_test
