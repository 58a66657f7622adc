#include "eigentrail/modes/all_pairs.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "eigentrail/modes/regroup.hpp"
#include "modes/pairs_together.hpp"
#include "support/families.hpp"

namespace eigentrail::test {
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
      expect_same_series(series[i], differentiate_pair(family, alone, order, counts), i);
    }
  }
}

/// If a mode is missing or belongs to the other chart, the pairs must be corrected one by one.
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
