// Several threads compute the modes of a point. The results must not depend on the number of threads.
#include <gtest/gtest.h>

#include "eigentrail/continuation/point_modes.hpp"
#include "support/matrix_text.hpp"
#include "support/scenes.hpp"
#include "support/traced_path.hpp"

namespace eigentrail::test::threads_test {
namespace {

/// n freedoms whose frequencies veer and are damped, M the identity.
Setting family(int n) {
  Matrix C = Matrix::Zero(n, n), K = C, growth = C;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      C(i, j) = i == j ? 0.02 + 0.001 * i : 0.05 * (i < j ? 1 : -1);
      K(i, j) = i == j ? 9.0 + 0.7 * i : 0.02 / (1.0 + i + j);
    }
    growth(i, i) = 3.0 - 0.1 * ((7 * i) % 11);
  }
  return make_setting(family_scene({{Matrix::Identity(n, n)}, {C}, {K, growth}}, 0.0, 1.0), {{"modes", "8"}});
}

RecordedPath path_with(const Setting& setting, int threads) {
  TraceOptions options = setting.options;
  options.threads = threads;
  const auto [result, path] = trace_path(*setting.model, options);
  EXPECT_EQ(result.status, TraceStatus::completed) << result.message;
  return path;
}

TEST(Threads, GiveTheSameBits) {
  constexpr int n = 40;
  ASSERT_TRUE(is_worth_sharing(8, n)) << "the modes must be shared at all";
  const Setting setting = family(n);
  const RecordedPath one = path_with(setting, 1);
  for (const int threads : {2, 5}) {
    const RecordedPath many = path_with(setting, threads);
    ASSERT_EQ(one.p, many.p);
    ASSERT_EQ(one.eigenvalues, many.eigenvalues);
    for (std::size_t i = 0; i < one.steps.size(); ++i) {
      for (std::size_t j = 0; j < one.steps[i].blocks.size(); ++j) {
        EXPECT_EQ(one.steps[i].blocks[j].left, many.steps[i].blocks[j].left);
        EXPECT_EQ(one.steps[i].blocks[j].certified, many.steps[i].blocks[j].certified);
      }
    }
  }
}

}  // namespace
}  // namespace eigentrail::test::threads_test
