// The loop of a trace: propose a step length, solve for the point at its end, judge the step, shorten it if
// it passes a place where a step has to end (landing), judge the shortened step, commit it.
#pragma once

#include <chrono>

#include "continuation/events/landing.hpp"
#include "continuation/step/step_judgement.hpp"
#include "continuation/trace/trace_state.hpp"
#include "continuation/tracks/joining.hpp"
#include "eigentrail/continuation/trace_options.hpp"
#include "eigentrail/continuation/trace_result.hpp"

namespace eigentrail {

// The class is final. NOLINTNEXTLINE(cppcoreguidelines-virtual-class-destructor)
class TraceLoop final : private Checkpoint {
 public:
  TraceLoop(const Model& model, const TraceOptions& options, const TraceObserver& observer,
            BasisChoice basis);

  TraceResult run();

  /// Continues from a saved state. Throws InputError if the bytes are not a state of a trace of this model.
  TraceResult resume(std::string_view bytes);

 private:
  const TraceResult& so_far() const override { return state_.result; }
  std::string save() const override { return save_state(state_, problem_, options_); }

  bool start();
  void prepare_to_follow();
  void follow();
  bool advance();

  Verdict judge(const Step& step, Uncertified uncertified);
  /// Applies a remedy other than a shorter step to a rejected step of length h. `step` holds its points; null
  /// if they were not solved. Returns whether something was changed, so that the step shall be tried again.
  bool find_remedy(const Verdict& verdict, double h, const Step* step);
  bool shorten(const Verdict& verdict, double length);
  bool commit(LandedStep landed, const std::vector<bool>& certified);
  void settle_events(LandedStep& landed);
  void log_branch_point(const PathNode& node);
  void regroup(Step& step);
  void move_on(Step step);
  bool leave_path();

  StepSolver steps() { return {points_, state_.origin}; }
  JoiningRules joining_rules() const {
    return {options_.tolerance, reach_, state_.steps.longest_step, state_.settings.follows_all};
  }
  double longest_allowed_step() const;
  bool leaves_path_at(const PathNode& node) const;
  void log(FoundEvents found);
  bool emit(const PathNode& node, const PathStep* step);
  bool stop(TraceStatus status, const std::string& message);
  double seconds_so_far() const;

  const TraceOptions& options_;
  const TraceObserver& observer_;
  const std::vector<Criterion> criteria_;
  PathProblem problem_;
  TraceState state_;
  PointSolver points_;
  /// Where the model changes on a small part of the range, in the order in which the trace meets them. Steps
  /// end there.
  std::vector<double> narrow_places_;
  EventLog log_;
  EventSearch search_;
  std::vector<TrackTest> tests_;  ///< of the tracks of the last step that was judged
  int growing_unfollowed_ = -1;   ///< at the last point, as EnteringModes::growing
  double reach_ = 3.0;            ///< see parting_reach; replaced when the order is known
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  double seconds_before_ = 0.0;  ///< wall time of the earlier runs that this one continues
};

}  // namespace eigentrail
