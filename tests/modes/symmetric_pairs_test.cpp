#include "eigentrail/modes/symmetric_pairs.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "eigentrail/modes/invariants.hpp"
#include "eigentrail/modes/regroup.hpp"
#include "modes/pairs_together.hpp"
#include "support/families.hpp"

namespace eigentrail::test::symmetric_pairs_test {
namespace {

/// Undamped with symmetric M > 0 and K, frequencies about 1, 1.7, 2.2 ...
ReducedPencil symmetric_family(Eigen::Index n, unsigned seed) {
  ReducedPencil family = random_family(n, seed);
  for (std::size_t k = 0; k < family.K.size(); ++k) {
    family.K[k] = (0.5 * (family.K[k] + family.K[k].transpose())).eval();
    family.C[k].setZero();
  }
  return family;
}

std::shared_ptr<const SymmetricPairs> correct(const ReducedPencil& family,
                                              const std::vector<InvariantPair>& starts,
                                              std::vector<InvariantPair>& corrected, ModeCounts& counts) {
  return correct_symmetric(PencilAtPoint(family), starts, s_ref, {}, counts, corrected);
}

/// n equal masses and springs between two walls: omega_b = 2 sin(b pi / (2 n + 2)).
ReducedPencil chain(Eigen::Index n) {
  Matrix K = 2.0 * Matrix::Identity(n, n);
  K.diagonal(1).setConstant(-1.0);
  K.diagonal(-1).setConstant(-1.0);
  // All springs stiffen together: s(h) = s(0) sqrt(1 + h).
  return {{Matrix::Identity(n, n)}, {Matrix::Zero(n, n)}, {K, K}};
}

TEST(SymmetricPairs, ChainOfSpringsEqualsTheClosedForm) {
  const Eigen::Index n = 30;
  const ReducedPencil family = chain(n);
  std::vector<InvariantPair> starts, pairs;
  for (Eigen::Index b = 1; b <= n; ++b) {
    const double angle = static_cast<double>(b) * std::numbers::pi / static_cast<double>(n + 1);
    ComplexVector z(n);
    for (Eigen::Index i = 0; i < n; ++i)
      z[i] = std::sin(angle * static_cast<double>(i + 1)) + (i == 3 ? 1e-3 : 0.0);
    starts.push_back(start_at(Complex(0.0, 2.0 * std::sin(0.5 * angle)), z));
  }
  ModeCounts counts;
  const auto all = correct(family, starts, pairs, counts);
  ASSERT_TRUE(all);
  const std::vector<PairSeries> series = differentiate_symmetric(family, *all, 3, counts);
  const double binomial[] = {1.0, 0.5, -0.125, 0.0625};
  for (Eigen::Index b = 1; b <= n; ++b) {
    const auto i = static_cast<std::size_t>(b - 1);
    const double omega =
        2.0 * std::sin(0.5 * static_cast<double>(b) * std::numbers::pi / static_cast<double>(n + 1));
    EXPECT_EQ(pairs[i].eigenvalue().real(), 0.0);
    EXPECT_LT(pairs[i].backward_error, rounding);
    for (std::size_t j = 0; j <= 3; ++j) {
      EXPECT_NEAR(series[i].Lambda[j](0, 0).imag(), binomial[j] * omega, tolerance * omega) << b << " " << j;
      if (j > 0) {
        EXPECT_LT(series[i].Z[j].norm(), tolerance / omega) << "shapes do not change";
      }
    }
  }
}

class SymmetricFamily : public testing::TestWithParam<unsigned> {
 protected:
  /// Compares with the pairs corrected and differentiated one by one.
  void expect_agreement(const std::vector<InvariantPair>& starts) {
    std::vector<InvariantPair> pairs;
    const auto all = correct(family, starts, pairs, counts);
    ASSERT_TRUE(all);
    ASSERT_EQ(pairs.size(), starts.size());
    const std::vector<PairSeries> series = differentiate_symmetric(family, *all, order, counts);
    for (std::size_t i = 0; i < starts.size(); ++i) {
      const InvariantPair alone = correct_pair(PencilAtPoint(family), starts[i], s_ref, {}, counts);
      ASSERT_EQ(alone.status, PairStatus::converged);
      EXPECT_EQ(pairs[i].is_real, alone.is_real);
      EXPECT_LT((pairs[i].W - alone.W).norm(), rounding);
      EXPECT_LT(pairs[i].backward_error, rounding);
      EXPECT_NEAR(pairs[i].condition / alone.condition, 1.0, alone.size() == 1 ? 1e-3 : 1.0);
      expect_same_series(series[i], differentiate_pair(family, alone, order, counts), i);
    }
  }

  ReducedPencil family = symmetric_family(6, GetParam());
  ModeCounts counts;
};

TEST_P(SymmetricFamily, PhasesAreThoseOfTheStarts) {
  std::vector<InvariantPair> starts = starts_of(family, 1e-4);
  for (std::size_t i = 0; i < starts.size(); ++i)
    starts[i].Z *= std::polar(1.0 + static_cast<double>(i), 0.7 * static_cast<double>(i));
  expect_agreement(starts);
}

TEST_P(SymmetricFamily, BlockInAnyComplexBasisAgreesToo) {
  std::vector<InvariantPair> starts = starts_of(family, 1e-5);
  InvariantPair block = join_pairs({&starts[1], &starts[2], &starts[3]}, false);
  const ComplexMatrix T = ComplexMatrix::Identity(3, 3) + Complex(0.3, 0.2) * ComplexMatrix::Ones(3, 3);
  block.Z = (block.Z * T).eval();
  block.Lambda = (T.inverse() * block.Lambda * T).eval();
  expect_agreement({starts[0], block, starts[4], starts[5]});
}

TEST_P(SymmetricFamily, RealBlockOfAModeAndItsConjugateAgreesToo) {
  std::vector<InvariantPair> starts = starts_of(family, 1e-6);
  starts[2] = with_conjugate(starts[2]);
  starts[0] = join_pairs({&starts[0], &starts[1]}, true);
  starts.erase(starts.begin() + 1);
  expect_agreement(starts);
}

TEST_P(SymmetricFamily, UnstableRootsOfBothSignsAgreeToo) {
  family.K[0] -= 4.0 * family.M[0];
  std::vector<InvariantPair> starts = starts_of(family, 1e-5);
  const auto n_real =
      std::count_if(starts.begin(), starts.end(), [](const auto& pair) { return pair.is_real; });
  ASSERT_GT(n_real, 2);
  ASSERT_GT(starts.size(), static_cast<std::size_t>(n_real));
  expect_agreement(starts);
}

TEST_P(SymmetricFamily, ConvergesQuadratically) {
  std::vector<InvariantPair> pairs;
  ASSERT_TRUE(correct(family, starts_of(family, 1e-4), pairs, counts));
  EXPECT_LE(counts.modal_solves, 3U);
  EXPECT_EQ(counts.factorizations, 0U);
}

INSTANTIATE_TEST_SUITE_P(Seeds, SymmetricFamily, testing::Values(1U, 2U, 3U, 4U, 5U));

/// Two oscillators that cross at h = 0, coupled by nothing, beside a third: lambda is -4 - h and -4 + h.
TEST(SymmetricPairs, CrossingPairIsDifferentiatedAsABlock) {
  const Matrix K1 = Vector{{1.0, -1.0, 0.5}}.asDiagonal();
  const ReducedPencil family{
      {Matrix::Identity(3, 3)}, {Matrix::Zero(3, 3)}, {Vector{{4.0, 4.0, 9.0}}.asDiagonal(), K1}};
  InvariantPair block;
  block.Z = ComplexMatrix{{1.0, 0.4}, {-0.3, Complex(1.0, 0.1)}, {1e-4, 1e-4}};
  block.Lambda = Complex(0.0, 2.001) * ComplexMatrix::Identity(2, 2);
  const InvariantPair third = start_at(Complex(0.0, 3.0), ComplexVector{{0.0, 1e-3, 1.0}});
  std::vector<InvariantPair> pairs;
  ModeCounts counts;
  const auto all = correct(family, {block, third}, pairs, counts);
  ASSERT_TRUE(all);
  const PairSeries series = differentiate_symmetric(family, *all, order, counts)[0];
  const ComplexMatrix functions = block_functions(series.Lambda);
  const PairSeries alone = differentiate_pair(
      family, correct_pair(PencilAtPoint(family), block, s_ref, {}, counts), order, counts);
  EXPECT_LT((functions - block_functions(alone.Lambda)).norm(), tolerance);
  // i (sqrt(4 + h) + sqrt(4 - h)) = 4 i (1 - h^2 / 128 - ...)
  EXPECT_LT(std::abs(series.Lambda[0].trace() - Complex(0.0, 4.0)), tolerance);
  EXPECT_LT(std::abs(series.Lambda[1].trace()), tolerance);
  EXPECT_LT(std::abs(series.Lambda[2].trace() + Complex(0.0, 1.0 / 32.0)), tolerance);
}

/// lambda = h: s = i sqrt(-h) becomes +-sqrt(h), and the block passes through zero with s^2 = h.
TEST(SymmetricPairs, RealBlockPassesThroughZero) {
  const Matrix K1 = Vector{{-1.0, 0.3}}.asDiagonal();
  const ReducedPencil family{
      {Matrix::Identity(2, 2)}, {Matrix::Zero(2, 2)}, {Vector{{0.0, 9.0}}.asDiagonal(), K1}};
  InvariantPair block;
  block.is_real = true;
  block.Z = ComplexMatrix{{1.0, 0.2}, {1e-4, 1e-5}};
  block.Lambda = ComplexMatrix{{-0.2, -0.04}, {1.0, 0.2}};
  std::vector<InvariantPair> pairs;
  ModeCounts counts;
  const auto all =
      correct(family, {block, start_at(Complex(0.0, 3.0), ComplexVector{{1e-3, 1.0}})}, pairs, counts);
  ASSERT_TRUE(all);
  const PairSeries series = differentiate_symmetric(family, *all, 2, counts)[0];
  const auto square = [&](std::size_t j) {
    ComplexMatrix sum = ComplexMatrix::Zero(2, 2);
    for (std::size_t i = 0; i <= j; ++i) sum += series.Lambda[i] * series.Lambda[j - i];
    return sum;
  };
  EXPECT_LT(square(0).norm(), tolerance);
  EXPECT_LT((square(1) - ComplexMatrix::Identity(2, 2)).norm(), tolerance);
  EXPECT_LT(square(2).norm(), tolerance);
  EXPECT_GT(series.Lambda[0].norm(), 0.1) << "a Jordan block";
  EXPECT_TRUE(series.Z[1].imag().isZero(0.0) && series.Lambda[1].imag().isZero(0.0));
}

class Refused : public testing::Test {
 protected:
  bool is_refused(const ReducedPencil& pencil, const std::vector<InvariantPair>& those) {
    ModeCounts counts;
    std::vector<InvariantPair> pairs;
    return correct(pencil, those, pairs, counts) == nullptr;
  }

  ReducedPencil family = symmetric_family(4, 1);
  std::vector<InvariantPair> starts = starts_of(family, 1e-6);
};

TEST_F(Refused, NotWhatIsSymmetric) {
  EXPECT_FALSE(is_refused(family, starts));
}

TEST_F(Refused, Damping) {
  family.C[0] = 1e-6 * Matrix::Identity(4, 4);
  EXPECT_TRUE(is_refused(family, starts));
}

TEST_F(Refused, CirculatoryStiffness) {
  family.K[0](0, 1) += 1e-3;
  EXPECT_TRUE(is_refused(family, starts));
}

TEST_F(Refused, ModesThatAreNotAll) {
  starts.pop_back();
  EXPECT_TRUE(is_refused(family, starts));
}

TEST_F(Refused, TwoStartsAtOneMode) {
  starts[1] = starts[2];
  EXPECT_TRUE(is_refused(family, starts));
}

TEST_F(Refused, NegativeRootWithoutItsPositive) {
  family.K[0] -= 2.0 * family.M[0];
  starts = starts_of(family, 1e-6);
  EXPECT_FALSE(is_refused(family, starts));
  const auto positive = std::find_if(starts.begin(), starts.end(),
                                     [](const auto& pair) { return pair.eigenvalue().real() > 0.0; });
  ASSERT_NE(positive, starts.end());
  starts.erase(positive);
  EXPECT_TRUE(is_refused(family, starts));
}

TEST_F(Refused, OtherChart) {
  starts[3] = in_other_chart(starts[3]);
  EXPECT_TRUE(is_refused(family, starts));
}

TEST_F(Refused, VectorsThatAreNotReal) {
  starts[0].Z += Complex(0.0, 0.5) * starts[1].Z;
  EXPECT_TRUE(is_refused(family, starts));
}

TEST_F(Refused, NegativeMass) {
  family.M[0] *= -1.0;
  EXPECT_TRUE(is_refused(family, starts));
}

}  // namespace
}  // namespace eigentrail::test::symmetric_pairs_test
