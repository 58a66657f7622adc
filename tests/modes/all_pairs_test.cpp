#include "eigentrail/modes/all_pairs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "eigentrail/modes/regroup.hpp"
#include "eigentrail/modes/spectrum.hpp"
#include "modes/single_modes.hpp"
#include "support/families.hpp"

namespace eigentrail::test {
namespace {

constexpr int order = 5;
constexpr Eigen::Index size = 8;
/// Of coefficients of order 5: they sum products of up to five ratios of matrices to gaps.
constexpr double series_rounding = 1e-10;

class AllPairsOfFamily : public testing::TestWithParam<unsigned> {
 protected:
  /// All modes at the start by LAPACK, each in a track of its own, with vectors and values off by 1e-3.
  std::vector<InvariantPair> starts() const {
    std::vector<InvariantPair> all;
    for (const StartingMode& mode : compute_spectrum(family.M[0], family.C[0], family.K[0]).modes) {
      const double error = 1e-3;
      ComplexVector z = mode.z / mode.z.norm();
      z += error * ComplexVector::Ones(size);
      all.push_back(start_at(mode.s * (1.0 + error), mode.s.imag() == 0.0 ? z.real().cast<Complex>() : z));
    }
    return all;
  }

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
    ASSERT_TRUE(is_complete(from, size));
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
      const PairSeries expected = differentiate_pair(family, alone, order, counts);
      for (std::size_t j = 0; j <= order; ++j) {
        EXPECT_LT((series[i].Z[j] - expected.Z[j]).norm(), series_rounding * (1.0 + expected.Z[j].norm()))
            << "coefficient " << j << " of pair " << i;
        EXPECT_LT((series[i].Lambda[j] - expected.Lambda[j]).norm(),
                  series_rounding * (1.0 + expected.Lambda[j].norm()));
      }
    }
  }
}

/// Where a mode is missing, or belongs to the other chart, the pairs want to be corrected one by one.
TEST_P(AllPairsOfFamily, AreRefusedWhereSomethingIsMissing) {
  std::vector<InvariantPair> from = starts();
  from.pop_back();
  EXPECT_FALSE(is_complete(from, size));
  std::vector<InvariantPair> reciprocal = starts();
  reciprocal.front().chart = Chart::reciprocal;
  EXPECT_FALSE(is_complete(reciprocal, size));
}

INSTANTIATE_TEST_SUITE_P(Seeds, AllPairsOfFamily, testing::Range(1U, 9U));

}  // namespace
}  // namespace eigentrail::test
