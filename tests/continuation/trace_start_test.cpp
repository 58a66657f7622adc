// The first point of a trace.
#include "continuation/trace/trace_start.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/planted_search.hpp"
#include "continuation/trace/trace_state.hpp"

namespace eigentrail::test::trace_start_test {
namespace {

/// The start of a trace of a planted family along its range.
struct Started {
  explicit Started(Planted family, TraceOptions asked = {}) : planted(std::move(family)), options(asked) {
    options.parameter = "p";
    options.from = -1.0;
    options.to = 1.0;
    problem.emplace(trace_problem(planted.family.model(), options, BasisChoice::aligned));
    state.frame.range = {problem->traced, -1.0, 1.0};
    state.result.counts.evaluations = planted.family.model().new_counts();
    const PointSolver points(*problem, state.frame, state.result.counts);
    failure = compute_start(points, options, *problem, state);
  }
  PlantedSearch planted;
  TraceOptions options;
  std::optional<PathProblem> problem;
  TraceState state;
  std::optional<StartFailure> failure;
};

/// Coupled a little, so that they do not fall apart.
Planted oscillators() {
  return Planted::frequencies({Matrix{{2.0, 0.1, 0.0}, {0.1, 3.0, 0.1}, {0.0, 0.1, 5.0}},
                               Matrix{{0.1, 0.0, 0.0}, {0.0, 0.2, 0.0}, {0.0, 0.0, 0.3}}});
}

TEST(ComputeStart, FollowsAllModesByMagnitude) {
  const Started start(oscillators());
  ASSERT_FALSE(start.failure);
  EXPECT_EQ(start.state.result.n_available, 3);
  EXPECT_EQ(start.state.result.n_modes, 3);
  EXPECT_TRUE(start.state.settings.follows_all);
  const std::vector<Track>& tracks = start.state.origin.node.tracks;
  ASSERT_EQ(tracks.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(tracks[i].modes, std::vector<int>{static_cast<int>(i)});
    if (i > 0) {
      EXPECT_GT(std::abs(tracks[i].roots[0]), std::abs(tracks[i - 1].roots[0]));
    }
  }
  EXPECT_GT(start.problem->s_max, 1e3 * 5.0);
  EXPECT_LT(start.problem->s_ref, 1.0);
}

TEST(ComputeStart, FollowsAsManyAsAreAskedFor) {
  TraceOptions options;
  options.modes.count = 2;
  const Started start(oscillators(), options);
  ASSERT_FALSE(start.failure);
  EXPECT_EQ(start.state.origin.node.tracks.size(), 2U);
  EXPECT_FALSE(start.state.settings.follows_all);
}

/// A pair of eigenvalues that nearly coincide starts as a block.
TEST(ComputeStart, JoinsWhatNearlyCoincides) {
  const double close = 1e-7;
  const Started start(Planted::frequencies(
      {Matrix{{2.0, close}, {close, 2.0}}, Matrix{{0.0, 0.0}, {0.0, 1.0}}, Matrix{{0.0, 0.0}, {0.0, 1.0}}}));
  ASSERT_FALSE(start.failure);
  ASSERT_EQ(start.state.origin.node.tracks.size(), 1U);
  EXPECT_EQ(start.state.origin.node.tracks[0].size(), 2);
}

TEST(ComputeStart, SaysWhyItFails) {
  const Started forceless(Planted({{Matrix{{1.0}}}, {}, {Matrix{{0.0}}}}));
  ASSERT_TRUE(forceless.failure);
  EXPECT_EQ(forceless.failure->status, TraceStatus::no_modes);
  EXPECT_NE(forceless.failure->message.find("no force"), std::string::npos);
  const Matrix half{{1.0, 0.0}, {0.0, 0.0}};
  const Started singular(Planted({{half}, {}, {half}}));
  ASSERT_TRUE(singular.failure);
  EXPECT_EQ(singular.failure->status, TraceStatus::singular_pencil);
}

TEST(FirstStep, IsShorterForTighterTolerancesAndAsGiven) {
  Started start(oscillators());
  const PathNode& node = start.state.origin.node;
  TraceOptions options = start.options;
  options.tolerance = 1e-4;
  const double loose = first_step(node, *start.problem, options);
  options.tolerance = 1e-12;
  EXPECT_LT(first_step(node, *start.problem, options), loose);
  EXPECT_GT(first_step(node, *start.problem, options), 0.0);
  options.first_step = 0.0123;
  EXPECT_EQ(first_step(node, *start.problem, options), 0.0123);
}

TEST(OrderFirstDeparture, TellsApartWhatCoincidesAtTheStart) {
  PlantedSearch planted(Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.0, -1.0}, {5.0, 0.0}})));
  PathNode node = planted.family.point(0.0, {{{5.0 * j}}, {{2.0 * j, 2.0 * j}}});
  ModeNumbers numbers{3};
  EXPECT_TRUE(order_first_departure({false, true}, planted.frame, node, numbers).empty());
  EXPECT_FALSE(node.tracks[0].departure);
  ASSERT_TRUE(node.tracks[1].departure);
  const ComplexVector& roots = node.tracks[1].departure->roots;
  EXPECT_GT(std::abs(roots[0] - roots[1]), 1e-7);
}

/// The tighter the tolerance and the lower the order, the farther away a meeting limits the step.
TEST(PartingReach, FollowsFromToleranceAndOrder) {
  TraceOptions loose, tight;
  loose.tolerance = 1e-4;
  tight.tolerance = 1e-10;
  EXPECT_GT(parting_reach(tight, 3), parting_reach(loose, 3));
  EXPECT_GT(parting_reach(tight, 2), parting_reach(tight, 6));
}

}  // namespace
}  // namespace eigentrail::test::trace_start_test
