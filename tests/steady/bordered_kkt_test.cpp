// The sparse method of the system on a plane across the path, compared with the null-space method.
#include "steady/sparse_kkt.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "eigentrail/steady/path_plane.hpp"
#include "steady/constrained_chain.hpp"

namespace eigentrail::test::bordered_kkt_test {
namespace {

constexpr double tolerance = 1e-11;
constexpr int n = ConstrainedChain::n, m = ConstrainedChain::m;

/// A symmetric chain, with a load and changes of the constraints by the parameter.
struct System : ConstrainedChain {
  Vector force, constraint;
  PathPlane plane;

  explicit System(std::mt19937_64&& engine = std::mt19937_64(5)) : ConstrainedChain(engine, 0.0) {
    std::uniform_real_distribution<double> number(0.5, 1.5);
    const auto random = [&](int size) {
      return Vector::NullaryExpr(size, [&] { return number(engine) - 1.0; });
    };
    force = random(n);
    constraint = random(m);
    plane = {random(n), 0.7};
  }

  /// Motion that the constraints allow, with the least stiffness, which becomes zero: a fold.
  Vector soften() {
    const auto [stiffness, motion] = least();
    K -= stiffness * Matrix::Identity(n, n);
    return motion;
  }
};

struct Solution {
  Vector dx, dl;
  double dp = 0.0;
};

Solution solve(const System& system, bool sparse) {
  const KktBorder border{system.force,
                         system.constraint,
                         system.plane.x.transpose(),
                         {},
                         Matrix::Constant(1, 1, system.plane.p)};
  const Vector r = Vector::LinSpaced(n, -1.0, 2.0), g = Vector::LinSpaced(m, 1.0, -1.0);
  const Vector h = Vector::Constant(1, 0.3);
  Solution result;
  Vector du;
  if (sparse) {
    SparseKkt(system.K.sparseView(), system.A.sparseView(), border).solve(r, g, h, result.dx, result.dl, du);
  } else {
    BorderedKkt(system.K, ConstraintFactorization(system.A), border).solve(r, g, h, result.dx, result.dl, du);
  }
  result.dp = du[0];
  return result;
}

void expect_equal(const Solution& a, const Solution& b) {
  EXPECT_LT((a.dx - b.dx).norm(), tolerance * b.dx.norm());
  EXPECT_LT((a.dl - b.dl).norm(), tolerance * b.dl.norm());
  EXPECT_NEAR(a.dp, b.dp, tolerance * std::abs(b.dp));
}

TEST(BorderedKkt, SparseRouteAgreesWithTheNullSpaceRoute) {
  const System system;
  expect_equal(solve(system, true), solve(system, false));
}

TEST(BorderedKkt, BothRoutesSolveAtAFold) {
  System system;
  system.soften();
  const Solution found = solve(system, true);
  expect_equal(found, solve(system, false));
  const Vector left = system.K * found.dx + system.A.transpose() * found.dl + found.dp * system.force -
                      Vector::LinSpaced(n, -1.0, 2.0);
  EXPECT_LT(left.norm(), tolerance * std::sqrt(n));
  EXPECT_NEAR(system.plane.x.dot(found.dx) + system.plane.p * found.dp, 0.3, tolerance);
}

/// Two trimmed parameters, one of whose conditions knows multipliers, and the plane.
TEST(BorderedKkt, RoutesAgreeWithSeveralUnknowns) {
  const System system;
  const auto wave = [](int rows, int cols, double phase) {
    return Matrix(Matrix::NullaryExpr(rows, cols, [phase](Eigen::Index i, Eigen::Index j) {
      return std::sin(phase + 3.0 * i + 5.0 * j * j);
    }));
  };
  KktBorder border{wave(n, 2, 0.1), wave(m, 2, 0.2), wave(2, n, 0.3), Matrix::Zero(2, m), wave(2, 2, 0.4)};
  border.lambda.row(1) = wave(1, m, 0.5);
  Vector of_constraint(m + 2);
  of_constraint << system.constraint, 0.3, -0.7;
  border = border.and_one(system.force, of_constraint, system.plane.x, {}, system.plane.p);
  const Vector r = Vector::LinSpaced(n, -1.0, 2.0), g = Vector::LinSpaced(m, 1.0, -1.0);
  const Vector h = Vector::LinSpaced(3, 0.5, 1.0);
  Solution sparse, dense;
  Vector unknowns, expected;
  SparseKkt(system.K.sparseView(), system.A.sparseView(), border)
      .solve(r, g, h, sparse.dx, sparse.dl, unknowns);
  BorderedKkt(system.K, ConstraintFactorization(system.A), border)
      .solve(r, g, h, dense.dx, dense.dl, expected);
  expect_equal(sparse, dense);
  EXPECT_LT((unknowns - expected).norm(), tolerance * expected.norm());
  EXPECT_LT((system.K * sparse.dx + system.A.transpose() * sparse.dl + border.force * unknowns - r).norm(),
            tolerance * r.norm());
  EXPECT_LT((border.x * sparse.dx + border.lambda * sparse.dl + border.unknown * unknowns - h).norm(),
            tolerance);
}

/// Units of the parameter and of the plane change the numbers, and nothing else.
TEST(BorderedKkt, UnitsOfTheParameterAndOfThePlaneDoNotMatter) {
  System system;
  system.soften();
  const Solution expected = solve(system, true);
  for (const double unit : {1e-9, 1e9}) {
    System other = system;
    other.force *= unit;
    other.constraint *= unit;
    other.plane.p *= unit;
    Solution found = solve(other, true);
    found.dp *= unit;
    expect_equal(found, expected);
  }
}

/// Neither the plane nor the parameter knows of the motion without stiffness: no route may invent a solution.
TEST(BorderedKkt, SingularSystemHasNoSolution) {
  System system;
  const Vector kernel = system.soften();
  for (Vector* one : {&system.force, &system.plane.x}) *one -= kernel.dot(*one) * kernel;
  system.constraint.setZero();
  const Solution found = solve(system, true);
  EXPECT_FALSE(found.dx.norm() < 1e8) << found.dx.norm();
}

}  // namespace
}  // namespace eigentrail::test::bordered_kkt_test
