#include "eigentrail/continuation/route_choice.hpp"

#include <gtest/gtest.h>

namespace eigentrail::test::route_choice_test {
namespace {

Structure damped() {
  Structure structure;
  structure.damped = true;
  return structure;
}

TEST(RouteChoice, ProductsServeAllModesOfADenseSystem) {
  for (const Eigen::Index n : {2, 20, 100, 500})
    EXPECT_EQ(cheapest_route(damped(), {n, n, true, 3}), ModeRoute::state_space) << n;
}

TEST(RouteChoice, FewModesTakeOneLuEach) {
  EXPECT_EQ(cheapest_route(damped(), {200, 6, false, 3}), ModeRoute::one_by_one);
  EXPECT_EQ(cheapest_route({}, {200, 6, false, 3}), ModeRoute::one_by_one);
}

TEST(RouteChoice, WithoutDampingAndGyroscopicTermsProductsAreReal) {
  EXPECT_EQ(cheapest_route({}, {100, 100, true, 3}), ModeRoute::symmetric);
  for (auto flag : {&Structure::damped, &Structure::gyroscopic, &Structure::circulatory}) {
    Structure structure;
    structure.*flag = true;
    EXPECT_EQ(cheapest_route(structure, {100, 100, true, 3}), ModeRoute::state_space);
  }
  Structure unsymmetric;
  unsymmetric.symmetric_mass = false;
  EXPECT_EQ(cheapest_route(unsymmetric, {100, 100, true, 3}), ModeRoute::state_space);
}

TEST(RouteChoice, RealProductsCostAQuarterAtMost) {
  const ModeWork work{100, 100, true, 3};
  EXPECT_LT(4.0 * route_work(ModeRoute::symmetric, {}, work), route_work(ModeRoute::state_space, {}, work));
}

TEST(RouteChoice, WorkGrowsWithTheNumberOfModesAndTheOrder) {
  const auto work = [](Eigen::Index modes, int order) {
    return route_work(ModeRoute::one_by_one, damped(), {50, modes, false, order});
  };
  EXPECT_DOUBLE_EQ(work(12, 3), 2.0 * work(6, 3));
  EXPECT_GT(work(6, 4), work(6, 3));
}

}  // namespace
}  // namespace eigentrail::test::route_choice_test
