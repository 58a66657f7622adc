// Invariant pairs where single modes in the finite chart fail: exceptional points, and eigenvalues that pass
// through infinity.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "eigentrail/core/series.hpp"
#include "eigentrail/modes/invariant_pair.hpp"
#include "eigentrail/modes/invariants.hpp"
#include "eigentrail/modes/spectrum.hpp"
#include "modes/single_modes.hpp"
#include "support/families.hpp"

namespace eigentrail::test::special_pairs_test {
namespace {

/// K = [[1, p], [-p, 2]]: s^2 = -3/2 -+ sqrt(1/4 - p^2), an exceptional point at p = 1/2. There s = j
/// sqrt(3/2).
ReducedPencil exceptional_family(double p) {
  return {{Matrix::Identity(2, 2)},
          {Matrix::Zero(2, 2)},
          {Matrix{{1.0, p}, {-p, 2.0}}, Matrix{{0.0, 1.0}, {-1.0, 0.0}}}};
}

/// A block for both upper modes from a start that is off by `offset`.
InvariantPair exceptional_start(double offset) {
  InvariantPair start;
  start.Z = Matrix{{1.0, offset}, {-offset, 1.0}}.cast<Complex>();
  start.Lambda = ComplexMatrix::Zero(2, 2);
  start.Lambda.diagonal() << Complex(0.0, 1.2247 + offset), Complex(0.0, 1.2247 - offset);
  return start;
}

TEST(ExceptionalPoint, TwoSinglesDoNotConvergeToRounding) {
  // Newton's method at a double root halves the error in every step, and ends at the square root of rounding.
  const ReducedPencil pencil = exceptional_family(0.5);
  const Complex s(0.0, std::sqrt(1.5));
  for (const double side : {-1.0, 1.0}) {
    ModeCounts counts;
    const ComplexVector z{{Complex(1.0), Complex(1.0 - 0.2 * side)}};
    const InvariantPair mode = correct_mode(PencilAtPoint(pencil), s * (1.0 + 0.05 * side), z, counts);
    EXPECT_TRUE(mode.status != PairStatus::converged || mode.condition > 1e6);
    EXPECT_GT(std::abs(mode.eigenvalue() - s), 1e-11) << "as good as the block";
  }
}

/// s1 + s2 and s1 s2 in closed form: tau^2 + delta = -3/2 and tau^2 - delta = -sqrt(2 + p^2).
TEST(ExceptionalPoint, SeriesOfTheInvariantsEqualTheClosedForm) {
  constexpr int order = 5;
  for (const double p0 : {0.3, 0.4999999, 0.5, 0.5000001, 0.7}) {
    const ReducedPencil family = exceptional_family(p0);
    const ReducedPencil pencil = at(family, 0.0);
    ModeCounts counts;
    const InvariantPair pair =
        correct_pair(PencilAtPoint(pencil), exceptional_start(0.05), s_ref, {}, counts);
    ASSERT_EQ(pair.status, PairStatus::converged) << "p = " << p0;
    const ComplexMatrix functions = block_functions(differentiate_pair(family, pair, order, counts).Lambda);
    Series<double, order> p(p0);
    p[1] = 1.0;
    const Series<double, order> root = sqrt(2.0 + p * p);
    const Series<double, order> tau = sqrt(0.5 * (1.5 + root));  // times j
    const Series<double, order> delta = 0.5 * (root - 1.5);
    for (int k = 0; k <= order; ++k) {
      EXPECT_LT(std::abs(functions(0, k) - Complex(0.0, tau[k])), tolerance)
          << "tau, order " << k << ", p = " << p0;
      EXPECT_LT(std::abs(functions(1, k) - delta[k]), tolerance) << "delta, order " << k << ", p = " << p0;
    }
  }
}

TEST(ExceptionalPoint, SeriesOfASingleDivergeWhereThoseOfTheBlockDoNot) {
  // Close to the exceptional point, the coefficients of the single eigenvalue grow like those of sqrt(delta).
  const ReducedPencil family = exceptional_family(0.5 - 1e-6);
  const ReducedPencil pencil = at(family, 0.0);
  const Spectrum spectrum = compute_spectrum(pencil.M[0], pencil.C[0], pencil.K[0]);
  ModeCounts counts;
  const InvariantPair mode =
      correct_mode(PencilAtPoint(pencil), spectrum.modes[0].s, spectrum.modes[0].z, counts);
  ASSERT_EQ(mode.status, PairStatus::converged);
  EXPECT_GT(differentiate_pair(family, mode, 4, counts).Lambda[4].norm(), 1e15);
  const InvariantPair pair = correct_pair(PencilAtPoint(pencil), exceptional_start(0.05), s_ref, {}, counts);
  EXPECT_LT(block_functions(differentiate_pair(family, pair, 4, counts).Lambda).col(4).norm(), 1.0);
}

/// K = I + [[0, 1, 0], [0, 0, 1], [p, 0, 0]]: s^2 = -(1 + p^(1/3)), a triple exceptional point at p = 0.
ReducedPencil triple_family(double p) {
  Matrix slope = Matrix::Zero(3, 3);
  slope(2, 0) = 1.0;
  return {{Matrix::Identity(3, 3)},
          {Matrix::Zero(3, 3)},
          {Matrix{{1.0, 1.0, 0.0}, {0.0, 1.0, 1.0}, {p, 0.0, 1.0}}, slope}};
}

TEST(ExceptionalPoint, BlockOfThreeConvergesToRoundingAtATripleOne) {
  const ReducedPencil family = triple_family(0.0);
  const ReducedPencil pencil = at(family, 0.0);
  InvariantPair start;
  start.Z = ComplexMatrix::Identity(3, 3);
  start.Z.array() += Complex(0.03, 0.01);
  start.Lambda = ComplexMatrix::Zero(3, 3);
  start.Lambda.diagonal() << Complex(0.02, 1.0), Complex(-0.01, 1.03), Complex(-0.01, 0.97);
  start.Lambda.diagonal(1).setConstant(Complex(0.0, 0.5));
  ModeCounts counts;
  const InvariantPair pair = correct_pair(PencilAtPoint(pencil), start, s_ref, {}, counts);
  ASSERT_EQ(pair.status, PairStatus::converged);
  EXPECT_LT(pair.backward_error, rounding);
  const ComplexMatrix N = pair.Lambda - Complex(0.0, 1.0) * ComplexMatrix::Identity(3, 3);
  EXPECT_LT((N * N * N).norm(), 1e-13) << "nilpotent";
  EXPECT_GT((N * N).norm(), 0.05) << "one Jordan chain";
  // det s_i = j^3 sqrt(det(-Lambda^2)) = -j sqrt(1 + p): smooth where the eigenvalues are not.
  const PairSeries series = differentiate_pair(family, pair, 4, counts);
  const auto determinant = [&](double h) {
    ComplexMatrix Lambda = ComplexMatrix::Zero(3, 3);
    for (std::size_t k = 5; k-- > 0;) Lambda = Lambda * h + series.Lambda[k];
    return Lambda.determinant();
  };
  const auto miss = [&](double h) { return std::abs(determinant(h) + Complex(0.0, std::sqrt(1.0 + h))); };
  EXPECT_LT(miss(0.0), 1e-13);
  EXPECT_NEAR(std::log2(miss(0.08) / miss(0.04)), 5.0, 0.5);
}

/// Series of tau and delta at a point where both eigenvalues are zero or nearly so.
ComplexMatrix functions_near_zero(const ReducedPencil& family, const InvariantPair& start, int order) {
  const ReducedPencil pencil = at(family, 0.0);
  ModeCounts counts;
  const InvariantPair pair = correct_pair(PencilAtPoint(pencil), start, s_ref, {}, counts);
  EXPECT_EQ(pair.status, PairStatus::converged);
  return block_functions(differentiate_pair(family, pair, order, counts).Lambda);
}

/// s^2 = -(k + p): a pair comes down to zero and parts into a growing and a decaying mode. tau = 0, delta =
/// -(k + p).
TEST(PairAtZero, OfOneFreedomKeepsTheDigitsOfItsSeries) {
  for (const double k : {0.0, 1e-16, 1e-12, 1e-9, 1e-6, -1e-9}) {
    const ReducedPencil family{{Matrix{{1.0}}}, {Matrix{{0.0}}}, {Matrix{{k}}, Matrix{{1.0}}}};
    InvariantPair start;
    start.is_real = true;
    start.Z = ComplexMatrix::Zero(1, 2);
    start.Z(0, 0) = 1.0;
    start.Lambda = ComplexMatrix::Zero(2, 2);
    start.Lambda(0, 1) = 1.0;
    const ComplexMatrix functions = functions_near_zero(family, start, 5);
    for (Eigen::Index i = 0; i <= 5; ++i) {
      const double delta = i == 0 ? -k : i == 1 ? -1.0 : 0.0;
      EXPECT_LT(std::abs(functions(0, i)), tolerance) << "tau, order " << i << ", k = " << k;
      EXPECT_LT(std::abs(functions(1, i) - delta), tolerance) << "delta, order " << i << ", k = " << k;
    }
  }
}

/// A whirl in a frame that turns at w = 5 + h, its natural frequency: s = +-j (5 - w), two vectors at a
/// double zero. tau = 0, delta = -h^2.
TEST(PairAtZero, OfAWhirlKeepsTheDigitsOfItsSeries) {
  const Matrix I = Matrix::Identity(2, 2);
  const Matrix J{{0.0, -1.0}, {1.0, 0.0}};
  for (const double h : {0.0, 1e-12, 1e-9, 1e-6}) {
    const double w = 5.0 + h;
    const ReducedPencil family{{I}, {2.0 * w * J, 2.0 * J}, {(25.0 - w * w) * I, -2.0 * w * I, -1.0 * I}};
    for (const double offset : {0.0, 1e-15, 1e-9}) {
      InvariantPair start;
      start.is_real = true;
      start.Z = I.cast<Complex>();
      start.Lambda = (offset * J).cast<Complex>();
      const ComplexMatrix functions = functions_near_zero(family, start, 5);
      const double delta[] = {-h * h, -2.0 * h, -1.0, 0.0, 0.0, 0.0};
      for (Eigen::Index i = 0; i <= 5; ++i) {
        EXPECT_LT(std::abs(functions(0, i)), tolerance) << "tau, order " << i << ", h = " << h;
        EXPECT_LT(std::abs(functions(1, i) - delta[i]), tolerance) << "delta, order " << i << ", h = " << h;
      }
    }
  }
}

/// p s^2 + 3 s + 2 = 0: one root goes to infinity like -3 / p. mu = 1/s solves 2 mu^2 + 3 mu + p = 0.
TEST(ReciprocalChart, FollowsAnEigenvalueThroughInfinityWhereTheMassIsSingular) {
  constexpr int order = 4;
  const ReducedPencil family{{Matrix{{0.0}}, Matrix{{1.0}}}, {Matrix{{3.0}}}, {Matrix{{2.0}}}};
  ModeCounts counts;
  InvariantPair start = start_at(-1e-3, ComplexVector::Ones(1));
  start.chart = Chart::reciprocal;
  const PencilAtPoint point(family, Chart::reciprocal);
  const InvariantPair pair = correct_pair(point, start, s_ref, {}, counts);
  ASSERT_EQ(pair.status, PairStatus::converged);
  EXPECT_EQ(pair.chart, Chart::reciprocal);
  EXPECT_LT(std::abs(pair.Lambda(0, 0)), 1e-16);
  const PairSeries series = differentiate_pair(family, pair, order, counts);
  Series<double, order> p(0.0);
  p[1] = 1.0;
  const Series<double, order> expected = 0.25 * (sqrt(9.0 - 8.0 * p) - 3.0);
  for (int k = 0; k <= order; ++k) {
    const Complex found = series.Lambda[static_cast<std::size_t>(k)](0, 0);
    EXPECT_NEAR(found.real(), expected[k], tolerance) << "order " << k;
    EXPECT_EQ(found.imag(), 0.0);
  }
  // For comparison: in the finite chart the same start can converge only to the other root.
  const InvariantPair finite = correct_mode(PencilAtPoint(family), -1e3, ComplexVector::Ones(1), counts);
  EXPECT_TRUE(finite.status != PairStatus::converged ||
              std::abs(finite.eigenvalue() + 2.0 / 3.0) < tolerance);
}

TEST(ReciprocalChart, HoldsTheReciprocalEigenvalues) {
  const ReducedPencil pencil = at(random_family(6, 2), 0.0);
  const PencilAtPoint reciprocal(pencil, Chart::reciprocal);
  ModeCounts counts;
  for (const StartingMode& mode : compute_spectrum(pencil.M[0], pencil.C[0], pencil.K[0]).modes) {
    InvariantPair start = start_at(1.001 / mode.s, mode.z);
    start.chart = Chart::reciprocal;
    const InvariantPair near = correct_pair(reciprocal, start, s_ref, {}, counts);
    ASSERT_EQ(near.status, PairStatus::converged);
    EXPECT_LT(std::abs(near.eigenvalue() * mode.s - 1.0), tolerance);
    // A relative condition number is the same in both charts. Both are taken with factors at the pair.
    const InvariantPair pair = correct_pair(reciprocal, near, s_ref, {}, counts);
    const InvariantPair finite = correct_mode(PencilAtPoint(pencil), mode.s, mode.z, counts);
    EXPECT_NEAR(pair.condition, finite.condition, 1e-10 * finite.condition);
  }
}

}  // namespace
}  // namespace eigentrail::test::special_pairs_test
