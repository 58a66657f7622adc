#include "eigentrail/modes/regroup.hpp"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <cmath>

#include "eigentrail/modes/spectrum.hpp"
#include "support/families.hpp"
#include "support/spectra.hpp"

namespace eigentrail::test::regroup_test {
namespace {

constexpr double tolerance = 1e-12;
constexpr double s_ref = 1e-3;

std::vector<Complex> list(const ComplexVector& values) {
  return {values.begin(), values.end()};
}

bool is_exactly_real(const InvariantPair& pair) {
  return pair.Z.imag().isZero(0.0) && pair.Lambda.imag().isZero(0.0);
}

/// Residual of a pair relative to the size of its terms, which are as large as the weakest direction of [Z; Z
/// Lambda] allows.
double relative_residual(const ReducedPencil& pencil, const InvariantPair& pair) {
  const PencilAtPoint point(pencil, pair.chart);
  ComplexMatrix both(2 * pair.Z.rows(), pair.size());
  both << pair.Z, pair.Z * pair.Lambda / std::max(pair.Lambda.norm(), 1e-300);
  const double weakest = both.jacobiSvd().singularValues().tail(1)[0];
  return point.residual(pair.Z, pair.Lambda).norm() / (point.magnitude(pair.Lambda.norm()) * weakest);
}

class Regroup : public testing::TestWithParam<unsigned> {
 protected:
  void SetUp() override {
    for (const StartingMode& mode : compute_spectrum(pencil.M[0], pencil.C[0], pencil.K[0]).modes) {
      InvariantPair start;
      start.Z = mode.z;
      start.Lambda = ComplexMatrix::Constant(1, 1, mode.s);
      start.is_real = mode.s.imag() == 0.0;
      modes.push_back(correct_pair(PencilAtPoint(pencil), start, s_ref, {}, counts));
      ASSERT_EQ(modes.back().status, PairStatus::converged);
    }
  }

  InvariantPair corrected(const InvariantPair& pair) {
    return correct_pair(PencilAtPoint(pencil, pair.chart), pair, s_ref, {}, counts);
  }

  ReducedPencil pencil = at(random_family(6, GetParam()), 0.0);
  ModeCounts counts;
  std::vector<InvariantPair> modes;
};

TEST_P(Regroup, ConjugateOfABlockOfTwoMakesARealBlockOfFour) {
  const InvariantPair both = join_pairs({&modes[0], &modes[1]}, false);
  const InvariantPair pair = with_conjugate(both);
  ASSERT_EQ(pair.size(), 4);
  EXPECT_TRUE(pair.is_real && is_exactly_real(pair));
  EXPECT_LT(relative_residual(pencil, pair), tolerance);
  const Complex a = modes[0].eigenvalue();
  const Complex b = modes[1].eigenvalue();
  EXPECT_LT(matched_distance({a, b, std::conj(a), std::conj(b)}, list(pair_eigenvalues(pair))),
            10.0 * tolerance);
}

TEST_P(Regroup, JoinedModesAreABlockThatNeedsNoCorrection) {
  const InvariantPair pair = join_pairs({&modes[0], &modes[2], &modes[4]}, false);
  ASSERT_EQ(pair.size(), 3);
  EXPECT_FALSE(pair.is_real);
  EXPECT_LT(relative_residual(pencil, pair), tolerance);
  const InvariantPair after = corrected(pair);
  ASSERT_EQ(after.status, PairStatus::converged);
  const std::vector<Complex> expected{modes[0].eigenvalue(), modes[2].eigenvalue(), modes[4].eigenvalue()};
  EXPECT_LT(matched_distance(expected, list(pair_eigenvalues(after))), 10.0 * tolerance);
}

TEST_P(Regroup, ComplexModesThatJoinARealBlockBringTheirConjugates) {
  const InvariantPair real = with_conjugate(modes[0]);
  const InvariantPair pair = join_pairs({&real, &modes[1]}, true);
  ASSERT_EQ(pair.size(), 4);
  EXPECT_TRUE(pair.is_real && is_exactly_real(pair));
  const InvariantPair after = corrected(pair);
  ASSERT_EQ(after.status, PairStatus::converged);
  EXPECT_TRUE(is_exactly_real(after));
  const Complex a = modes[0].eigenvalue();
  const Complex b = modes[1].eigenvalue();
  EXPECT_LT(matched_distance({a, b, std::conj(a), std::conj(b)}, list(pair_eigenvalues(after))),
            10.0 * tolerance);
}

TEST_P(Regroup, PartsOfABlockAreInvariantAgain) {
  const InvariantPair block = corrected(join_pairs({&modes[0], &modes[1], &modes[2], &modes[3]}, false));
  ASSERT_EQ(block.status, PairStatus::converged);
  const ComplexVector eigenvalues = pair_eigenvalues(block);
  for (const std::vector<int>& part :
       std::vector<std::vector<int>>{{0}, {3}, {1, 2}, {3, 0}, {2, 3, 1}, {0, 1, 2, 3}}) {
    const InvariantPair pair = part_of(block, eigenvalues, part);
    ASSERT_EQ(pair.size(), static_cast<Eigen::Index>(part.size()));
    EXPECT_LT(relative_residual(pencil, pair), 10.0 * tolerance);
    std::vector<Complex> expected;
    for (const int i : part) expected.push_back(eigenvalues[i]);
    EXPECT_LT(matched_distance(expected, list(pair_eigenvalues(pair))), 10.0 * tolerance);
  }
}

TEST_P(Regroup, PartsOfARealBlockAreRealWhereTheyAreClosedUnderConjugation) {
  const InvariantPair block = corrected(join_pairs({&modes[0], &modes[1]}, true));
  ASSERT_EQ(block.status, PairStatus::converged);
  ASSERT_TRUE(block.is_real);
  const ComplexVector eigenvalues = pair_eigenvalues(block);
  ASSERT_EQ(eigenvalues.size(), 4);
  int conjugate = 1;
  while (conjugate < 4 && eigenvalues[conjugate] != std::conj(eigenvalues[0])) ++conjugate;
  ASSERT_LT(conjugate, 4) << "conjugates of a real block are exact";
  const InvariantPair closed = part_of(block, eigenvalues, {0, conjugate});
  EXPECT_TRUE(closed.is_real && is_exactly_real(closed));
  EXPECT_LT(relative_residual(pencil, closed), 10.0 * tolerance);
  EXPECT_LT(matched_distance({eigenvalues[0], eigenvalues[conjugate]}, list(pair_eigenvalues(closed))),
            10.0 * tolerance);
  const InvariantPair open = part_of(block, eigenvalues, {0});
  EXPECT_FALSE(open.is_real);
  EXPECT_LT(relative_residual(pencil, open), 10.0 * tolerance);
}

TEST_P(Regroup, OtherChartIsAPairOfTheExchangedPencil) {
  const InvariantPair block = corrected(join_pairs({&modes[0], &modes[1]}, false));
  const InvariantPair other = in_other_chart(block);
  EXPECT_EQ(other.chart, Chart::reciprocal);
  EXPECT_EQ(other.factors, nullptr);
  EXPECT_LT(relative_residual(pencil, other), 10.0 * tolerance);
  std::vector<Complex> expected;
  for (const Complex s : pair_eigenvalues(block)) expected.push_back(1.0 / s);
  EXPECT_LT(matched_distance(expected, list(pair_eigenvalues(other))), 10.0 * tolerance);
  const InvariantPair back = in_other_chart(other);
  EXPECT_EQ(back.chart, Chart::finite);
  EXPECT_LT((back.Lambda - block.Lambda).norm(), 10.0 * tolerance * block.Lambda.norm());
}

INSTANTIATE_TEST_SUITE_P(Seeds, Regroup, testing::Range(1U, 6U));

/// One freedom, s^2 + 2 d s + 1 = 0: both members of the pair have the same vector.
TEST(WithConjugate, KeepsItsColumnsApartWhereThePairReachesTheRealAxis) {
  for (const double gap : {1e-1, 1e-4, 1e-8, 1e-12}) {
    const Complex s(-1.0, gap);
    const ReducedPencil pencil{{Matrix{{1.0}}}, {Matrix{{2.0}}}, {Matrix{{std::norm(s)}}}};
    InvariantPair upper;
    upper.Z = ComplexMatrix::Constant(1, 1, Complex(0.6, 0.8));
    upper.Lambda = ComplexMatrix::Constant(1, 1, s);
    const InvariantPair pair = with_conjugate(upper);
    ComplexMatrix both(2, 2);
    both << pair.Z, pair.Z * pair.Lambda;
    const Vector singular = both.jacobiSvd().singularValues();
    EXPECT_GT(singular[1], 0.1 * singular[0]) << "gap " << gap;
    ModeCounts counts;
    const InvariantPair after = correct_pair(PencilAtPoint(pencil), pair, s_ref, {}, counts);
    ASSERT_EQ(after.status, PairStatus::converged) << "gap " << gap;
    const ComplexMatrix N = after.Lambda + ComplexMatrix::Identity(2, 2);
    EXPECT_NEAR((N * N).trace().real() / 2.0, 1.0 - std::norm(s), 1e-15) << "delta, gap " << gap;
  }
}

}  // namespace
}  // namespace eigentrail::test::regroup_test
