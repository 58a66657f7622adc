// A user's own model: derivatives of its force and mass by automatic differentiation.
#include "eigentrail/model/force_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/traced_path.hpp"

namespace eigentrail::test::force_model_test {
namespace {

/// Two freedoms with closed derivatives: M = diag(1, 2 + p^2), f = {-p^2 x0 + x1 rate1 - 3 rate0, -sin(x1) +
/// p x0^2}.
struct Closed {
  static constexpr int freedoms = 2;

  template <class Scalar>
  GeneralizedMass<Scalar, 2> mass(const GeneralizedState<Scalar, 2>& at) const {
    GeneralizedMass<Scalar, 2> M = GeneralizedMass<Scalar, 2>::Zero();
    M(0, 0) = Scalar(1.0);
    M(1, 1) = 2.0 + at.p[0] * at.p[0];
    return M;
  }

  template <class Scalar>
  GeneralizedForce<Scalar, 2> force(const GeneralizedState<Scalar, 2>& at) const {
    using std::sin;
    const auto& [x, v, p] = at;
    return {x[1] * v[1] - p[0] * p[0] * x[0] - 3.0 * v[0], p[0] * x[0] * x[0] - sin(x[1])};
  }
};

/// A bead on a spinning hoop: x'' = (w^2 cos x - g) sin x - 2 d x'; cos x0 = g/w^2.
struct Bead {
  static constexpr int freedoms = 1;
  static constexpr Contribution contribution{.inertia = true, .conservative = true, .dissipative = true};

  template <class Scalar>
  GeneralizedMass<Scalar, 1> mass(const GeneralizedState<Scalar, 1>&) const {
    return GeneralizedMass<Scalar, 1>(Scalar(1.0));
  }
  template <class Scalar>
  GeneralizedForce<Scalar, 1> force(const GeneralizedState<Scalar, 1>& at) const {
    using std::cos, std::sin, std::log;
    const Scalar& x = at.x[0];
    const Scalar& w = at.p[0];
    return GeneralizedForce<Scalar, 1>((w * w * cos(x) - 9.81) * sin(x) - 0.2 * at.rate[0]);
  }
};

/// A force that is not defined left of x = 0.
struct Logarithm : Bead {
  template <class Scalar>
  GeneralizedForce<Scalar, 1> force(const GeneralizedState<Scalar, 1>& at) const {
    using std::log;
    return GeneralizedForce<Scalar, 1>(log(at.x[0]) - at.p[0]);
  }
};

const Parameters one_parameter({{"p", 2.0, ""}});

/// x = (0.3 + h, 0.5 - 2 h), p = 2 + h.
Path straight_path() {
  Path path;
  path.parameters = (Matrix(1, 2) << 2.0, 1.0).finished();
  path.x = (Matrix(2, 2) << 0.3, 1.0, 0.5, -2.0).finished();
  path.lambda = Matrix(0, 1);
  return path;
}

TEST(ForceModel, MatricesAreTheDerivativesAlongThePath) {
  const ForceModel<Closed> model({}, one_parameter, {"a", "b"}, Vector::Zero(2));
  EvaluationCounts counts = model.new_counts();
  Linearization at;
  ASSERT_FALSE(model.linearize(straight_path(), 2, at, counts));
  EXPECT_EQ(counts.linearization[0], 4u);
  const auto expect = [](const SystemMatrix& found, std::initializer_list<double> entries) {
    Matrix expected(2, 2);
    auto value = entries.begin();
    for (Eigen::Index i = 0; i < 4; ++i) expected(i / 2, i % 2) = *value++;
    EXPECT_LT((found.dense() - expected).norm(), 1e-14 * std::max(1.0, expected.norm())) << found.dense();
  };
  // p^2 = 4 + 4 h + h^2; p x0 = (2 + h) (0.3 + h); cos(0.5 - 2 h) = cos + 2 sin h - 2 cos h^2.
  const double c = std::cos(0.5), s = std::sin(0.5);
  expect(at.M[0], {1, 0, 0, 6});
  expect(at.M[1], {0, 0, 0, 4});
  expect(at.M[2], {0, 0, 0, 1});
  expect(at.C[0], {3, -0.5, 0, 0});
  expect(at.C[1], {0, 2, 0, 0});
  expect(at.K[0], {4, 0, -2 * 0.6, c});
  expect(at.K[1], {4, 0, -2 * 2.3, 2 * s});
  expect(at.K[2], {1, 0, -2 * 1.0, -2 * c});
}

TEST(ForceModel, ResidualIsTheForceAtRest) {
  const ForceModel<Closed> model({}, one_parameter, {"a", "b"}, Vector::Zero(2));
  EvaluationCounts counts = model.new_counts();
  SteadyResidual residual;
  ASSERT_FALSE(model.residual(straight_path(), 1, residual, counts));
  // p^2 x0 = (4 + 4 h) (0.3 + h) + ...; p x0^2 = (2 + h) (0.09 + 0.6 h) + ...
  EXPECT_NEAR(residual.force(0, 0), 1.2, 1e-14);
  EXPECT_NEAR(residual.force(0, 1), 5.2, 1e-14);
  EXPECT_NEAR(residual.force(1, 0), std::sin(0.5) - 0.18, 1e-14);
  EXPECT_NEAR(residual.force(1, 1), -2.0 * std::cos(0.5) - (0.09 + 1.2), 1e-14);
  EXPECT_EQ(residual.constraint.rows(), 0);
}

TEST(ForceModel, TraceFollowsTheBeadOnAHoop) {
  const ForceModel<Bead> model({}, Parameters({{"w", 8.0, "rpm", 0.75}}), {"angle"},
                               Vector::Constant(1, 1.3));
  TraceOptions options;
  options.parameter = "w";
  options.from = 8.0;  // w = 6 rad/s
  options.to = 5.0;    // 3.75 rad/s, still above sqrt(9.81)
  options.tolerance = 1e-9;
  int points = 0;
  TraceObserver observer;
  observer.point = [&](const TracePoint& point) {
    const double w = 0.75 * point.node.p;
    const double cosine = 9.81 / (w * w);
    EXPECT_NEAR(std::cos(point.node.path.x(0, 0)), cosine, 1e-12);
    const double stiffness = w * w * (1.0 - cosine * cosine);
    EXPECT_NEAR(std::abs(point.modes[0].s - Complex(-0.1, std::sqrt(stiffness - 0.01))), 0.0, 1e-11);
    ++points;
    return true;
  };
  const TraceResult result = trace(model, options, observer);
  EXPECT_EQ(result.status, TraceStatus::completed) << result.message;
  EXPECT_GT(points, 2);
}

TEST(ForceModel, NumbersThatAreNotFiniteAreToldNotUsed) {
  const ForceModel<Logarithm> model({}, one_parameter, {"a"}, Vector::Constant(1, -1.0));
  EvaluationCounts counts = model.new_counts();
  Path path = straight_path();
  path.x = Matrix::Constant(1, 1, -1.0);
  SteadyResidual residual;
  EXPECT_EQ(model.residual(path, 1, residual, counts).source, "the force");
  const TraceResult result = trace(model, options_on(0.0, 1.0), {});
  EXPECT_EQ(result.status, TraceStatus::no_equilibrium);
  EXPECT_FALSE(result.message.empty());
}

TEST(ForceModel, SizesThatDifferAreRefused) {
  EXPECT_THROW(ForceModel<Closed>({}, one_parameter, {"a"}, Vector::Zero(2)), std::invalid_argument);
  EXPECT_THROW(ForceModel<Closed>({}, one_parameter, {"a", "b"}, Vector::Zero(3)), std::invalid_argument);
}

}  // namespace
}  // namespace eigentrail::test::force_model_test
