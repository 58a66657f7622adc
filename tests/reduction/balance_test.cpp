// Scaling of the rows and columns of a pencil.
#include "reduction/balance.hpp"

#include <gtest/gtest.h>

namespace eigentrail::test::balance_test {
namespace {

/// A single freedom with mass among massless ones: with the stiffness of all of them its frequency has no
/// limit, and its row would be scaled down in every sweep.
TEST(Balance, LeavesWhatIsBalancedThoughFreedomsHaveNoMass) {
  CoefficientMatrices coefficients;
  coefficients.M = {Matrix{{1.4, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}};
  coefficients.C = {Matrix::Zero(3, 3)};
  coefficients.K = {Matrix{{2.9, -0.4, -0.6}, {-0.4, 0.5, -0.1}, {-0.6, -0.1, 0.6}}};
  EXPECT_LE(balance(coefficients, 3).ratio(), 4.0);
}

/// The same in other units of the freedom with mass.
TEST(Balance, ScalesTheFreedomWithMassToTheOthers) {
  const double unit = 1024.0;
  const Matrix scale = Vector{{unit, 1.0, 1.0}}.asDiagonal();
  CoefficientMatrices coefficients;
  coefficients.M = {scale * Matrix{{1.4, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}} * scale};
  coefficients.K = {scale * Matrix{{2.9, -0.4, -0.6}, {-0.4, 0.5, -0.1}, {-0.6, -0.1, 0.6}} * scale};
  const Balance found = balance(coefficients, 3);
  EXPECT_LE(found.of(coefficients.K[0]).cwiseAbs().maxCoeff(), 4.0);
  EXPECT_GE(found.rows.minCoeff(), 0.25 / unit);
}

}  // namespace
}  // namespace eigentrail::test::balance_test
