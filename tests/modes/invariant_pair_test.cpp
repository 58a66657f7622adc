#include "eigentrail/modes/invariant_pair.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <cmath>

#include "eigentrail/modes/invariants.hpp"
#include "eigentrail/modes/regroup.hpp"
#include "eigentrail/modes/spectrum.hpp"
#include "modes/single_modes.hpp"
#include "support/families.hpp"
#include "support/spectra.hpp"

namespace eigentrail::test::invariant_pair_test {
namespace {

ReducedPencil single(double m, double c, double k) {
  return {{Matrix{{m}}}, {Matrix{{c}}}, {Matrix{{k}}}};
}

/// |W0^H Z + W1^H Z Lambda - I|.
double normalization_defect(const InvariantPair& pair, const ComplexMatrix& Z, const ComplexMatrix& Lambda) {
  const Eigen::Index n = Z.rows();
  return (pair.W.topRows(n).adjoint() * Z + pair.W.bottomRows(n).adjoint() * Z * Lambda -
          ComplexMatrix::Identity(Z.cols(), Z.cols()))
      .norm();
}

std::vector<Complex> eigenvalues(const InvariantPair& pair) {
  const ComplexVector values = pair_eigenvalues(pair);
  return {values.begin(), values.end()};
}

TEST(InvariantPair, RealRootStaysExactlyReal) {
  const ReducedPencil pencil = single(1.0, 3.0, 1.0);
  const PencilAtPoint point(pencil);
  ModeCounts counts;
  const InvariantPair pair = correct_mode(point, -0.4, ComplexVector::Ones(1), counts);
  ASSERT_EQ(pair.status, PairStatus::converged);
  EXPECT_NEAR(pair.eigenvalue().real(), (-3.0 + std::sqrt(5.0)) / 2.0, tolerance);
  EXPECT_EQ(pair.eigenvalue().imag(), 0.0);
  EXPECT_TRUE(pair.Z.imag().isZero(0.0));
}

class PairOfFamily : public testing::TestWithParam<unsigned> {
 protected:
  /// The modes at the start, by LAPACK.
  std::vector<StartingMode> modes() const {
    return compute_spectrum(start.M[0], start.C[0], start.K[0]).modes;
  }

  ReducedPencil family = random_family(6, GetParam());
  ReducedPencil start = at(family, 0.0);
  ModeCounts counts;
};

TEST_P(PairOfFamily, CorrectsAPerturbedModeWithOneFactorization) {
  const PencilAtPoint point(start);
  for (const StartingMode& exact : modes()) {
    ModeCounts one;
    ComplexVector z = exact.z;
    z += 1e-4 * ComplexVector::Ones(6);
    const InvariantPair pair = correct_mode(point, exact.s * Complex(1.0, 1e-4), z, one);
    ASSERT_EQ(pair.status, PairStatus::converged);
    EXPECT_LT(std::abs(pair.eigenvalue() - exact.s), tolerance * std::abs(exact.s));
    EXPECT_EQ(one.factorizations, 1U);
    EXPECT_LT(pair.backward_error, 1e-15);
    EXPECT_LT(normalization_defect(pair, pair.Z, pair.Lambda), rounding);
  }
}

/// A residual r moves the eigenvalue by y^H r, where y is the left vector: y^H P(s) = 0.
TEST_P(PairOfFamily, ResidualsMoveTheEigenvalueByTheLeftVector) {
  const PencilAtPoint point(start);
  for (const StartingMode& exact : modes()) {
    const InvariantPair near = correct_mode(point, exact.s * 1.001, exact.z, counts);
    const InvariantPair pair = correct_mode(point, near.eigenvalue(), near.Z, counts);  // factors at the pair
    Eigen::RowVectorXcd left(6);
    ComplexMatrix dZ, dLambda;
    for (Eigen::Index i = 0; i < 6; ++i) {
      pair.factors->solve(ComplexVector::Unit(6, i), ComplexMatrix::Zero(1, 1), dZ, dLambda);
      left[i] = dLambda(0, 0);
    }
    const double scale = left.norm() * point.magnitude(std::abs(pair.eigenvalue()));
    EXPECT_LT((left * point.matrix(pair.eigenvalue())).norm(), 1e-13 * scale);
    const Vector terms = point.terms(pair.Z, pair.Lambda);
    const PairSensitivity found = pair.factors->sensitivity(terms);
    const double by_terms = left.cwiseAbs() * terms;
    EXPECT_NEAR(found.to_residual, left.norm(), tolerance * left.norm());
    EXPECT_NEAR(found.to_terms, by_terms, tolerance * by_terms);
    EXPECT_NEAR(pair.rounding, std::numeric_limits<double>::epsilon() * by_terms, 1e-6 * pair.rounding);
  }
}

/// Sensitivities of order q predict the eigenpair ahead up to h^(q+1).
TEST_P(PairOfFamily, SeriesOfAModeHaveTheirOrder) {
  const PencilAtPoint point(start);
  for (const StartingMode& exact : modes()) {
    const InvariantPair pair = correct_mode(point, exact.s, exact.z, counts);
    const PairSeries series = differentiate_pair(family, pair, 4, counts);
    const auto miss = [&](int order, double h) {
      const ReducedPencil ahead = at(family, h);
      Complex s = 0.0;
      ComplexVector z = ComplexVector::Zero(6);
      for (std::size_t k = static_cast<std::size_t>(order) + 1; k-- > 0;) {
        s = s * h + series.Lambda[k](0, 0);
        z = z * h + series.Z[k];
      }
      const InvariantPair corrected = correct_mode(PencilAtPoint(ahead), s, z, counts);
      const Complex gauge = pair.W.col(0).head(6).dot(corrected.Z.col(0)) +
                            corrected.eigenvalue() * pair.W.col(0).tail(6).dot(corrected.Z.col(0));
      return std::abs(corrected.eigenvalue() - s) + (corrected.Z / gauge - z).norm();
    };
    const Complex growth = series.Lambda[1](0, 0) / pair.eigenvalue();
    for (int order = 1; order <= 4; ++order) {
      const double h = 0.02 / (1.0 + std::abs(growth) * 10.0);
      EXPECT_NEAR(std::log2(miss(order, h) / miss(order, h / 2)), order + 1.0, 0.4) << "order " << order;
    }
  }
}

TEST_P(PairOfFamily, ConditionNumberBoundsThePerturbation) {
  const PencilAtPoint point(start);
  std::mt19937_64 engine(GetParam() + 100);
  for (const StartingMode& exact : modes()) {
    const InvariantPair pair = correct_mode(point, exact.s, exact.z, counts);
    const double epsilon = 1e-7;
    double worst = 0.0;
    for (int trial = 0; trial < 20; ++trial) {
      const auto perturbed = [&](const Matrix& B) {
        const Matrix E = random_matrix(6, 6, engine);
        return Matrix(B + epsilon * B.norm() / E.norm() * E);
      };
      const ReducedPencil near{{perturbed(start.M[0])}, {perturbed(start.C[0])}, {perturbed(start.K[0])}};
      const Complex moved = correct_mode(PencilAtPoint(near), pair.eigenvalue(), pair.Z, counts).eigenvalue();
      worst = std::max(worst, std::abs(moved - pair.eigenvalue()) / std::abs(pair.eigenvalue()) / epsilon);
    }
    EXPECT_LT(worst, 1.01 * pair.condition);
    EXPECT_GT(worst, 0.01 * pair.condition) << "a bound that is never approached says nothing";
  }
}

/// The lowest k modes as one block, started from their vectors.
InvariantPair block_of(const std::vector<StartingMode>& modes, std::size_t k) {
  InvariantPair start;
  start.Z.resize(modes[0].z.size(), static_cast<Eigen::Index>(k));
  start.Lambda = ComplexMatrix::Zero(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(k));
  for (std::size_t i = 0; i < k; ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    start.Z.col(at) = modes[i].z;
    start.Lambda(at, at) = modes[i].s;
  }
  return start;
}

TEST_P(PairOfFamily, BlocksOfTwoAndThreeHoldTheEigenvaluesOfTheirModes) {
  const PencilAtPoint point(start);
  const auto exact = modes();
  for (std::size_t k = 2; k <= 3; ++k) {
    ModeCounts one;
    InvariantPair near = block_of(exact, k);
    near.Z.array() += 1e-4;
    near.Lambda *= Complex(1.0, 1e-4);
    const InvariantPair pair = correct_pair(point, near, s_ref, {}, one);
    ASSERT_EQ(pair.status, PairStatus::converged);
    EXPECT_LT(pair.backward_error, rounding);
    EXPECT_LT(normalization_defect(pair, pair.Z, pair.Lambda), rounding);
    std::vector<Complex> expected;
    for (std::size_t i = 0; i < k; ++i) expected.push_back(exact[i].s);
    EXPECT_LT(matched_distance(expected, eigenvalues(pair)), 10.0 * tolerance);
    EXPECT_EQ(one.factorizations, k) << "one per column";
  }
}

TEST_P(PairOfFamily, ConditionNumberBoundsThePerturbationOfABlock) {
  // The mean of a block's eigenvalues moves by no more than the trace of the change of Lambda allows.
  const PencilAtPoint point(start);
  const InvariantPair pair = correct_pair(point, block_of(modes(), 2), s_ref, {}, counts);
  ASSERT_EQ(pair.status, PairStatus::converged);
  std::mt19937_64 engine(GetParam() + 200);
  const double epsilon = 1e-7;
  for (int trial = 0; trial < 20; ++trial) {
    const auto perturbed = [&](const Matrix& B) {
      const Matrix E = random_matrix(6, 6, engine);
      return Matrix(B + epsilon * B.norm() / E.norm() * E);
    };
    const ReducedPencil near{{perturbed(start.M[0])}, {perturbed(start.C[0])}, {perturbed(start.K[0])}};
    const InvariantPair moved = correct_pair(PencilAtPoint(near), pair, s_ref, {}, counts);
    const double size = pair.Lambda.norm() / std::sqrt(2.0);
    const double mean = std::abs((moved.Lambda - pair.Lambda).trace()) / 2.0;
    EXPECT_LT(mean / size / epsilon, 1.01 * pair.condition);
  }
}

/// Truncated series of order q satisfy the equations ahead up to h^(q+1): the residual needs no second
/// solution.
TEST_P(PairOfFamily, SeriesOfABlockHaveTheirOrder) {
  const PencilAtPoint point(start);
  for (std::size_t k = 2; k <= 3; ++k) {
    const InvariantPair pair = correct_pair(point, block_of(modes(), k), s_ref, {}, counts);
    ASSERT_EQ(pair.status, PairStatus::converged);
    const PairSeries series = differentiate_pair(family, pair, 4, counts);
    const auto miss = [&](int order, double h) {
      ComplexMatrix Z = ComplexMatrix::Zero(pair.Z.rows(), pair.size());
      ComplexMatrix Lambda = ComplexMatrix::Zero(pair.size(), pair.size());
      for (std::size_t i = static_cast<std::size_t>(order) + 1; i-- > 0;) {
        Z = Z * h + series.Z[i];
        Lambda = Lambda * h + series.Lambda[i];
      }
      const ReducedPencil ahead = at(family, h);
      return PencilAtPoint(ahead).residual(Z, Lambda).norm() + normalization_defect(pair, Z, Lambda);
    };
    const double h = 0.02 / (1.0 + 10.0 * series.Lambda[1].norm() / pair.Lambda.norm());
    for (int order = 1; order <= 4; ++order) {
      EXPECT_NEAR(std::log2(miss(order, h) / miss(order, h / 2)), order + 1.0, 0.4)
          << "order " << order << " of a block of " << k;
    }
  }
}

/// The series may be computed with the factors of a distant prediction. If these are so inaccurate that every
/// coefficient needs many corrections, the block is factorized again.
TEST_P(PairOfFamily, SeriesOfABlockDoNotDependOnItsFactors) {
  const PencilAtPoint point(start);
  const InvariantPair pair = correct_pair(point, block_of(modes(), 2), s_ref, {}, counts);
  ASSERT_EQ(pair.status, PairStatus::converged);
  InvariantPair near = pair, distant = pair;
  near.factors.reset();
  distant.factors = std::make_shared<const PairFactorization>(point, pair.Z, 1.02 * pair.Lambda, pair.W);
  ModeCounts with_own, with_distant;
  const PairSeries expected = differentiate_pair(family, near, 4, with_own);
  const PairSeries found = differentiate_pair(family, distant, 4, with_distant);
  EXPECT_EQ(with_own.factorizations, 2u);
  EXPECT_EQ(with_distant.factorizations, 2u);
  EXPECT_LE(with_own.solves, 2u * 3u * 4u) << "the second correction leaves rounding";
  for (std::size_t k = 1; k <= 4; ++k) {
    EXPECT_LT((found.Z[k] - expected.Z[k]).norm(), 1e-11 * expected.Z[k].norm()) << "order " << k;
    EXPECT_LT((found.Lambda[k] - expected.Lambda[k]).norm(), 1e-11 * expected.Lambda[k].norm());
  }
}

/// A conjugate pair as a real block: real all through, and the eigenvalues of the pair.
TEST_P(PairOfFamily, ConjugatePairIsARealBlock) {
  const PencilAtPoint point(start);
  for (const StartingMode& mode : modes()) {
    if (mode.s.imag() == 0.0) continue;
    const InvariantPair pair =
        correct_pair(point, with_conjugate(start_at(mode.s * 1.001, mode.z)), s_ref, {}, counts);
    ASSERT_EQ(pair.status, PairStatus::converged);
    EXPECT_TRUE(pair.is_real);
    EXPECT_TRUE(pair.Z.imag().isZero(0.0));
    EXPECT_TRUE(pair.Lambda.imag().isZero(0.0));
    EXPECT_LT(pair.backward_error, rounding);
    EXPECT_LT(matched_distance({mode.s, std::conj(mode.s)}, eigenvalues(pair)), tolerance);
    const PairSeries series = differentiate_pair(family, pair, 4, counts);
    for (std::size_t k = 0; k <= 4; ++k) {
      EXPECT_TRUE(series.Z[k].imag().isZero(0.0)) << "order " << k;
      EXPECT_TRUE(series.Lambda[k].imag().isZero(0.0)) << "order " << k;
    }
    // tau = Re s and delta = -(Im s)^2 as power series, from the mode by itself.
    const InvariantPair upper = correct_mode(point, mode.s, mode.z, counts);
    const PairSeries alone = differentiate_pair(family, upper, 4, counts);
    ComplexVector s(5), conjugate(5);
    for (Eigen::Index k = 0; k <= 4; ++k) s[k] = alone.Lambda[static_cast<std::size_t>(k)](0, 0);
    conjugate = s.conjugate();
    const ComplexVector half = 0.5 * (s - conjugate);
    const ComplexMatrix functions = block_functions(series.Lambda);
    const ComplexVector delta = multiply_series(half, half);
    for (Eigen::Index k = 0; k <= 4; ++k) {
      const double scale = s.cwiseAbs().maxCoeff();
      EXPECT_LT(std::abs(functions(0, k) - 0.5 * (s[k] + conjugate[k])), tolerance * scale) << "order " << k;
      EXPECT_LT(std::abs(functions(1, k) - delta[k]), tolerance * scale * scale) << "order " << k;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, PairOfFamily, testing::Range(1U, 6U));

/// s^2 + 3 s + k = 0: a root near zero, from starts with an error as large as magnitudes that count as zero.
class SmallEigenvalue : public testing::TestWithParam<double> {};

TEST_P(SmallEigenvalue, IsReachedFromEveryStartThatCountsAsZero) {
  const double k = GetParam();
  const ReducedPencil pencil = single(1.0, 3.0, k);
  const double expected = -2.0 * k / (3.0 + std::sqrt(9.0 - 4.0 * k));
  for (const double s : {-s_ref, -1e-6, -1e-9, -1e-12, -1e-17, 0.0, 1e-17, 1e-12, 1e-9, 1e-6, s_ref}) {
    ModeCounts counts;
    const InvariantPair pair = correct_mode(PencilAtPoint(pencil), s, ComplexVector::Ones(1), counts);
    EXPECT_EQ(pair.status, PairStatus::converged) << "from " << s;
    EXPECT_NEAR(pair.eigenvalue().real(), expected, 1e-13 * s_ref) << "from " << s;
  }
}

INSTANTIATE_TEST_SUITE_P(Stiffness, SmallEigenvalue, testing::Values(0.0, 1e-12, 1e-9, 1e-6, 1e-3));

TEST(InvariantPair, NormalizationKeepsTheEigenvaluesAndBalancesTheHalves) {
  std::mt19937_64 engine(7);
  for (const double size : {1e-6, 1.0, 1e6}) {
    ComplexMatrix Z(5, 3), Lambda(3, 3), W;
    Z.real() = random_matrix(5, 3, engine);
    Z.imag() = random_matrix(5, 3, engine);
    Lambda.real() = size * random_matrix(3, 3, engine);
    Lambda.imag() = size * random_matrix(3, 3, engine);
    const ComplexMatrix old_Z = Z;
    const ComplexVector before = Eigen::ComplexEigenSolver<ComplexMatrix>(Lambda).eigenvalues();
    normalize_pair(Z, Lambda, W, s_ref);
    const ComplexVector after = Eigen::ComplexEigenSolver<ComplexMatrix>(Lambda).eigenvalues();
    EXPECT_LT(matched_distance({before.begin(), before.end()}, {after.begin(), after.end()}), tolerance);
    const ComplexMatrix unit = W.topRows(5).adjoint() * Z + W.bottomRows(5).adjoint() * Z * Lambda;
    EXPECT_LT((unit - ComplexMatrix::Identity(3, 3)).norm(), rounding * 10) << "size " << size;
    // The columns still span the same space.
    const ComplexMatrix projected = old_Z * old_Z.colPivHouseholderQr().solve(Z);
    EXPECT_LT((projected - Z).norm(), tolerance * Z.norm());
  }
}

/// Four real eigenvalues of two freedoms, with one vector for each two. From point to point a trace
/// normalizes what it has normalized before; with |Lambda| as the scale of the slopes it would grow by a
/// factor of 1.4 each time.
TEST(InvariantPair, NormalizationAgainAndAgainDoesNotLetLambdaGrow) {
  constexpr int points = 20;
  const ComplexMatrix start_Z{{1.0, 1.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 1.0}};
  const ComplexMatrix start_Lambda = ComplexVector{{-0.7, -0.8, -1.0, -1.1}}.asDiagonal();
  const auto norm_after = [&](int times, bool by_norm) {
    ComplexMatrix Z = start_Z, Lambda = start_Lambda, W;
    for (int i = 0; i < times; ++i) normalize_pair(Z, Lambda, W, by_norm ? Lambda.norm() : 1e-3);
    return Lambda.norm();
  };
  const double once = norm_after(1, false);
  EXPECT_LT(once, 3.0 * start_Lambda.norm());
  // The entries of one freedom add up in squares: with the root of the number of points.
  EXPECT_LT(norm_after(points, false), once * std::sqrt(1.0 + points));
  EXPECT_GT(norm_after(points, true), 100.0 * once);
}

/// The same for two rigid-body motions, whose eigenvalues have no scale.
TEST(InvariantPair, NormalizationKeepsTheScaleOfZeroEigenvalues) {
  ComplexMatrix Z{{1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.0}}, W;
  ComplexMatrix Lambda = ComplexMatrix::Zero(4, 4);
  Lambda(0, 1) = Lambda(2, 3) = 5.0;
  Z(0, 1) = Z(1, 3) = 0.3;
  for (int i = 0; i < 20; ++i) {
    normalize_pair(Z, Lambda, W, 1e-3);
    EXPECT_NEAR(Lambda.norm(), std::sqrt(50.0), 0.5) << i;
  }
}

/// Both whirls of an isotropic shaft in its own frame, s = +-j (1 - p), at p = 1, with the second coordinate
/// in another unit. Lambda is linear in p, whatever the prediction of its value zero: the vectors are
/// constant. With slopes in units of that prediction its coefficients would grow by a factor of 60 from one
/// to the next.
TEST(InvariantPair, SeriesOfABlockOfZerosDoNotDependOnTheirPrediction) {
  const double unit = 1.05;
  const Matrix D = Vector{{1.0, unit}}.asDiagonal();
  const Matrix turn{{0.0, -unit}, {unit, 0.0}};
  const ReducedPencil pencil{{D * D}, {2.0 * turn, 2.0 * turn}, {Matrix::Zero(2, 2), -2.0 * D * D, -D * D}};
  for (const double error : {1e-16, 1e-4, 1e-2}) {
    SCOPED_TRACE(error);
    InvariantPair start;
    start.is_real = true;
    start.Z = ComplexMatrix::Identity(2, 2);
    start.Lambda = error * turn.inverse().cast<Complex>();
    ModeCounts counts;
    const InvariantPair pair = correct_pair(PencilAtPoint(pencil), start, 1e-3, {}, counts);
    ASSERT_EQ(pair.status, PairStatus::converged);
    EXPECT_EQ(pair.W.bottomRows(2).norm(), 0.0);
    const PairSeries series = differentiate_pair(pencil, pair, 4, counts);
    EXPECT_NEAR(series.Lambda[1].norm(), std::hypot(unit, 1.0 / unit), 1e-3);
    for (std::size_t i = 2; i < series.Lambda.size(); ++i) EXPECT_LT(series.Lambda[i].norm(), 1e-12) << i;
  }
}

/// A pair that is nearly defective beside a third eigenvalue: rounding of the residual moves Z by much more
/// than its own rounding, so that corrections stay long. The residual tells that nothing is left to correct.
TEST(InvariantPair, NearlyDefectiveBlockBesideAThirdEigenvalueConverges) {
  std::mt19937_64 engine(3);
  Matrix T = Matrix::Identity(3, 3) + 0.4 * random_matrix(3, 3, engine);
  const double beside = 1e-2;  // distance of two real eigenvalues of another freedom, and of these
  const Matrix C = Vector{{2.0, 2.0 + 3.0 * beside, 1.0}}.asDiagonal();
  const Matrix K = Vector{{1.0 - 1e-12, (1.0 + beside) * (1.0 + 2.0 * beside), 9.0}}.asDiagonal();
  const ReducedPencil pencil{{T.transpose() * T}, {T.transpose() * C * T}, {T.transpose() * K * T}};
  const PencilAtPoint point(pencil);
  const ComplexVector z = T.inverse().col(0).cast<Complex>();
  InvariantPair start;
  start.is_real = true;
  start.Z = ComplexMatrix::Zero(3, 2);
  start.Z.col(0) = z;
  for (const double gamma : {1.0, 5.0, 30.0}) {
    start.Lambda = ComplexMatrix{{-1.0, gamma}, {1e-12 / gamma, -1.0}};
    ModeCounts counts;
    const InvariantPair pair = correct_pair(point, start, s_ref, {}, counts);
    ASSERT_EQ(pair.status, PairStatus::converged) << gamma;
    const ComplexVector roots = pair_eigenvalues(pair);
    EXPECT_LT(std::abs(roots.mean() + 1.0), 1e-12) << gamma;
    EXPECT_LT(pair.backward_error, 1e-14) << gamma;
  }
}

TEST(InvariantPair, FarGuessIsReportedNotReturnedAsConverged) {
  const ReducedPencil start = at(random_family(6, 1), 0.0);
  ModeCounts counts;
  CorrectorOptions options;
  options.max_iterations = 3;
  const InvariantPair mode = correct_pair(
      PencilAtPoint(start), start_at({50.0, 90.0}, ComplexVector::Ones(6)), s_ref, options, counts);
  EXPECT_NE(mode.status, PairStatus::converged);
  InvariantPair block;
  block.Z = ComplexMatrix::Identity(6, 2);
  block.Lambda = Complex(50.0, 90.0) * ComplexMatrix::Identity(2, 2);
  EXPECT_NE(correct_pair(PencilAtPoint(start), block, s_ref, options, counts).status, PairStatus::converged);
}

TEST(EigenvalueRemainder, TellsTheRealPartOnTheImaginaryAxisToItsOwnDigits) {
  // M = I, C = alpha I: Re s = -alpha / 2 in every mode, here far below the rounding error of s.
  const double alpha = 3e-17;
  const ReducedPencil pencil{{Matrix::Identity(2, 2)},
                             {alpha * Matrix::Identity(2, 2)},
                             {Matrix{{2.0, -1.0 / 3.0}, {-1.0 / 3.0, 0.7}}}};
  const PencilAtPoint point(pencil);
  ModeCounts counts;
  const ComplexVector z{{Complex(1.0, 0.3), Complex(-0.2, -0.06)}};
  const InvariantPair mode = correct_mode(point, Complex(1e-3, 1.4), z, counts);
  ASSERT_EQ(mode.status, PairStatus::converged);
  const double corrected = (mode.eigenvalue() + eigenvalue_remainder(point, mode)).real();
  EXPECT_LT(std::abs(corrected + 0.5 * alpha), 1e-18);
}

}  // namespace
}  // namespace eigentrail::test::invariant_pair_test
