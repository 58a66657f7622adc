#include "eigentrail/modes/mode.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "eigentrail/modes/spectrum.hpp"
#include "support/families.hpp"
#include "support/spectra.hpp"

namespace eigentrail::test {
namespace {

constexpr double tolerance = 1e-12;
constexpr double s_ref = 1e-3;

ReducedPencil single(double m, double c, double k) {
  return {{Matrix{{m}}}, {Matrix{{c}}}, {Matrix{{k}}}};
}

TEST(Mode, SingleFreedomEqualsTheClosedForm) {
  const ReducedPencil pencil = single(2.0, 0.4, 50.0);
  const PencilAtPoint point(pencil);
  ModeCounts counts;
  const Mode mode = correct_mode(point, {-0.2, 4.7}, ComplexVector::Ones(1), s_ref, {}, counts);
  ASSERT_EQ(mode.status, ModeStatus::converged);
  const Complex expected(-0.1, std::sqrt(25.0 - 0.01));
  EXPECT_LT(std::abs(mode.s - expected), tolerance * std::abs(expected));
}

TEST(Mode, RealRootStaysExactlyReal) {
  const ReducedPencil pencil = single(1.0, 3.0, 1.0);
  const PencilAtPoint point(pencil);
  ModeCounts counts;
  const Mode mode = correct_mode(point, -0.4, ComplexVector::Ones(1), s_ref, {}, counts);
  ASSERT_EQ(mode.status, ModeStatus::converged);
  EXPECT_NEAR(mode.s.real(), (-3.0 + std::sqrt(5.0)) / 2.0, tolerance);
  EXPECT_EQ(mode.s.imag(), 0.0);
}

class ModeOfFamily : public testing::TestWithParam<unsigned> {
 protected:
  ReducedPencil family = random_family(6, GetParam());
  ReducedPencil start = at(family, 0.0);
  ModeCounts counts;
};

TEST_P(ModeOfFamily, CorrectsAPerturbedPairWithOneFactorization) {
  const PencilAtPoint point(start);
  for (const StartingMode& exact : compute_spectrum(start.M[0], start.C[0], start.K[0]).modes) {
    ModeCounts one;
    ComplexVector z = exact.z;
    z += 1e-4 * ComplexVector::Ones(6);
    const Mode mode = correct_mode(point, exact.s * Complex(1.0, 1e-4), z, s_ref, {}, one);
    ASSERT_EQ(mode.status, ModeStatus::converged);
    EXPECT_LT(std::abs(mode.s - exact.s), tolerance * std::abs(exact.s));
    EXPECT_EQ(one.factorizations, 1U);
    EXPECT_LT(mode.backward_error, 1e-15);
  }
}

TEST_P(ModeOfFamily, LeftVectorAnnihilatesThePencil) {
  const PencilAtPoint point(start);
  for (const StartingMode& exact : compute_spectrum(start.M[0], start.C[0], start.K[0]).modes) {
    const Mode mode = correct_mode(point, exact.s * 1.001, exact.z, s_ref, {}, counts);
    EXPECT_LT((mode.y.adjoint() * point.matrix(mode.s)).norm(), 1e-13 * point.magnitude(mode.s));
  }
}

/// Sensitivities of order q predict the eigenpair ahead up to h^(q+1).
TEST_P(ModeOfFamily, SeriesHaveTheirOrder) {
  const PencilAtPoint point(start);
  for (const StartingMode& exact : compute_spectrum(start.M[0], start.C[0], start.K[0]).modes) {
    const Mode mode = correct_mode(point, exact.s, exact.z, s_ref, {}, counts);
    const ModeSeries series = differentiate_mode(family, mode, 4, counts);
    const auto miss = [&](int order, double h) {
      const ReducedPencil ahead = at(family, h);
      const ComplexVector s = evaluate_series(series.s.head(order + 1).transpose(), h);
      const ComplexVector z = evaluate_series(series.z.leftCols(order + 1), h);
      const Mode corrected = correct_mode(PencilAtPoint(ahead), s[0], z, s_ref, {}, counts);
      const ComplexVector vector = corrected.z / mode.c.dot(corrected.z);  // the gauge of the series
      return std::abs(corrected.s - s[0]) + (vector - z).norm();
    };
    for (int order = 1; order <= 4; ++order) {
      const double h = 0.02 / (1.0 + std::abs(series.s[1] / series.s[0]) * 10.0);
      EXPECT_NEAR(std::log2(miss(order, h) / miss(order, h / 2)), order + 1.0, 0.4) << "order " << order;
    }
  }
}

TEST_P(ModeOfFamily, FirstDerivativeEqualsTheLeftRightQuotient) {
  const PencilAtPoint point(start);
  for (const StartingMode& exact : compute_spectrum(start.M[0], start.C[0], start.K[0]).modes) {
    const Mode mode = correct_mode(point, exact.s, exact.z, s_ref, {}, counts);
    const Complex s = mode.s;
    const ComplexMatrix dP =
        s * s * family.M[1].cast<Complex>() + s * family.C[1].cast<Complex>() + family.K[1].cast<Complex>();
    const Complex expected = -mode.y.dot(dP * mode.z) / mode.y.dot(point.slope(s, mode.z));
    const Complex found = differentiate_mode(family, mode, 1, counts).s[1];
    EXPECT_LT(std::abs(found - expected), 1e-11 * std::abs(expected));
  }
}

TEST_P(ModeOfFamily, ConditionNumberBoundsThePerturbation) {
  const PencilAtPoint point(start);
  std::mt19937_64 engine(GetParam() + 100);
  for (const StartingMode& exact : compute_spectrum(start.M[0], start.C[0], start.K[0]).modes) {
    const Mode mode = correct_mode(point, exact.s, exact.z, s_ref, {}, counts);
    const double epsilon = 1e-7;
    double worst = 0.0;
    for (int trial = 0; trial < 20; ++trial) {
      const auto perturbed = [&](const Matrix& B) {
        const Matrix E = random_matrix(6, 6, engine);
        return Matrix(B + epsilon * B.norm() / E.norm() * E);
      };
      const ReducedPencil near{{perturbed(start.M[0])}, {perturbed(start.C[0])}, {perturbed(start.K[0])}};
      const Mode moved = correct_mode(PencilAtPoint(near), mode.s, mode.z, s_ref, {}, counts);
      worst = std::max(worst, std::abs(moved.s - mode.s) / std::abs(mode.s) / epsilon);
    }
    EXPECT_LT(worst, 1.01 * mode.condition);
    EXPECT_GT(worst, 0.01 * mode.condition) << "a bound that is never approached says nothing";
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, ModeOfFamily, testing::Range(1U, 6U));

TEST(Mode, DefectiveEigenvalueIsIllConditionedOrRefused) {
  // K = [[1, 1/2], [-1/2, 2]]: the exceptional point s = j 1.2247448713915890.
  const ReducedPencil pencil{
      {Matrix::Identity(2, 2)}, {Matrix::Zero(2, 2)}, {Matrix{{1.0, 0.5}, {-0.5, 2.0}}}};
  ModeCounts counts;
  const ComplexVector z{{Complex(1.0), Complex(0.8)}};
  const Mode mode = correct_mode(PencilAtPoint(pencil), {0.0, 1.2}, z, s_ref, {}, counts);
  EXPECT_TRUE(mode.status != ModeStatus::converged || mode.condition > 1e6);
}

TEST(Mode, FarGuessIsReportedNotReturnedAsConverged) {
  const ReducedPencil start = at(random_family(6, 1), 0.0);
  ModeCounts counts;
  CorrectorOptions options;
  options.max_iterations = 3;
  const Mode mode =
      correct_mode(PencilAtPoint(start), {50.0, 90.0}, ComplexVector::Ones(6), s_ref, options, counts);
  EXPECT_NE(mode.status, ModeStatus::converged);
}

}  // namespace
}  // namespace eigentrail::test
