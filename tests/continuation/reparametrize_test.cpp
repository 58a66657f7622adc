// Changes of the coordinate along the path: compared with paths that are polynomials in the new coordinate.
// For any path, the new coordinate is the one defined by the plane, and the inverse change restores every
// series.
#include "continuation/path/path_frame.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/planted_points.hpp"
#include "core/matrix_series.hpp"

namespace eigentrail::test::reparametrize_test {
namespace {

constexpr double rounding = 1e-13;  ///< of the composition of series of order one
constexpr int traced = 1;           ///< beside a parameter that does not change
constexpr Eigen::Index count = 6;
const PathPlane in_p{Vector::Zero(1), 1.0};

/// x = sqrt(p) about p = 1, lambda = p^2: in the coordinate sigma = x - 1 p is 1 + 2 sigma + sigma^2.
Path root_path() {
  Path path;
  path.x = Matrix{{1.0, 1.0 / 2.0, -1.0 / 8.0, 1.0 / 16.0, -5.0 / 128.0, 7.0 / 256.0}};
  path.lambda = Matrix{{1.0, 2.0, 1.0, 0.0, 0.0, 0.0}};
  path.parameters = Matrix{{7.0, 0.0}, {1.0, 1.0}};
  return path;
}

/// Largest difference of two series; columns that one lacks are zero.
double difference(const Matrix& a, const Matrix& b) {
  double worst = 0.0;
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    for (Eigen::Index k = 0; k < std::max(a.cols(), b.cols()); ++k)
      worst = std::max(worst, std::abs(coefficient(a, i, k) - coefficient(b, i, k)));
  }
  return worst;
}

TEST(Reparametrize, PathIsAPolynomialOfTheCoordinateThatItIsAFunctionOf) {
  Path path = root_path();
  reparametrize(path, {Vector::Ones(1), 0.0}, traced);
  EXPECT_LT(difference(path.x, Matrix{{1.0, 1.0}}), rounding);
  EXPECT_LT(difference(path.parameters, Matrix{{7.0, 0.0, 0.0}, {1.0, 2.0, 1.0}}), rounding);
  // p^2 = (1 + sigma)^4.
  EXPECT_LT(difference(path.lambda, Matrix{{1.0, 4.0, 6.0, 4.0, 1.0}}), rounding);
}

TEST(Reparametrize, ThereAndBackIsTheIdentity) {
  for (const PathPlane& plane : {PathPlane{Vector::Ones(1), 0.0}, PathPlane{Vector::Constant(1, -0.3), 2.0},
                                 PathPlane{in_p.x, -5.0}}) {
    Path path = root_path();
    reparametrize(path, plane, traced);
    reparametrize(path, in_p, traced);
    // Coefficients in between reach some hundred.
    EXPECT_LT(difference(path.x, root_path().x), 1e-11);
    EXPECT_LT(difference(path.lambda, root_path().lambda), 1e-11);
    EXPECT_LT(difference(path.parameters, root_path().parameters), 1e-11);
  }
}

TEST(Reparametrize, NewCoordinateIsWhatThePlaneMeasures) {
  const PathPlane plane{Vector::Constant(1, 0.7), 1.3};
  Path path = root_path();
  reparametrize(path, plane, traced);
  for (Eigen::Index k = 1; k < count; ++k) {
    const double sigma = 0.7 * coefficient(path.x, 0, k) + 1.3 * coefficient(path.parameters, traced, k);
    EXPECT_NEAR(sigma, k == 1 ? 1.0 : 0.0, rounding) << k;
  }
}

/// The plane contains the direction of the path. The path does not cross it and has no series in its
/// coordinate.
TEST(Reparametrize, OnAPlaneAlongThePathHasNoSeries) {
  Path path = root_path();
  reparametrize(path, {Vector::Ones(1), -0.5}, traced);
  EXPECT_FALSE(path.x.allFinite());
}

TEST(PlaneAlong, MeasuresScaledLengthAndIsCrossedAtARightAngle) {
  const Path path = root_path();
  for (const PathScales& scales : {PathScales{1.0, 1.0}, PathScales{0.1, 3.0}, PathScales{40.0, 1e-3}}) {
    const PathPlane plane = plane_along(path, traced, scales, 1.0);
    const double length = std::hypot(0.5 / scales.x, 1.0 / scales.p);
    EXPECT_NEAR(plane.x[0] * 0.5 + plane.p, length, rounding * length);
    EXPECT_NEAR(slant(plane, path, traced, scales), 1.0, rounding);
  }
}

TEST(PlaneAlong, BackwardsIsItsOpposite) {
  const PathPlane forwards = plane_along(root_path(), traced, {}, 1.0);
  const PathPlane backwards = plane_along(root_path(), traced, {}, -1.0);
  EXPECT_EQ(backwards.x[0], -forwards.x[0]);
  EXPECT_EQ(backwards.p, -forwards.p);
  EXPECT_NEAR(slant(backwards, root_path(), traced, {}), -1.0, rounding);
}

TEST(PlaneAlong, WhereNothingMovesMeasuresTheParameter) {
  Path path = root_path();
  path.x = Matrix{{1.0}};
  const PathPlane plane = plane_along(path, traced, {2.0, 5.0}, 1.0);
  EXPECT_EQ(plane.x[0], 0.0);
  EXPECT_NEAR(plane.p, 0.2, rounding);
}

TEST(Slant, IsZeroOnAPlaneAlongThePathAndIndependentOfUnits) {
  const Path path = root_path();
  EXPECT_NEAR(slant({Vector::Ones(1), -0.5}, path, traced, {}), 0.0, rounding);
  // 45 degrees between p and a path of slope 1.
  Path steep = path;
  steep.x(0, 1) = 1.0;
  EXPECT_NEAR(slant(in_p, steep, traced, {}), std::sqrt(0.5), rounding);
  // Coordinates in millimetres, and their scale with them.
  steep.x *= 1e3;
  EXPECT_NEAR(slant(in_p, steep, traced, {1e3, 1.0}), std::sqrt(0.5), rounding);
}

/// x = -sqrt(1 - p), a fold at p = 1, seen from a distance d before it: x = -sqrt(d) sqrt(1 - h / d).
Path before_fold(double d) {
  Path path;
  path.x = Matrix::Zero(1, count);
  double binomial = -std::sqrt(d);
  for (Eigen::Index k = 0; k < count; ++k) {
    path.x(0, k) = binomial;
    binomial *= (static_cast<double>(k) - 0.5) / (static_cast<double>(k) + 1.0) / d;
  }
  path.lambda = Matrix::Zero(0, count);
  path.parameters = Matrix{{7.0, 0.0}, {1.0 - d, 1.0}};
  return path;
}

bool turns(const Path& path, double h) {
  Path turned = path;
  reparametrize(turned, plane_along(path, traced, {}, 1.0), traced);
  return falls_faster(turned, path, traced, {}, h);
}

TEST(FallsFaster, BeforeAFoldInTheCoordinateAlongThePath) {
  for (const double d : {1e-2, 1e-4, 1e-6}) {
    EXPECT_TRUE(turns(before_fold(d), 0.7 * d)) << d;
    EXPECT_TRUE(turns(before_fold(d), -0.7 * d)) << d;
  }
}

TEST(FallsFaster, NotOnAPathThatGoesOn) {
  EXPECT_FALSE(turns(before_fold(1e2), 1.0));
  EXPECT_FALSE(turns(root_path(), 0.3));
  Path straight = root_path();
  straight.x = Matrix{{1.0, 0.5, 0.0, 0.0, 0.0, 0.0}};
  EXPECT_FALSE(turns(straight, 1.0));
}

TEST(FallsFaster, IsNotToldByTooShortASeries) {
  Path path = before_fold(1e-4);
  path.x = Matrix(path.x.leftCols(2));
  EXPECT_FALSE(turns(path, 0.7e-4));
}

/// The modes of a family whose equilibrium does not move, in the coordinate 2 p.
TEST(ReparametrizePoint, ScalesEverySeries) {
  Planted family = Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.6, -1.0}, {5.0, 0.3}}));
  PathNode node = family.point(0.0, {{{2.0 * j, 2.6 * j}}, {{5.0 * j}}});
  node.tracks[0].departure = Track::Departure{0.01, node.tracks[0].roots};
  const PathNode before = node;
  reparametrize(node, {Vector::Zero(3), 2.0}, family.problem().traced);
  EXPECT_EQ(node.tracks[0].departure->distance, 0.02);
  EXPECT_EQ(node.tracks[0].roots, before.tracks[0].roots);
  double power = 1.0;
  for (Eigen::Index k = 0; k < before.tracks[0].functions.cols(); ++k, power *= 0.5) {
    const auto i = static_cast<std::size_t>(k);
    for (std::size_t t = 0; t < 2; ++t) {
      const Track& old = before.tracks[t];
      const Track& now = node.tracks[t];
      EXPECT_LT((now.functions.col(k) - power * old.functions.col(k)).norm(), rounding) << k;
      EXPECT_LT((now.series.Lambda[i] - power * old.series.Lambda[i]).norm(), rounding) << k;
      EXPECT_LT((now.series.Z[i] - power * old.series.Z[i]).norm(), rounding) << k;
    }
    if (i < before.pencil.K.size()) {
      EXPECT_LT((node.pencil.K[i] - power * before.pencil.K[i]).norm(), rounding) << k;
    }
  }
}

/// sin(angle) = p, s^2 = -g cos(angle) / length: a system with constraints, close to its fold at p = 1.
class PendulumBeforeItsFold : public testing::Test {
 protected:
  PendulumBeforeItsFold() {
    problem.order = 4;
    node = differentiate_point(problem, point_from_guess(problem, start, counts), counts).value();
  }

  static constexpr double start = 0.9;
  Setting setting = pushed_pendulum({.from = 0.0, .to = 1.2, .guess = 0.9});
  PathProblem problem = setting.problem();
  RunCounts counts;
  PathNode node;
};

TEST_F(PendulumBeforeItsFold, EigenvaluesAreTheSameFunctionOfThePath) {
  const PathPlane plane = plane_along(node.path, problem.traced, {}, 1.0);
  reparametrize(node, plane, problem.traced);
  const auto miss = [&](double sigma) {
    const double p = evaluate_series(node.path.parameters, sigma)[problem.traced];
    const Complex s = j * std::sqrt(9.81 * std::sqrt(1.0 - p * p));
    return std::abs(evaluate_series(node.tracks[0].functions, sigma)[0] - s);
  };
  EXPECT_LT(miss(0.0), rounding);
  // Six coefficients: the remainder falls with the sixth power.
  EXPECT_NEAR(std::log2(miss(0.02) / miss(0.01)), 6.0, 0.5);
}

TEST_F(PendulumBeforeItsFold, ConstraintsBasisAndEquilibriumGoWithIt) {
  reparametrize(node, plane_along(node.path, problem.traced, {}, 1.0), problem.traced);
  const auto residual = [&](double sigma) {
    const Vector x = evaluate_series(node.path.x, sigma);
    const Matrix T = evaluate_series(node.basis.T, sigma);
    // On the circle about the hinge, and the basis along it.
    return std::hypot(x.norm() - 1.0, (x.transpose() * T).norm());
  };
  EXPECT_LT(residual(0.0), rounding);
  EXPECT_GT(std::log2(residual(0.08) / residual(0.04)), 5.5);
}

TEST_F(PendulumBeforeItsFold, BackInTheParameterEverySeriesIsRestored) {
  const PathNode before = node;
  reparametrize(node, plane_along(node.path, problem.traced, {}, 1.0), problem.traced);
  reparametrize(node, {Vector::Zero(3), 1.0}, problem.traced);
  const ComplexMatrix& old = before.tracks[0].functions;
  for (Eigen::Index k = 0; k < old.cols(); ++k) {
    const double size = std::abs(old(0, k));
    EXPECT_LT(std::abs(node.tracks[0].functions(0, k) - old(0, k)), 1e-10 * size) << k;
    const auto i = static_cast<std::size_t>(k);
    EXPECT_LT((node.basis.T[i] - before.basis.T[i]).norm(), 1e-10 * (1.0 + before.basis.T[i].norm())) << k;
  }
  EXPECT_LT(difference(node.path.x, before.path.x), 1e-10 * before.path.x.cwiseAbs().maxCoeff());
}

}  // namespace
}  // namespace eigentrail::test::reparametrize_test
