// Signs and extrema of sampled criteria, and the events that they lead to, on steps with known eigenvalues.
#include "continuation/events/criteria_scan.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/planted_oscillator.hpp"

namespace eigentrail::test::criteria_scan_test {
namespace {

using Seen = CriterionHistory::Seen;

/// What the history has seen after all values, one by one.
std::vector<Seen> seen(const std::vector<double>& values) {
  CriterionHistory history;
  std::vector<Seen> all;
  for (const double value : values) all.push_back(history.next(value));
  return all;
}

TEST(CriterionHistory, SeesChangesOfSignAndExtrema) {
  EXPECT_EQ(seen({1.0, 2.0, 3.0}), (std::vector<Seen>{Seen::nothing, Seen::nothing, Seen::nothing}));
  EXPECT_EQ(seen({1.0, -1.0}), (std::vector<Seen>{Seen::nothing, Seen::zero}));
  EXPECT_EQ(seen({1.0, 3.0, 2.0}), (std::vector<Seen>{Seen::nothing, Seen::nothing, Seen::extremum}));
  EXPECT_EQ(seen({-3.0, -1.0, -2.0}).back(), Seen::extremum);
}

TEST(CriterionHistory, KnowsTheVertexOfTheParabola) {
  // 5 - (t - 1.2)^2 at t = 0, 1, 2
  CriterionHistory history;
  for (const double t : {0.0, 1.0, 2.0}) history.next(5.0 - (t - 1.2) * (t - 1.2));
  EXPECT_NEAR(history.top(), 5.0, 1e-12);
  EXPECT_NEAR(history.bend(), -2.0, 1e-12);
}

TEST(CriterionHistory, TellsATouchFromACrossingAfterSkippedSamples) {
  for (const double after : {0.5, -0.5}) {
    CriterionHistory history;
    history.next(0.5);
    history.skip();
    EXPECT_EQ(history.next(after), after > 0.0 ? Seen::extremum : Seen::zero);
  }
  CriterionHistory unknown;
  unknown.skip();
  EXPECT_EQ(unknown.next(1.0), Seen::nothing) << "nothing is known before the skipped samples";
}

/// Newborn modes take over what is known of their parents, where the criterion is one of real eigenvalues.
TEST(InheritHistories, GivesTheHistoryOfTheParent) {
  const std::vector<Criterion> criteria{{EventKind::flutter}, {EventKind::damping_ratio, 0.1}};
  CriterionHistories histories;
  histories[{0, 0}].next(-2.0);
  histories[{0, 1}].next(3.0);
  inherit_histories({{0, 5}}, criteria, histories);
  ASSERT_TRUE(histories.contains({5, 0}));
  EXPECT_EQ(histories.at({5, 0}).value(), -2.0);
  EXPECT_FALSE(histories.contains({5, 1}) && histories.at({5, 1}).is_known());
}

/// Scans consecutive steps between `points` with one set of histories.
FoundEvents scan(PlantedOscillator& planted, const std::vector<double>& points) {
  CriterionHistories histories;
  FoundEvents all;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Step step = planted.single(points[i], points[i + 1]);
    append(scan_criteria(planted.search, step, histories), all);
  }
  return all;
}

std::vector<double> places(const FoundEvents& found) {
  std::vector<double> all;
  for (const Event& event : found.events) all.push_back(event.p);
  return all;
}

void expect_at(const FoundEvents& found, const std::vector<double>& expected, double accuracy) {
  const std::vector<double> at = places(found);
  ASSERT_EQ(at.size(), expected.size());
  for (std::size_t i = 0; i < at.size(); ++i) EXPECT_NEAR(at[i], expected[i], accuracy);
}

/// c = 10 (p + 0.2) (p - 0.1) (p - 0.3).
PlantedOscillator three_zeros() {
  return PlantedOscillator({0.06, -0.5, -2.0, 10.0}, {4.0});
}

/// The value at a point belongs to both steps there. A zero on the point must be found once.
TEST(ScanCriteria, FindsAZeroOnAPointOfTheTraceOnce) {
  PlantedOscillator planted = three_zeros();
  planted.criteria = {{EventKind::flutter, 0.0}};
  expect_at(scan(planted, {0.0, 0.1, 0.2}), {0.1}, 1e-12);
  expect_at(scan(planted, {0.2, 0.1, 0.0}), {0.1}, 1e-12);
  const double rounding = 1e-15;
  expect_at(scan(planted, {0.0, 0.1 - rounding, 0.2}), {0.1}, 1e-12);
}

/// The extremum of c = 0.2 + p^2 on a point of the trace, and between two.
TEST(ScanCriteria, FindsAnExtremumAcrossSteps) {
  PlantedOscillator planted({0.2, 0.0, 1.0}, {1.0});
  planted.criteria = {{EventKind::extremum, 0.0}};
  expect_at(scan(planted, {-0.2, 0.0, 0.2}), {0.0}, 1e-9);
  expect_at(scan(planted, {-0.2, 0.01, 0.2}), {0.0}, 1e-9);
  expect_at(scan(planted, {0.2, 0.013, -0.2}), {0.0}, 1e-9);
}

/// Criteria of pairs say nothing of real modes.
TEST(ScanCriteria, SkipsRealModesWhereOnlyPairsAreAskedFor) {
  PlantedOscillator planted({3.0}, {0.3, -1.0});
  planted.criteria = {{EventKind::damping_ratio, -0.5}, {EventKind::extremum, 0.0}};
  EXPECT_TRUE(scan(planted, {0.1, 0.5}).events.empty());
  planted.criteria = {{EventKind::flutter, 0.0}};
  const FoundEvents found = scan(planted, {0.1, 0.5});
  expect_at(found, {0.3}, 1e-13);
  ASSERT_FALSE(found.events.empty());
  EXPECT_EQ(found.events[0].kind, EventKind::divergence);
}

/// A damping ratio beyond one is never reached.
TEST(ScanCriteria, FindsOnlyValuesThatAreReached) {
  PlantedOscillator planted({0.2}, {1.0, 1.0});
  planted.criteria = {{EventKind::damping_ratio, 0.05}, {EventKind::damping_ratio, 0.1 / std::sqrt(1.2)}};
  expect_at(scan(planted, {0.0, 0.25, 0.5}), {0.2}, 1e-12);
}

/// The dense output changes its sign, the mode does not: a note for the user, and no event.
TEST(ScanCriteria, NotesAChangeOfSignThatIsNotConfirmed) {
  PlantedOscillator planted({0.2, 0.1}, {1.0});
  planted.criteria = {{EventKind::flutter, 0.0}};
  Step step = planted.single(0.0, 0.1);
  Track& track = step.right.tracks[0];
  track.functions(0, 0) += 0.2;
  track.roots[0] += 0.2;
  track.series.Lambda[0](0, 0) += 0.2;
  track.pair.Lambda(0, 0) += 0.2;
  CriterionHistories histories;
  const FoundEvents found = scan_criteria(planted.search, step, histories);
  EXPECT_TRUE(found.events.empty());
  ASSERT_EQ(found.notes.size(), 1U);
  EXPECT_NE(found.notes[0].find("mode 1 changes its sign near p = 0.0"), std::string::npos) << found.notes[0];
}

}  // namespace
}  // namespace eigentrail::test::criteria_scan_test
