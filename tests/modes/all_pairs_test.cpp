#include "eigentrail/modes/all_pairs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "eigentrail/modes/regroup.hpp"
#include "modes/pairs_together.hpp"
#include "support/families.hpp"

namespace eigentrail::test::all_pairs_test {
namespace {

constexpr Eigen::Index size = 8;
class AllPairsOfFamily : public testing::TestWithParam<unsigned> {
 protected:
  std::vector<InvariantPair> starts() const { return starts_of(family, 1e-3); }

  /// The same with the first two complex modes in one track.
  std::vector<InvariantPair> starts_with_block() const {
    std::vector<InvariantPair> all = starts();
    const auto is_complex = [](const InvariantPair& pair) { return !pair.is_real; };
    const auto first = std::find_if(all.begin(), all.end(), is_complex);
    const auto second = std::find_if(first + 1, all.end(), is_complex);
    *first = join_pairs({&*first, &*second}, false);
    all.erase(second);
    return all;
  }

  std::shared_ptr<const AllPairs> correct(const std::vector<InvariantPair>& from) {
    return correct_all(PencilAtPoint(family), from, s_ref, {}, counts, pairs);
  }

  ReducedPencil family = random_family(size, GetParam());
  ModeCounts counts;
  std::vector<InvariantPair> pairs;
};

/// Together or one by one, the pairs and their series are the same.
TEST_P(AllPairsOfFamily, AgreeWithPairsOneByOne) {
  for (const std::vector<InvariantPair>& from : {starts(), starts_with_block()}) {
    ASSERT_TRUE(is_complete(from, 2 * size));
    const auto all = correct(from);
    ASSERT_TRUE(all);
    ASSERT_EQ(pairs.size(), from.size());
    const std::vector<PairSeries> series = differentiate_all(family, *all, order, 1e-15, counts);
    for (std::size_t i = 0; i < from.size(); ++i) {
      const InvariantPair alone = correct_pair(PencilAtPoint(family), from[i], s_ref, {}, counts);
      ASSERT_EQ(alone.status, PairStatus::converged);
      EXPECT_EQ(pairs[i].is_real, alone.is_real);
      EXPECT_LT((pairs[i].Z - alone.Z).norm(), 1e-11);
      EXPECT_LT((pairs[i].Lambda - alone.Lambda).norm(), 1e-11 * alone.Lambda.norm());
      EXPECT_LT(pairs[i].backward_error, rounding);
      expect_same_series(series[i], differentiate_pair(family, alone, order, counts), i);
    }
  }
}

/// If a mode is missing or belongs to the other chart, the pairs must be corrected one by one.
TEST_P(AllPairsOfFamily, AreRefusedWhereSomethingIsMissing) {
  std::vector<InvariantPair> from = starts();
  from.pop_back();
  EXPECT_FALSE(is_complete(from, 2 * size));
  std::vector<InvariantPair> reciprocal = starts();
  reciprocal.front().chart = Chart::reciprocal;
  EXPECT_FALSE(is_complete(reciprocal, 2 * size));
}

/// M, C and K of size n of which the last `n_first` coordinates are of first order: no column in M. Their
/// equations may contain the accelerations of the others.
/// With `diagonal`, their leading columns are.
ReducedPencil partly_first_order(Eigen::Index n, Eigen::Index n_first, bool diagonal, unsigned seed) {
  ReducedPencil family = random_family(n, seed);
  for (Matrix& M : family.M) M.rightCols(n_first).setZero();
  if (diagonal) {
    for (Matrix& C : family.C) C.rightCols(n_first).setZero();
  }
  family.C[0].bottomRightCorner(n_first, n_first) += 3.0 * Matrix::Identity(n_first, n_first);
  return family;
}

class AllPairsOfFirstOrder : public testing::TestWithParam<std::tuple<Eigen::Index, bool>> {};

TEST_P(AllPairsOfFirstOrder, AgreeWithPairsOneByOne) {
  constexpr Eigen::Index n = 8;
  const auto [n_first, diagonal] = GetParam();
  const ReducedPencil family = partly_first_order(n, n_first, diagonal, 5);
  const Spectrum spectrum = compute_spectrum(family.M[0], family.C[0], family.K[0]);
  ASSERT_EQ(spectrum.status, SpectrumStatus::complete);
  EXPECT_EQ(spectrum.n_infinite, n_first);
  std::vector<InvariantPair> starts;
  for (const StartingMode& mode : spectrum.modes) {
    InvariantPair& pair = starts.emplace_back();
    pair.Z = mode.z;
    pair.Lambda = ComplexMatrix::Constant(1, 1, mode.s);
    pair.is_real = mode.s.imag() == 0.0;
    if (pair.is_real) {
      Eigen::Index largest = 0;
      pair.Z.col(0).cwiseAbs().maxCoeff(&largest);
      pair.Z = (pair.Z * (std::abs(pair.Z(largest, 0)) / pair.Z(largest, 0))).real().cast<Complex>();
    }
  }
  EXPECT_EQ(state_size(family.M[0]), 2 * n - n_first);
  ASSERT_TRUE(is_complete(starts, state_size(family.M[0])));
  ModeCounts counts;
  std::vector<InvariantPair> pairs;
  const auto all = correct_all(PencilAtPoint(family), starts, 1.0, {}, counts, pairs);
  ASSERT_TRUE(all);
  const std::vector<PairSeries> series = differentiate_all(family, *all, 3, 1e-15, counts);
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const InvariantPair alone = correct_pair(PencilAtPoint(family), starts[i], 1.0, {}, counts);
    ASSERT_EQ(alone.status, PairStatus::converged);
    EXPECT_LT(std::abs(pairs[i].Lambda(0, 0) - alone.Lambda(0, 0)), 1e-10 * std::abs(alone.Lambda(0, 0)));
    const PairSeries expected = differentiate_pair(family, alone, 3, counts);
    for (std::size_t k = 0; k < expected.Lambda.size(); ++k)
      EXPECT_LT(std::abs(series[i].Lambda[k](0, 0) - expected.Lambda[k](0, 0)),
                1e-8 * (1.0 + std::abs(expected.Lambda[k](0, 0))));
  }
}

INSTANTIATE_TEST_SUITE_P(Coordinates, AllPairsOfFirstOrder,
                         testing::Combine(testing::Values(1, 3, 8), testing::Bool()));

INSTANTIATE_TEST_SUITE_P(Seeds, AllPairsOfFamily, testing::Range(1U, 9U));

}  // namespace
}  // namespace eigentrail::test::all_pairs_test
