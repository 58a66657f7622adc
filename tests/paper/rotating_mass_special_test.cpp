// Rotating point mass without a_t, a_n, seed paper Sect. 6.3 and 6.3.1: Eqs. (146) to (160).
#include <gtest/gtest.h>

#include <cmath>

#include "eigentrail/modes/spectrum.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::rotating_mass_special_test {
namespace {

constexpr double tolerance = 1e-12;
constexpr double m = 50.0;
constexpr double e = 1.0;
constexpr double length = 5.0;
constexpr double r = 2.0;
constexpr double omega = 40.0;

const std::vector<std::pair<std::string, std::string>> without_force = {{"-100.0", "0.0"}, {"1000.0", "0.0"}};

/// Square root with positive imaginary part: the pair's member that is stored.
Complex upper_root(double argument) {
  return std::sqrt(Complex(argument));
}

class RotatingMassSpecial : public testing::TestWithParam<double> {
 protected:
  RotatingMassSpecial() : setting(scene_setting("rotating_mass", {}, without_force)) {}

  /// The point with T of Eq. (151) for the parameter alpha.
  PathPoint point_for_alpha() {
    const double alpha = GetParam();
    PathPoint point = point_from_guess(setting.problem(), omega, counts);
    Matrix T(3, 2);
    T << 0.0, 0.0, std::cos(alpha), -std::sin(alpha), std::sin(alpha), std::cos(alpha);
    point.basis = {{T}, false};
    point.pencil = reduce(point.equilibrium.linearization, point.basis, 0);
    const PencilAtPoint pencil(point.pencil);
    for (InvariantPair& pair : point.pairs) {
      InvariantPair start;
      start.Z = ComplexVector::Random(2) + 10.0 * exact_vector(pair.eigenvalue());
      start.Lambda = pair.Lambda * 1.01;
      pair = correct_pair(pencil, start, 1.0, {}, counts.modes);
      EXPECT_EQ(pair.status, PairStatus::converged);
    }
    return point;
  }

  /// Eq. (154): the lag vector is {cos, -sin}, the flap vector {sin, cos}.
  ComplexVector exact_vector(Complex s) const {
    const double alpha = GetParam();
    const bool lag = std::abs(s) < omega;
    ComplexVector z(2);
    z << (lag ? std::cos(alpha) : std::sin(alpha)), (lag ? -std::sin(alpha) : std::cos(alpha));
    return z;
  }

  Setting setting;
  RunCounts counts;
};

TEST_P(RotatingMassSpecial, MultiplierEqualsEq146) {
  const PathPoint point = point_for_alpha();
  const double expected = 0.5 * m * omega * omega * (1.0 + e / length);
  EXPECT_NEAR(point.equilibrium.lambda[0], expected, tolerance * expected);
}

TEST_P(RotatingMassSpecial, ProjectedMatricesEqualEq152) {
  const PathPoint point = point_for_alpha();
  const double c = std::cos(GetParam());
  const double s = std::sin(GetParam());
  Matrix K(2, 2);
  K << s * s + e / length, s * c, s * c, c * c + e / length;
  EXPECT_LT((point.pencil.M[0] - m * Matrix::Identity(2, 2)).norm(), tolerance * m);
  EXPECT_LT((point.pencil.C[0] - r * Matrix::Identity(2, 2)).norm(), tolerance * 2.0 * m * omega);
  EXPECT_LT((point.pencil.K[0] - m * omega * omega * K).norm(), tolerance * m * omega * omega);
}

TEST_P(RotatingMassSpecial, EigensolutionEqualsEq154) {
  const PathPoint point = point_for_alpha();
  ASSERT_EQ(point.pairs.size(), 2U);
  const double half = r / (2.0 * m);
  const Complex lag = -half + upper_root(half * half - omega * omega * e / length);
  const Complex flap = -half + upper_root(half * half - omega * omega * (1.0 + e / length));
  EXPECT_LT(std::abs(point.pairs[0].eigenvalue() - lag), tolerance * std::abs(lag));
  EXPECT_LT(std::abs(point.pairs[1].eigenvalue() - flap), tolerance * std::abs(flap));
  for (const InvariantPair& pair : point.pairs) {
    const double parallel = std::abs(exact_vector(pair.eigenvalue()).dot(pair.Z.col(0))) / pair.Z.norm();
    EXPECT_NEAR(parallel, 1.0, tolerance);
  }
}

TEST_P(RotatingMassSpecial, SensitivityToSpeedEqualsEqs155To160) {
  const PathPoint point = point_for_alpha();
  const PathNode node = differentiate_point(setting.problem(), point, counts).value();
  const double half = r / (2.0 * m);
  const double lag = e / length;
  const double flap = 1.0 + e / length;
  for (const auto& [i, factor] : {std::pair(0, lag), std::pair(1, flap)}) {
    // (155): s_/omega = -omega factor / sqrt(...) for the upper sign of (154).
    const Complex expected = -omega * factor / upper_root(half * half - omega * omega * factor);
    EXPECT_LT(std::abs(node.s(i, 1) - expected), tolerance * std::abs(expected));
    // z_/p = 0 for vectors of constant length and phase: what is left is parallel to the vector.
    const PairSeries& series = node.tracks[static_cast<std::size_t>(i)].series;
    const ComplexVector v = series.Z[0].col(0).normalized();
    const ComplexVector change = series.Z[1].col(0) / series.Z[0].norm();
    EXPECT_LT((change - v * v.dot(change)).norm(), tolerance);
  }
  EXPECT_LT(node.path.x.col(1).norm(), tolerance * length / omega);  // (158)
  const double lambda = m * omega * (1.0 + e / length);
  EXPECT_NEAR(node.path.lambda(0, 1), lambda, tolerance * lambda);
}

INSTANTIATE_TEST_SUITE_P(Alpha, RotatingMassSpecial, testing::Values(0.0, 0.3, 0.785398163397448, 2.0, -1.1));

}  // namespace
}  // namespace eigentrail::test::rotating_mass_special_test
