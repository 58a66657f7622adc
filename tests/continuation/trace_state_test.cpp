// The state of a trace: its settings, and its bytes.
#include "continuation/trace/trace_state.hpp"

#include <gtest/gtest.h>

#include "continuation/planted_search.hpp"
#include "eigentrail/core/errors.hpp"

namespace eigentrail::test::trace_state_test {
namespace {

struct State {
  State() : planted(Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.6, -1.0}, {5.0, 0.0}}))) {
    state.frame = planted.frame;
    state.origin.node = planted.family.point(0.0, {{{5.0 * j}}, {{2.0 * j, 2.6 * j}}});
    state.result.order = 4;
    state.result.n_independent = 3;
    state.result.n_columns = state.numbers.count = 3;
    state.result.counts.evaluations = planted.family.model().new_counts();
  }
  std::string saved() const { return save_state(state, planted.family.problem(), planted.options); }
  TraceState restored(const std::string& bytes) {
    PathProblem problem = planted.family.problem();
    return restore_state(bytes, problem, planted.options);
  }
  PlantedSearch planted;
  TraceState state;
};

TEST(TraceState, IsTheSameAfterSavingAndRestoring) {
  State state;
  state.state.steps.retries.count_failure();
  state.state.steps.longest_step = 0.25;
  state.state.numbers.partners = {{1, 2}};
  state.state.ended.push_back({state.state.origin.node.tracks[0], 3});
  Event event;
  event.kind = EventKind::veering;
  event.modes = {1, 2};
  state.state.result.events = {event};
  const std::string bytes = state.saved();
  const TraceState back = state.restored(bytes);
  EXPECT_EQ(save_state(back, state.planted.family.problem(), state.planted.options), bytes);
  EXPECT_EQ(back.steps.longest_step, 0.25);
  EXPECT_EQ(back.ended.size(), 1U);
  EXPECT_EQ(back.ended[0].looks, 3);
  EXPECT_EQ(back.numbers.partners.at(1), 2);
  EXPECT_EQ(back.frame.range.from, state.planted.options.from) << "the range comes from the options";
}

TEST(TraceState, OfAnotherProblemIsRefused) {
  State state;
  State other;
  other.planted.options.from = -0.5;
  Planted larger = Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.6, -1.0}, {5.0, 0.0}, {7.0, 0.0}}));
  PathProblem problem = larger.problem();
  EXPECT_THROW(restore_state(state.saved(), problem, state.planted.options), InputError);
}

TEST(TraceState, ThatIsDamagedIsRefused) {
  State state;
  const std::string bytes = state.saved();
  EXPECT_THROW(state.restored(bytes.substr(0, bytes.size() / 2)), InputError);
  EXPECT_THROW(state.restored(bytes + "x"), InputError);
  EXPECT_THROW(state.restored(""), InputError);
  std::string changed = bytes;
  ++changed[bytes.size() / 2];
  EXPECT_THROW(state.restored(changed), InputError);
}

TEST(TraceState, BringsBackWhatTheFirstPointDetermined) {
  const State state;
  PathProblem problem = state.planted.family.problem();
  problem.order = 2;
  problem.s_ref = 0.1;
  problem.s_max = 1e7;
  const std::string bytes = save_state(state.state, problem, state.planted.options);
  PathProblem back = state.planted.family.problem();
  static_cast<void>(restore_state(bytes, back, state.planted.options));
  EXPECT_EQ(back.order, 2);
  EXPECT_EQ(back.s_ref, 0.1);
  EXPECT_EQ(back.s_max, 1e7);
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
}  // namespace eigentrail::test::trace_state_test
