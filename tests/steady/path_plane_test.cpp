// Equilibria on a plane across the path: at a fold, close to it, and where the parameter alone would suffice.
#include "eigentrail/steady/path_plane.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "eigentrail/core/series.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::path_plane_test {
namespace {

constexpr double tolerance = 1e-12;
constexpr double g = 9.81, m = 2.0, length = 1.5;

/// lambda = m g cos(angle) / (2 length).
Setting pendulum(double unit = 1.0) {
  return pushed_pendulum({.mass = m, .length = length, .unit = unit, .guess = 0.01});
}

/// Two springs of unit stiffness from (-1, 0) and (1, 0) to an apex at height w, without force at w = 0.2.
/// The load is 2 w (L0 / L - 1) with L^2 = 1 + w^2, L0^2 = 1.04; it is largest where L^3 = L0.
Setting von_mises_truss() {
  return make_setting(
      "[parameters]\nload = 0.0\n[trace]\nparameter = \"load\"\nfrom = -0.001\nto = 0.001\n"
      "[[point]]\nname = \"apex\"\nmass = 1.0\nposition = [0, 0, 0.2]\n"
      "[[spring]]\nfrom = [-1, 0, 0]\nto = \"apex\"\nstiffness = 1.0\nfree_length = \"sqrt(1.04)\"\n"
      "[[spring]]\nfrom = [1, 0, 0]\nto = \"apex\"\nstiffness = 1.0\nfree_length = \"sqrt(1.04)\"\n"
      "[[force]]\npoint = \"apex\"\ncomponents = [0, 0, \"-load\"]\n"
      "[[fixed]]\npoint = \"apex\"\ncoordinate = \"y\"\n");
}

template <class Scalar>
Scalar truss_load(const Scalar& w) {
  using std::sqrt;
  return 2.0 * w * (std::sqrt(1.04) / sqrt(1.0 + w * w) - 1.0);
}

const double limit_height = std::sqrt(std::pow(1.04, 1.0 / 3.0) - 1.0);

/// A setting with what a solution on a plane needs.
struct OnPlane {
  explicit OnPlane(Setting given) : setting(std::move(given)), counts(setting.model->new_counts()) {}

  /// From the guess (x, p); the multipliers start at zero.
  Equilibrium solve(const PathPlane& plane, const Vector& x, double guess) {
    p = guess;
    return solve_equilibrium_on(plane, *setting.model, parameters(), traced(), x,
                                Vector::Zero(setting.model->n_constraints()), {}, p, counts);
  }

  Path differentiate(const PathPlane& plane, const Equilibrium& equilibrium, int order) {
    Path path;
    const EvaluationFault fault = differentiate_equilibrium_on(plane, *setting.model, equilibrium,
                                                               parameters(), traced(), order, path, counts);
    if (fault) throw std::runtime_error(fault.source);
    return path;
  }

  Vector parameters() const {
    Vector values = setting.scene.parameters.declared_values();
    values[traced()] = p;
    return values;
  }
  int traced() const { return setting.traced(); }

  Setting setting;
  EvaluationCounts counts;
  double p = 0.0;
};

class PlaneThroughPendulum : public testing::TestWithParam<double> {};

/// A plane z = const meets the circle at one height; p follows from it. At height 0 that is the fold. With
/// the height as coordinate x = sqrt(length^2 - z^2) is a series, also where dp/dz = 0.
TEST_P(PlaneThroughPendulum, SeriesEqualTheClosedForm) {
  constexpr int order = 5;
  const double z0 = GetParam();
  OnPlane on(pendulum());
  const PathPlane plane{Vector{{0.0, 0.0, 1.0}}, 0.0};
  const double x0 = std::sqrt(length * length - z0 * z0);
  const Equilibrium found = on.solve(plane, Vector{{x0 + 0.02, 0.01, z0}}, x0 / length - 0.03);
  ASSERT_EQ(found.status, SteadyStatus::converged) << found.report.message;
  const Path path = on.differentiate(plane, found, order);
  Series<double, order> z(z0);
  z[1] = 1.0;
  const Series<double, order> x = sqrt(length * length - z * z);
  for (int k = 0; k <= order; ++k) {
    const double accuracy = k == 0 ? tolerance : tolerance * 10.0;
    EXPECT_NEAR(path.x(0, k), x[k], accuracy) << "order " << k;
    EXPECT_NEAR(path.x(1, k), 0.0, tolerance) << "order " << k;
    EXPECT_NEAR(path.x(2, k), z[k], tolerance) << "order " << k;
    EXPECT_NEAR(path.parameters(on.traced(), k), x[k] / length, accuracy) << "order " << k;
    EXPECT_NEAR(path.lambda(0, k), -m * g * z[k] / (2.0 * length * length), tolerance * m * g)
        << "order " << k;
  }
}

/// K depends on the multipliers. It must be that of the solution also if the guess of x and p is exact and
/// that of lambda is not.
TEST_P(PlaneThroughPendulum, LinearizationIsThatOfTheSolution) {
  const double z = GetParam();
  OnPlane on(pendulum());
  const PathPlane plane{Vector{{0.0, 0.0, 1.0}}, 0.0};
  const double x = std::sqrt(length * length - z * z);
  const Equilibrium found = on.solve(plane, Vector{{x, 0.0, z}}, x / length);
  ASSERT_EQ(found.status, SteadyStatus::converged) << found.report.message;
  Linearization expected;
  ASSERT_FALSE(on.setting.model->linearize({on.parameters(), found.x, found.lambda}, 0, expected, on.counts));
  EXPECT_LT((found.linearization.K[0].dense() - expected.K[0].dense()).norm(), tolerance * m * g);
}

INSTANTIATE_TEST_SUITE_P(Heights, PlaneThroughPendulum,
                         testing::Values(-1.4, -0.5, -1e-3, -1e-8, 0.0, 1e-8, 1e-3, 0.5));

TEST(PathPlane, SolvesAtTheFoldWhereTheParameterAloneDoesNot) {
  // At a constant p slightly beyond the fold there is no equilibrium. The plane through the same guess has
  // one.
  OnPlane on(pendulum());
  const Vector guess{{1.5, 0.0, -1e-3}};
  const Equilibrium found = on.solve({Vector{{0.0, 0.0, 1.0}}, 0.0}, guess, 1.0 + 1e-6);
  ASSERT_EQ(found.status, SteadyStatus::converged) << found.report.message;
  EXPECT_NEAR(on.p, std::sqrt(1.0 - 1e-6 / 2.25), tolerance);
  on.p = 1.0 + 1e-6;
  const Equilibrium rival =
      solve_equilibrium(*on.setting.model, on.parameters(), guess, Vector(), {}, on.counts);
  EXPECT_NE(rival.status, SteadyStatus::converged);
}

TEST(PathPlane, SeriesInTheParameterDivergeTowardsTheFoldWhereThoseOnThePlaneDoNot) {
  OnPlane on(pendulum());
  const PathPlane plane{Vector{{0.0, 0.0, 1.0}}, 0.0};
  const double z = -1e-4;
  const Equilibrium found = on.solve(plane, Vector{{std::sqrt(2.25 - z * z), 0.0, z}}, 1.0);
  ASSERT_EQ(found.status, SteadyStatus::converged);
  const Path on_plane = on.differentiate(plane, found, 3);
  EXPECT_LT(on_plane.x.col(3).norm(), 1.0);
  VectorSeries direction = VectorSeries::Zero(on.parameters().size(), 2);
  direction.col(0) = on.parameters();
  direction(on.traced(), 1) = 1.0;
  Path rival;
  ASSERT_FALSE(differentiate_equilibrium(*on.setting.model, found, direction, 3, rival, on.counts));
  EXPECT_GT(rival.x.col(3).norm(), 1e10);
}

/// A plane across the path in both x and p: series of order q have an error of order h^(q+1).
TEST(PathPlane, SeriesHaveTheirOrderOnASlantedPlane) {
  const PathPlane plane{Vector{{-0.3, 0.1, 0.8}}, 0.5};
  OnPlane on(pendulum());
  const Equilibrium start = on.solve(plane, Vector{{1.4, 0.0, -0.5}}, 0.9);
  ASSERT_EQ(start.status, SteadyStatus::converged) << start.report.message;
  const double p0 = on.p;
  for (int order = 1; order <= 5; ++order) {
    on.p = p0;
    const Path path = on.differentiate(plane, start, order);
    EXPECT_NEAR(plane(path.x.col(1), path.lambda.col(1), path.parameters(on.traced(), 1)), 1.0, tolerance)
        << "the coordinate is distance";
    const auto miss = [&](double h) {
      const Vector x = evaluate_series(path.x, h);
      const Vector parameters = evaluate_series(path.parameters, h);
      const double target = plane(start.x, start.lambda, p0) + h;
      // From a guess on the plane at that distance.
      Vector guess = x;
      guess += plane.x * ((target - plane(x, Vector(), parameters[on.traced()])) / plane.x.squaredNorm());
      const Equilibrium ahead = on.solve(plane, guess, parameters[on.traced()]);
      if (ahead.status != SteadyStatus::converged) throw std::runtime_error(ahead.report.message);
      return (ahead.x - x).norm() + std::abs(on.p - parameters[on.traced()]);
    };
    EXPECT_NEAR(std::log2(miss(0.1) / miss(0.05)), order + 1.0, 0.4) << "order " << order;
  }
}

class UnitOfTheParameter : public testing::TestWithParam<double> {};

TEST_P(UnitOfTheParameter, ChangesNothingButTheScale) {
  const double unit = GetParam();
  OnPlane on(pendulum(unit));
  const PathPlane plane{Vector{{0.0, 0.0, 1.0}}, 0.0};
  const Equilibrium found = on.solve(plane, Vector{{1.52, 0.0, -0.1}}, 0.97 * unit);
  ASSERT_EQ(found.status, SteadyStatus::converged) << found.report.message;
  EXPECT_NEAR(on.p / unit, std::sqrt(1.0 - 0.01 / 2.25), tolerance);
  const Path path = on.differentiate(plane, found, 2);
  // dp/dz = -z / (length x).
  EXPECT_NEAR(path.parameters(on.traced(), 1) / unit, 0.1 / (length * found.x[0]), tolerance);
}

INSTANTIATE_TEST_SUITE_P(Units, UnitOfTheParameter, testing::Values(1e-9, 1e-3, 1.0, 1e3, 1e9));

class PlaneThroughTruss : public testing::TestWithParam<double> {};

/// The height as coordinate, before, at and behind both limit points.
TEST_P(PlaneThroughTruss, GivesTheLoadAndItsSeriesInClosedForm) {
  constexpr int order = 5;
  const double height = GetParam();
  OnPlane on(von_mises_truss());
  const PathPlane plane{Vector{{0.0, 0.0, 1.0}}, 0.0};
  const Equilibrium found = on.solve(plane, Vector{{1e-3, 0.0, height}}, truss_load(height) + 1e-3);
  ASSERT_EQ(found.status, SteadyStatus::converged) << found.report.message;
  EXPECT_NEAR(found.x[0], 0.0, tolerance);
  EXPECT_NEAR(found.x[2], height, tolerance);
  EXPECT_NEAR(on.p, truss_load(height), tolerance);
  const Path path = on.differentiate(plane, found, order);
  Series<double, order> w(height);
  w[1] = 1.0;
  const Series<double, order> load = truss_load(w);
  for (int k = 1; k <= order; ++k) {
    EXPECT_NEAR(path.parameters(on.traced(), k), load[k], tolerance) << "order " << k;
    EXPECT_NEAR(path.x(2, k), w[k], tolerance) << "order " << k;
  }
}

INSTANTIATE_TEST_SUITE_P(Heights, PlaneThroughTruss,
                         testing::Values(0.25, 0.2, limit_height, 0.05, 0.01, -limit_height, -0.2));

TEST(PathPlane, ThatThePathNeverMeetsIsReported) {
  // The bob cannot rise above its length.
  OnPlane on(pendulum());
  const Equilibrium found = on.solve({Vector{{0.0, 0.0, 1.0}}, 0.0}, Vector{{0.1, 0.0, 2.0}}, 0.5);
  EXPECT_EQ(found.status, SteadyStatus::not_converged);
  EXPECT_FALSE(found.report.message.empty());
}

TEST(PathPlane, ValuesThatAreNotFiniteAreReported) {
  OnPlane on(pendulum());
  const Equilibrium found = on.solve({Vector{{0.0, 0.0, 1.0}}, 0.0}, Vector{{0.0, 0.0, 0.0}}, 0.5);
  EXPECT_EQ(found.status, SteadyStatus::not_finite) << "the force has no direction";
}

}  // namespace
}  // namespace eigentrail::test::path_plane_test
