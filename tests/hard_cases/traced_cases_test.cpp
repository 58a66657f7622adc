// Every hard case traced: accuracy everywhere, special points, labels. Each runs at three tolerances, in both
// directions, with four first steps. The most points and the largest error go to GoogleTest's output file.
#include <gtest/gtest.h>

#include <Eigen/QR>

#include "eigentrail/core/text.hpp"
#include "hard_cases/family.hpp"
#include "hard_cases/run_case.hpp"
#include "support/families.hpp"

namespace eigentrail::test::traced_cases_test {
namespace {

constexpr int random_samples = 500;
constexpr double first_steps[] = {0.0, 1e-3, 0.03, 0.3};  ///< shares of the range; 0: the program's own

class TracedCase : public testing::TestWithParam<HardCase> {};

TEST_P(TracedCase, MatchesItsReference) {
  const CaseReference reference = make_reference(GetParam(), random_samples);
  std::string found;
  double worst_error = 0.0;
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    int nodes = 0;
    for (const double first_step : first_steps) {
      RecordedTrace trace;
      for (const bool reversed : {false, true}) {
        trace = trace_case(GetParam(), {tolerance, reversed, first_step}, &trace);
        const CaseReport report = check_case(reference, trace, tolerance);
        nodes = std::max(nodes, report.nodes);
        worst_error = std::max(worst_error, report.worst_error);
        if (!report.problems().empty()) {
          found += "tolerance " + exact_text(tolerance) + (reversed ? " down" : " up") + " first step " +
                   exact_text(first_step) + ": " + report.problems() + "\n";
        }
      }
    }
    RecordProperty("points_at_" + exact_text(tolerance), nodes);
  }
  RecordProperty("error_over_tolerance", exact_text(worst_error));
  EXPECT_TRUE(found.empty()) << found;
}

/// A third mode crosses a doublet once. Rounding, which depends on the basis, must not lead to a second
/// event, a crossing within the doublet.
TEST(PermanentDoublet, IsCrossedOnceInEveryBasis) {
  constexpr double third = 1.0 / 3.0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    std::mt19937_64 engine(seed);
    const Matrix Q = Eigen::HouseholderQR<Matrix>(random_matrix(3, 3, engine)).householderQ();
    const Matrix I = Matrix::Identity(3, 3);
    const HardCase turned = family_case("doublet", "", -0.5, 0.5,
                                        {{I}, {}, {I, Q * Matrix::Constant(3, 3, third) * Q.transpose()}},
                                        {{"crossing", 0.0, Complex(0.0, 1.0)}});
    for (const double first_step : {0.0, 0.3}) {
      const RecordedTrace trace = trace_case(turned, {1e-6, true, first_step});
      const EventComparison events = compare_events(turned, trace, 1e-6);
      std::string found;
      for (const Event& event : trace.result.events) found += event_line(event) + "\n";
      EXPECT_TRUE(events.missing.empty()) << "seed " << seed << ", first step " << first_step << "\n"
                                          << found;
      EXPECT_TRUE(events.invented.empty()) << "seed " << seed << ", first step " << first_step << "\n"
                                           << found;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, TracedCase, testing::ValuesIn(hard_cases()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace eigentrail::test::traced_cases_test
