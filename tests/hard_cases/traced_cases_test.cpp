// Every hard case traced: accuracy everywhere, special points, labels. Each runs at three tolerances, in both
// directions, with four first steps; hard_case_table prints the same as a table.
#include <gtest/gtest.h>

#include "eigentrail/core/text.hpp"
#include "hard_cases/run_case.hpp"

namespace eigentrail::test {
namespace {

constexpr int random_samples = 500;
constexpr double first_steps[] = {0.0, 1e-3, 0.03, 0.3};  ///< shares of the range; 0: the program's own

class TracedCase : public testing::TestWithParam<HardCase> {};

std::string problems(const CaseReport& report) {
  std::string text;
  if (!report.completed) text += "ended early: " + report.message + "; ";
  if (report.worst_error > 4.0)
    text += "error " + std::to_string(report.worst_error) + " tolerances at " +
            std::to_string(report.worst_at) + "; ";
  if (report.most_retrackings > 4)
    text += std::to_string(report.most_retrackings) + " points for one event; ";
  if (report.wrong_labels > 0) text += std::to_string(report.wrong_labels) + " wrong labels; ";
  for (const std::string& event : report.missing) text += "missing " + event + "; ";
  for (const std::string& event : report.invented) text += "invented " + event + "; ";
  return text;
}

TEST_P(TracedCase, MatchesItsReference) {
  const CaseReference reference = make_reference(GetParam(), random_samples);
  std::string found;
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    for (const bool reversed : {false, true}) {
      for (const double first_step : first_steps) {
        const CaseReport report = run_case(reference, {tolerance, reversed, first_step});
        if (!report.passed()) {
          found += "tolerance " + exact_text(tolerance) + (reversed ? " down" : " up") + " first step " +
                   exact_text(first_step) + ": " + problems(report) + "\n";
        }
      }
    }
  }
  EXPECT_TRUE(found.empty()) << found;
}

INSTANTIATE_TEST_SUITE_P(All, TracedCase, testing::ValuesIn(hard_cases()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace eigentrail::test
