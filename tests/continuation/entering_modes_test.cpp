// Modes that are wanted only on a part of the range: M = 1, K = [a, e; e, b] with a = (1 + p)^2, b = (5 -
// p)^2 and p from 0 to 3. Without coupling the frequencies are 1 + p and 5 - p.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "support/resumed.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::entering_modes_test {
namespace {

using test::make_setting;
using test::record_trace;

std::string two_oscillators(double coupling, const std::string& modes, double to = 3.0) {
  const std::string e = std::to_string(coupling);
  return "[trace]\nparameter = \"p\"\nfrom = 0\nto = " + std::to_string(to) + "\nmodes = " + modes +
         "\n[matrix_family]\nM = [ [[1, 0], [0, 1]] ]\nK = [ [[1, " + e + "], [" + e +
         ", 25]], [[2, 0], [0, -10]], [[1, 0], [0, 1]] ]\n";
}

/// The frequencies by the quadratic formula.
std::pair<double, double> exact(double p, double coupling) {
  const double a = std::pow(1.0 + p, 2);
  const double b = std::pow(5.0 - p, 2);
  const double root = std::hypot(0.5 * (a - b), coupling);
  return {std::sqrt(0.5 * (a + b) - root), std::sqrt(0.5 * (a + b) + root)};
}

class EnteringModes : public testing::TestWithParam<double> {};

TEST_P(EnteringModes, AModeThatEntersTheBandIsFollowedFromTheStepInWhichItDoes) {
  const double coupling = GetParam();
  const RecordedTrace traced =
      completed_trace(make_setting(two_oscillators(coupling, "{ band = [2.5, 6] }", 1.8)));
  EXPECT_EQ(traced.result.n_modes, 1);
  EXPECT_EQ(traced.result.n_columns, 2);
  const auto entries = events_of(traced.result, EventKind::band_edge);
  ASSERT_EQ(entries.size(), 1u);
  EXPECT_EQ(entries[0].modes, std::vector<int>{1});
  EXPECT_EQ(entries[0].direction, 1);
  EXPECT_EQ(entries[0].value, 2.5);
  EXPECT_NEAR(entries[0].s.imag(), 2.5, 1e-9);
  EXPECT_NEAR(exact(entries[0].p, coupling).first, 2.5, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Coupling, EnteringModes, testing::Values(0.0, 0.1));

TEST(EnteringModesOnTheRange, LeavingTheBandIsAnEventAndTheModeIsFollowedOn) {
  const RecordedTrace traced = completed_trace(make_setting(two_oscillators(0.0, "{ band = [3.5, 6] }")));
  const auto edges = events_of(traced.result, EventKind::band_edge);
  ASSERT_EQ(edges.size(), 2u);
  EXPECT_NEAR(edges[0].p, 1.5, 1e-9);  // 5 - p falls through 3.5
  EXPECT_EQ(edges[0].direction, -1);
  EXPECT_NEAR(edges[1].p, 2.5, 1e-9);  // 1 + p rises through 3.5
  EXPECT_EQ(edges[1].direction, 1);
}

TEST(EnteringModesOnTheRange, AResumedTraceIsTheSameBitForBit) {
  const test::Setting setting = make_setting(two_oscillators(0.1, "{ band = [2.5, 6] }"));
  EXPECT_EQ(test::first_resumed_difference(*setting.model, setting.options, 40), "");
}

TEST(EnteringModesOnTheRange, AChoiceByCountDoesNotGrow) {
  const RecordedTrace traced =
      completed_trace(make_setting(two_oscillators(0.1, "{ count = 1, band = [2.5, 6] }", 1.8)));
  EXPECT_EQ(traced.result.n_columns, 1);
}

TEST(EnteringModesOnTheRange, AModeThatBecomesLightlyDampedIsTaken) {
  // s^2 + 2 (1 - p) s + 1 and s^2 + 0.1 s + 9: the first is damped with the ratio 1 - p.
  const RecordedTrace traced = completed_trace(make_setting(
      "[trace]\nparameter = \"p\"\nfrom = 0.2\nto = 0.9\nmodes = { damping_below = 0.5 }\n"
      "[matrix_family]\nM = [ [[1, 0], [0, 1]] ]\nC = [ [[2, 0], [0, 0.1]], [[-2, 0], [0, 0]] ]\n"
      "K = [ [[1, 0.01], [0.01, 9]] ]\n"));
  EXPECT_EQ(traced.result.n_modes, 1);
  EXPECT_EQ(traced.result.n_columns, 2);
}

TEST(EnteringModesOnTheRange, NothingInTheBandAtTheStartTakesTheNearestAndSaysSo) {
  const RecordedTrace traced = completed_trace(make_setting(two_oscillators(0.1, "{ band = [7, 8] }")));
  EXPECT_EQ(traced.result.n_modes, 1);
  ASSERT_FALSE(traced.result.notes.empty());
  EXPECT_NE(traced.result.notes[0].find("Im s between 7 and 8 rad/s"), std::string::npos);
}

}  // namespace
}  // namespace eigentrail::test::entering_modes_test
