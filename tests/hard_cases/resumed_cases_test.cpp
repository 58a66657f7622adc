// Every hard case interrupted and resumed: the result is the same, bit for bit, as without interruption.
#include <gtest/gtest.h>

#include "hard_cases/run_case.hpp"
#include "support/resumed.hpp"

namespace eigentrail::test::resumed_cases_test {
namespace {

constexpr std::size_t states = 8;  ///< number of states of each trace from which it is resumed

class ResumedCase : public testing::TestWithParam<HardCase> {};

TEST_P(ResumedCase, IsTheSameBitForBit) {
  for (const double tolerance : {1e-4, 1e-8}) {
    Setting setting = make_setting(GetParam().scene, {});
    setting.options.tolerance = tolerance;
    EXPECT_EQ(first_resumed_difference(*setting.model, setting.options, states), "")
        << "tolerance " << tolerance;
  }
}

INSTANTIATE_TEST_SUITE_P(All, ResumedCase, testing::ValuesIn(hard_cases()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace eigentrail::test::resumed_cases_test
