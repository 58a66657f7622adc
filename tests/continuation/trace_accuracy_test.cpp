// Accuracy of the dense output compared with an independent solution, and the number of points needed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

#include "support/scenes.hpp"
#include "support/spectra.hpp"

namespace eigentrail::test::trace_accuracy_test {
namespace {

/// Rotating mass solved by hand: Newton on Eq. (144), a Householder basis, QZ. `x` (relative to the hinge) is
/// the guess and returns the equilibrium.
std::vector<Complex> independent_spectrum(double omega, Vector& x) {
  constexpr double m = 50.0, r = 2.0, length = 5.0, e = 1.0, a_t = -100.0, a_n = 1000.0;
  const Matrix I = Matrix::Identity(3, 3);
  const Matrix K = -m * omega * omega * Matrix(Vector{{1.0, 1.0, 0.0}}.asDiagonal()) +
                   Matrix{{0.0, a_t, a_n}, {-a_t, 0.0, 0.0}, {-a_n, 0.0, 0.0}};
  Vector u(4);
  u << x, -x.dot(K * x - Vector{{m * omega * omega * e, 0.0, 0.0}}) / (2.0 * length * length);
  for (int i = 0; i < 30; ++i) {
    Vector F(4);
    F << 2.0 * u[3] * u.head(3) + K * u.head(3) - Vector{{m * omega * omega * e, 0.0, 0.0}},
        u.head(3).squaredNorm() - length * length;
    Matrix J = Matrix::Zero(4, 4);
    J.topLeftCorner(3, 3) = K + 2.0 * u[3] * I;
    J.topRightCorner(3, 1) = 2.0 * u.head(3);
    J.bottomLeftCorner(1, 3) = 2.0 * u.head(3).transpose();
    u -= J.fullPivLu().solve(F);
  }
  x = u.head(3);
  Vector v = x / length;
  v[0] += v[0] >= 0.0 ? 1.0 : -1.0;
  const Matrix T = (I - 2.0 / v.squaredNorm() * v * v.transpose()).rightCols(2);
  Matrix C = r * I;
  C(0, 1) = -2.0 * m * omega;
  C(1, 0) = 2.0 * m * omega;
  return quadratic_eigenvalues(m * T.transpose() * T, T.transpose() * C * T,
                               T.transpose() * (K + 2.0 * u[3] * I) * T);
}

struct AccuracyCase {
  double tolerance;
  int order;
  int most_nodes;
};

class TraceAccuracy : public testing::TestWithParam<AccuracyCase> {};

TEST_P(TraceAccuracy, HoldsAtRandomSpeedsWithFewPoints) {
  const AccuracyCase& c = GetParam();
  std::ostringstream tolerance;
  tolerance << c.tolerance;
  const RecordedTrace recorded = completed_trace(
      scene_setting("rotating_mass", {{"tolerance", tolerance.str()}, {"order", std::to_string(c.order)}}));
  EXPECT_LE(recorded.result.nodes, c.most_nodes);

  std::mt19937_64 engine(20240501);
  std::uniform_real_distribution<double> uniform(5.0, 100.0);
  std::vector<double> speeds(200);
  for (double& omega : speeds) omega = uniform(engine);
  std::sort(speeds.rbegin(), speeds.rend());
  Vector x{{5.0, 0.0, 0.0}};
  double worst = 0.0;
  for (const double omega : speeds) {
    const std::vector<Complex> exact = independent_spectrum(omega, x);
    ASSERT_EQ(exact.size(), 4U);
    const ComplexVector found = recorded.eigenvalues_at(omega);
    // Never swapped: on this range the lag frequency stays below the flap frequency.
    EXPECT_LT(found[0].imag(), found[1].imag());
    for (const Complex s : found) {
      const double error = relative_distance(s, exact);
      worst = std::max(worst, error);
      EXPECT_LT(error, c.tolerance) << "at " << omega;
    }
  }
  RecordProperty("worst_error_over_tolerance", std::to_string(worst / c.tolerance));
  RecordProperty("nodes", recorded.result.nodes);
}

// Points: at most 1.5 times those of a cubic-Hermite prototype (order 1), 45, 106, 341, 815; higher orders
// need fewer.
INSTANTIATE_TEST_SUITE_P(
    RotatingMass, TraceAccuracy,
    testing::Values(AccuracyCase{1e-4, 1, 67}, AccuracyCase{1e-6, 1, 159}, AccuracyCase{1e-8, 1, 511},
                    AccuracyCase{1e-10, 1, 1222}, AccuracyCase{1e-4, 2, 30}, AccuracyCase{1e-6, 2, 50},
                    AccuracyCase{1e-8, 2, 80}, AccuracyCase{1e-10, 2, 160}, AccuracyCase{1e-4, 3, 25},
                    AccuracyCase{1e-6, 3, 35}, AccuracyCase{1e-8, 3, 50}, AccuracyCase{1e-10, 3, 75},
                    AccuracyCase{1e-4, 4, 25}, AccuracyCase{1e-6, 4, 30}, AccuracyCase{1e-8, 4, 40},
                    AccuracyCase{1e-10, 4, 50}),
    [](const auto& tested) {
      return "Tolerance1e" +
             std::to_string(static_cast<int>(-std::round(std::log10(tested.param.tolerance)))) + "Order" +
             std::to_string(tested.param.order);
    });

/// Factorizations per mode and point. Points computed to locate events count as well.
double factorizations_per_point(const TraceResult& result) {
  int points = result.nodes;
  for (const Event& event : result.events) points += event.retrackings;
  return static_cast<double>(result.counts.modes.factorizations) /
         (result.n_modes * static_cast<double>(points));
}

TEST(TraceWork, OneFactorizationPerModeAndStep) {
  for (const char* tolerance : {"1e-6", "1e-8", "1e-10"}) {
    const RecordedTrace recorded = record_trace(scene_setting("rotating_mass", {{"tolerance", tolerance}}));
    EXPECT_LE(factorizations_per_point(recorded.result), 1.10) << "tolerance " << tolerance;
  }
}

}  // namespace
}  // namespace eigentrail::test::trace_accuracy_test
