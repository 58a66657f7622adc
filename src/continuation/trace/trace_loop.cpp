#include "continuation/trace/trace_loop.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "continuation/events/criteria_scan.hpp"
#include "continuation/events/meeting_events.hpp"
#include "continuation/events/part_crossings.hpp"
#include "continuation/events/static_points.hpp"
#include "continuation/events/step_checks.hpp"
#include "continuation/events/veerings.hpp"
#include "continuation/step/step_error.hpp"
#include "continuation/step/stored_step.hpp"
#include "continuation/trace/stop_remarks.hpp"
#include "continuation/trace/trace_start.hpp"
#include "continuation/tracks/completeness.hpp"
#include "continuation/tracks/guard_modes.hpp"
#include "continuation/tracks/members.hpp"
#include "eigentrail/continuation/scene_parts.hpp"

namespace eigentrail {
namespace {

CertificateBudget budget_of_certificate(const TraceState& state, const TraceOptions& options) {
  const double progress = std::abs(state.origin.node.p - options.from) / state.frame.range.length();
  return certificate_budget(state.result.counts, state.result.n_independent, std::min(progress, 1.0));
}

/// Shortest step, as a share of the range; the trace gives up below it. Even where an eigenvalue varies like
/// the square root of the distance it changes by only 3e-7 over such a step. With a larger value traces end
/// that a shorter step would carry on; with a smaller one hopeless traces try longer before they end.
constexpr double shortest_step = 1e-13;
/// The shortest step moves p by at least this many units in its last place. With fewer, the step length
/// itself would be dominated by rounding.
constexpr double units_in_last_place = 8.0;
/// Longest step as a share of the range, if the options give none. With a larger value error estimates and
/// searches for events rest on fewer points, a smaller one costs points where all modes are smooth.
constexpr double longest_step = 0.25;
/// The same while a block of three or more is followed. More than one meeting of eigenvalues may lie within
/// one step of such a block; shorter steps have fewer. A smaller value costs points.
constexpr double longest_step_of_large_blocks = 0.05;
/// A step whose certificate fails is shortened as if this were its error in units of the accepted one: to
/// 0.56 of its length at order 3. A larger value shortens more at once, a smaller one needs more attempts.
constexpr double uncertified_error = 30.0;
/// Largest number of attempts to join blocks at one point, or one per track if those are more: all of them
/// may meet at the end of the step, as forward and backward whirl at rest. It limits how often a step of the
/// same length is tried before it is shortened. Fewer may miss a useful block, more may waste attempts.
constexpr int most_joins = 12;
/// Largest number of tracks that end at one point, before the trace does.
constexpr int most_ended = 3;
/// A step towards a place of infinity covers this share of the way. A larger one lets the eigenvalue that
/// runs there grow more on the step, and its series converge less; a smaller one costs points.
constexpr double share_of_way_to_infinity = 0.9;
/// Points in a row on which the position grows as towards a pole, until the trace ends. Fewer might be met
/// beside folds.
constexpr int enough_towards_pole = 10;
/// Factor by which the stored longest step decreases with each step, so that it covers about the last ten
/// steps (0.85^10 = 0.2). Nearer to one, old long steps count for longer.
constexpr double forgetting = 0.85;
/// Notes may come at every point: with more than this only that there are others is said.
constexpr std::size_t most_notes = 20;

void add_note(TraceResult& result, std::string note) {
  if (result.notes.size() < most_notes) return result.notes.push_back(std::move(note));
  if (result.notes.size() == most_notes) result.notes.emplace_back("further notes are left out");
}

/// Gives numbers to the modes of copies at a point, and counts all modes.
void number_modes(TraceState& state, const PathNode& node) {
  number_copies(node, state.numbers, state.copies);
  state.result.n_columns = state.numbers.count;
}

/// Ends the modes that run to infinity and have come close to it; the next step then leads to where they come
/// back. Returns how far a step may go towards the places where others run to infinity, infinite without any;
/// empty if no mode is left that is followed. `place`: of the point, for the notes.
std::optional<double> way_to_infinity(const PathProblem& problem, const std::string& place,
                                      TraceState& state) {
  PathNode& node = state.origin.node;
  const double direction = state.frame.direction;
  const EndedAtInfinity ended =
      end_at_infinity(problem, runs_to_infinity(node, direction), node, state.result.counts);
  for (const std::string& who : ended.who) {
    add_note(state.result, who + equal_modes_text(state.copies, ended.modes) + " ends at " + place +
                               ": it runs to infinity");
  }
  if (ended.behind > 0.0) {
    state.control.restart(ended.behind);
    if (node.tracks.empty() && !state.settings.follows_all) return std::nullopt;
  }
  double way = INFINITY;
  for (const RunToInfinity& run : runs_to_infinity(node, direction))
    way = std::min(way, share_of_way_to_infinity * run.distance);
  return way;
}

void count(const Verdict& verdict, Rejections& rejections) {
  // In the order of Verdict::Kind, in which `accepted` is the first.
  constexpr std::array counters{&Rejections::no_equilibrium, &Rejections::mode_lost,
                                &Rejections::inaccurate,     &Rejections::mismatch,
                                &Rejections::merged,         &Rejections::uncertified};
  if (!verdict.accepted()) ++(rejections.*counters[static_cast<std::size_t>(verdict.kind) - 1]);
}

void add(const Regroupings& changes, Regroupings& all) {
  all.joined += changes.joined;
  all.charts += changes.charts;
  all.planes += changes.planes;
}

/// Distance from a point to the next of some places in the direction of the trace; infinite if there is none,
/// or the coordinate is not p. Beside a place, as far as rounding, it has been reached.
double distance_to_next(const std::vector<double>& places, const PathFrame& frame, const PathNode& node) {
  if (frame.plane) return INFINITY;
  for (const double place : places) {
    const double distance = frame.direction * (place - node.p);
    if (distance > same_coordinate * frame.range.length()) return distance;
  }
  return INFINITY;
}

/// Whether a step is too inaccurate because of rounding that was not known yet. Then it is known now.
bool notices_rounding(const PathProblem& problem, const TraceOptions& options, const Step& step,
                      const Verdict& verdict, TraceState& state) {
  if (verdict.kind != Verdict::Kind::inaccurate || verdict.track < 0) return false;
  const auto index = static_cast<std::size_t>(verdict.track);
  const Track& track = step.left->tracks[index];
  const double before = known_rounding(state.frame, track);
  const double seen = observed_rounding(problem, options.tolerance, step, index);
  if (seen <= before) return false;
  note_rounding(track, seen, state.frame);
  return known_rounding(state.frame, track) >= seen;  // less of guard modes
}

/// The point at which a trace begins: no step arrives there.
const PathNode& as_first(PathNode& node) {
  for (Track& track : node.tracks) track.arriving = track.modes;
  return node;
}

/// Modes that have to be followed from a point on.
EnteringModes needed_at(const PathProblem& problem, const TraceOptions& options, const PathNode& node,
                        TraceState& state) {
  if (!state.settings.leaves_out) return {{}, 0};
  return entering_modes(problem, options.modes, node, state.result.counts);
}

/// The result, with what rounding leaves unknown.
TraceResult finished(const TraceOptions& options, double seconds, TraceState& state) {
  const double missing = std::abs(options.to - state.origin.node.p);
  if (state.result.status == TraceStatus::completed && missing > 0.5 * state.frame.range.length())
    state.result.notes.push_back("the path turned back, and the trace ended where it began: " +
                                 place_text(options, options.to) + " was not reached");
  if (state.least_known.error > options.tolerance)
    state.result.notes.push_back(rounding_note(options, state.least_known));
  state.result.seconds = seconds;
  return std::move(state.result);
}

}  // namespace

TraceLoop::TraceLoop(const Model& model, const TraceOptions& options, const TraceObserver& observer,
                     BasisChoice basis)
    : options_(options),
      observer_(observer),
      criteria_(criteria_of(options.events)),
      problem_(trace_problem(model, options, basis)),
      points_(problem_, state_.frame, state_.result.counts),
      narrow_places_(narrow_landings(problem_, options)),
      log_{state_.events, state_.frame.range, problem_.thresholds, nullptr, equilibrium_moves(problem_)},
      search_{points_, options_, criteria_, log_} {
  state_.result.counts.evaluations = model.new_counts();
  state_.frame.range = {problem_.traced, options.from, options.to};
  state_.frame.direction = options.to > options.from ? 1.0 : -1.0;
  if (options.to < options.from) std::reverse(narrow_places_.begin(), narrow_places_.end());
}

TraceResult TraceLoop::run() {
  if (start()) {
    prepare_to_follow();
    follow();
    if (state_.result.nodes == 0) emit(as_first(state_.origin.node), nullptr);  // no step was taken
  }
  return finished(options_, seconds_so_far(), state_);
}

TraceResult TraceLoop::resume(std::string_view bytes) {
  state_ = restore_state(bytes, problem_, options_);
  reach_ = parting_reach(options_, problem_.order);
  seconds_before_ = state_.result.seconds;
  begin_ = std::chrono::steady_clock::now();
  follow();
  return finished(options_, seconds_so_far(), state_);
}

bool TraceLoop::start() {
  TraceResult& result = state_.result;
  if (const auto failure = compute_start(points_, options_, problem_, state_))
    return stop(failure->status, failure->message);
  reach_ = parting_reach(options_, problem_.order);
  observer_.started({problem_.s_ref, result.n_available, result.n_modes, result.order});
  PathNode& node = state_.origin.node;
  note_size(problem_.model, node, state_.frame);
  log_branch_point(node);
  const std::vector<MeetingOnEnd> meetings = meetings_at(problem_, state_.frame, node);
  mark_meetings(meetings, node);
  FoundEvents met = meeting_events(search_, node, meetings);
  const std::vector<bool> meets = coinciding_tracks(node, meetings);
  const auto births = order_first_departure(meets, state_.frame, node, state_.numbers);
  inherit_histories(births, criteria_, state_.histories);
  name_births(births, met);
  // Of two that meet here one may go on before the start only.
  const std::vector<int> going_on = modes_of(node.tracks);
  for (Event& event : met.events)
    std::erase_if(event.modes, [&](int mode) { return !contains(going_on, mode); });
  EnteringModes needed = needed_at(problem_, options_, node, state_);
  begin_here(problem_, std::move(needed.tracks), node, state_.numbers);
  number_growing_guards(problem_, node, node, state_.numbers);
  growing_unfollowed_ = needed.growing;
  number_modes(state_, node);
  log(std::move(met));
  // The point is emitted with the first step, and with the modes that this one finds missing.
  if (!state_.frame.on_branch_point(options_.from)) return true;
  if (!emit(as_first(state_.origin.node), nullptr)) return false;
  const bool leaves = leaves_path_at(node);
  const bool goes_on = !leaves || leave_path();
  ++state_.branches.passed;
  return goes_on;
}

void TraceLoop::prepare_to_follow() {
  const double range = state_.frame.range.length();
  const double rounding = units_in_last_place * std::numeric_limits<double>::epsilon() *
                          std::max(std::abs(options_.from), std::abs(options_.to));
  const double min_step = std::max(shortest_step * range, rounding);
  const double max_step = std::max(options_.max_step.value_or(longest_step * range), min_step);
  PathNode& node = state_.origin.node;
  state_.control = StepControl(problem_.order, first_step(node, problem_, options_), max_step, min_step);
  part(problem_, nullptr, node, state_.control.step(), 0.0, {reach_, 0.0}, state_.result.counts);
}

void TraceLoop::follow() {
  TraceResult& result = state_.result;
  while (!reached_end(state_.frame, state_.origin.node)) {
    const std::string here = place_text(options_, state_.origin.node.p);
    if (result.nodes >= options_.max_nodes) {
      stop(TraceStatus::too_many_nodes, "stopped after " + std::to_string(result.nodes) + " points at " +
                                            here + "; raise max_nodes or the tolerance");
      return;
    }
    if (state_.steps.towards_pole >= enough_towards_pole) {
      stop(TraceStatus::step_too_small, "the equilibrium runs to infinity near " + here +
                                            ", as on a line of equilibria without end, or of an unbalanced "
                                            "rotor without damping at a critical speed; begin another trace "
                                            "behind it");
      return;
    }
    // The factors are no longer needed: the next point is predicted from the series.
    for (Track& track : state_.origin.node.tracks) track.pair.factors.reset();
    result.seconds = seconds_so_far();
    if (result.nodes > 0 && !observer_.checkpoint(*this)) {
      stop(TraceStatus::stopped, "stopped on request at " + here);
      return;
    }
    if (!advance()) return;
    if (state_.steps.turned_step > 0.0) {
      // In the coordinate across a plane, which is scaled, the range has a length of about one.
      const double longest =
          options_.max_step ? *options_.max_step / state_.frame.range.length() : longest_step;
      state_.control = StepControl(problem_.order, state_.steps.turned_step, std::max(longest, shortest_step),
                                   shortest_step);
      state_.steps.turned_step = 0.0;
    }
  }
}

/// One attempt at a step: proposes a length, solves and judges the step, shortens it where it has to end on a
/// special point (landing), and commits it. If the step is rejected, applies a remedy or shortens the next
/// attempt. Returns whether the trace goes on.
bool TraceLoop::advance() {
  const std::string here = place_text(options_, state_.origin.node.p);
  const auto to_infinity = way_to_infinity(problem_, here, state_);
  if (!to_infinity)
    return stop(TraceStatus::step_too_small, "all modes that are followed run to infinity at " + here +
                                                 "; begin another trace behind it, or follow all modes");
  const double ahead = std::min({remaining(state_.frame, state_.origin.node), *to_infinity,
                                 distance_to_next(narrow_places_, state_.frame, state_.origin.node)});
  const double length = state_.control.propose(std::min(ahead, longest_allowed_step()));
  const double h = state_.frame.direction * length;
  AttemptedStep attempted = steps().attempt(h);
  if (attempted.step && is_near_real_axis(problem_, attempted.step->right)) {
    join_conjugate_parts(problem_, state_);
    return true;  // the step is tried again
  }
  const PathNode* next = attempted.step ? &attempted.step->right : nullptr;
  if (bridge_branch_point(points_, state_.frame, state_.origin.node, h, next, state_.branches.tries))
    return true;
  const auto if_uncertified = [this](double of_length) {
    const StepMemory& memory = state_.steps;
    return memory.retries.treatment(state_.frame, of_length, memory.longest_step, state_.result.nodes,
                                    budget_of_certificate(state_, options_));
  };
  const auto is_taken = [&](const Verdict& verdict, double of_length) {
    return verdict.accepted() || (verdict.kind == Verdict::Kind::uncertified &&
                                  if_uncertified(of_length) != Uncertified::is_rejected);
  };
  Verdict verdict = attempted.step ? judge(*attempted.step, if_uncertified(h)) : attempted.verdict;
  while (attempted.step && notices_rounding(problem_, options_, *attempted.step, verdict, state_))
    verdict = judge(*attempted.step, if_uncertified(h));
  if (!verdict.accepted()) {
    const bool may_be_taken = is_taken(verdict, h);
    if (find_remedy(verdict, h, attempted.step ? &*attempted.step : nullptr)) return true;
    if (!may_be_taken) return shorten(verdict, length);
  }
  StepSolver solver = steps();
  std::optional<LandedStep> landed =
      land(solver, std::move(*attempted.step), may_stay_uncertified(state_.frame, h));
  if (!landed) {
    return shorten(
        {verdict.kind, verdict.track, INFINITY, "a place where the step has to end was not reached"}, length);
  }
  if (landed->step.h == h) {
    state_.control.accept(length, verdict.error);
    return commit(std::move(*landed), verdict.certified);
  }
  const double cut = landed->step.h;
  landed->step.whole = h;  // its error was accepted; if it is uncertified, too
  const Verdict anew = judge(landed->step, if_uncertified(cut));
  if (!is_taken(anew, cut)) {
    if (find_remedy(anew, cut, &landed->step)) return true;
    return shorten(anew, std::abs(cut));
  }
  state_.control.accept(length, verdict.error);
  return commit(std::move(*landed), anew.certified);
}

Verdict TraceLoop::judge(const Step& step, Uncertified uncertified) {
  const bool costly = is_costly_in_vain(state_.result.counts);
  tests_.clear();
  const CertificateBudget budget = budget_of_certificate(state_, options_);
  for (const Track& track : step.right.tracks)
    tests_.push_back(state_.steps.retries.test_of(track.lineage, budget, costly));
  return eigentrail::judge(problem_, state_.frame, options_, step, uncertified, tests_, state_.result.counts);
}

bool TraceLoop::find_remedy(const Verdict& verdict, double h, const Step* step) {
  count(verdict, state_.result.rejections);
  StepMemory& memory = state_.steps;
  const bool uncertified = verdict.kind == Verdict::Kind::uncertified;
  if (uncertified) memory.retries.count_failure();
  const Shorter shorter =
      uncertified && memory.retries.is_in_vain(verdict.error) ? Shorter::in_vain : Shorter::may_help;
  const int limit = std::max(most_joins, static_cast<int>(state_.origin.node.tracks.size()));
  const Remedy remedy =
      eigentrail::find_remedy(problem_, state_.frame, joining_rules(), verdict, h, step, memory.joins < limit,
                              shorter, state_.origin.node, state_.result.counts);
  if (remedy.tried_to_join) ++memory.joins;
  if (!remedy.helps()) return false;
  if (remedy.turned_step) memory.turned_step = *remedy.turned_step;
  add(remedy.changes, state_.result.regroupings);
  return true;
}

/// Shortens the next attempt. A track for which no length is short enough ends here, and the others go on.
bool TraceLoop::shorten(const Verdict& verdict, double length) {
  const bool open = verdict.kind == Verdict::Kind::uncertified;
  state_.control.reject(length, open ? uncertified_error : verdict.error);
  if (!state_.control.exhausted()) return true;
  StepMemory& memory = state_.steps;
  PathNode& node = state_.origin.node;
  // If several modes fail at one place, it is not their fault.
  const bool one_fails = verdict.track >= 0 && node.tracks.size() > 1 && ++memory.ended <= most_ended;
  if (!one_fails)
    return stop(TraceStatus::step_too_small, too_small_message(problem_, options_, node, verdict));
  const std::vector<int> modes = node.tracks[static_cast<std::size_t>(verdict.track)].modes;
  const std::string who = end_track(problem_, node, static_cast<std::size_t>(verdict.track), state_.ended);
  if (!who.empty())
    add_note(state_.result, who + equal_modes_text(state_.copies, modes) + " ends at " +
                                place_text(options_, node.p) + ": " + verdict.reason);
  state_.control.restart(memory.longest_step);
  return true;
}

/// Takes a step: finds its events, stores and emits it, checks that no mode is missing, chooses what is
/// followed together behind its end, and makes the end the origin of the next step. Returns whether the trace
/// goes on. Where the chosen modes include one that nobody follows, the step is not taken, but tried again
/// with it.
bool TraceLoop::commit(LandedStep landed, const std::vector<bool>& certified) {
  Step& step = landed.step;
  TraceResult& result = state_.result;
  EnteringModes needed = needed_at(problem_, options_, step.right, state_);
  const int first = state_.numbers.count;
  const int guards = number_growing_guards(problem_, step.right, state_.origin.node, state_.numbers);
  if (guards + follow_back(problem_, needed.tracks, step.h, step.right, reach_, state_.origin.node,
                           state_.numbers, result.counts) >
      0) {
    if (result.nodes > 0)
      begin_histories(problem_, state_.origin.node, first, step.h, criteria_, state_.histories);
    number_modes(state_, state_.origin.node);
    return true;  // the step is taken again, with them
  }
  // Where they cannot be followed back, the place at which they begin is found to the tolerance.
  if (!needed.tracks.empty() && std::abs(step.h) > options_.tolerance * state_.frame.coordinate_range()) {
    ++result.rejections.mode_lost;
    state_.control.reject(std::abs(step.h), INFINITY);
    return true;
  }
  if (result.nodes == 0 && !emit(as_first(state_.origin.node), nullptr)) return false;
  settle_events(landed);
  const PathStep stored = with_copies(state_.copies, stored_step(problem_, step, certified));
  std::vector<std::uint64_t> lineages;
  for (const Track& track : step.right.tracks) lineages.push_back(track.lineage);
  state_.steps.retries.count_step(lineages, tests_, certified);
  for (std::size_t i = 0; i < certified.size(); ++i) {
    if (certified[i]) step.right.tracks[i].unproven = false;
  }
  const std::string where = "at " + place_text(options_, step.right.p);
  for (const std::string& who : find_again(problem_, step.right, state_.ended, result.counts))
    add_note(result, who + " was found again " + where + ", by its shape");
  const Completion found =
      complete(problem_, state_.settings.follows_all, step.right, state_.numbers, result.counts);
  // On a branch point a mode vanishes, and the two halves of its pair are one to rounding.
  if (found.doubtful && !state_.frame.on_branch_point(step.right))
    add_note(result, where + " two tracks share an eigenvalue, or one has left the spectrum; see verify");
  for (const OnePair& pair : found.pairs)
    add_note(result, where + " modes " + std::to_string(pair.kept + 1) + " and " +
                         std::to_string(pair.ended + 1) + " are one complex pair, which goes on as mode " +
                         std::to_string(pair.kept + 1));
  for (int i = 0; i < found.added; ++i) add_note(result, "a mode that was missing was added " + where);
  result.regroupings.repaired += found.added;
  const int begun = begin_here(problem_, std::move(needed.tracks), step.right, state_.numbers);
  for (int i = 0; i < begun; ++i)
    add_note(result, "a mode that is wanted, or grows, was noticed " + where +
                         " and could not be followed back; it begins there");
  growing_unfollowed_ = needed.growing;
  number_modes(state_, step.right);
  for (const DenseBlock& block : stored.blocks) {
    result.mode_steps += static_cast<long>(block.modes.size());
    if (block.certified) result.certified_steps += static_cast<long>(block.modes.size());
  }
  const bool go_on = emit(step.right, &stored);
  for (Track& track : step.right.tracks) track.arriving = track.modes;
  const bool leaves = leaves_path_at(step.right);
  const bool passes = state_.frame.on_branch_point(step.right);
  if (!leaves) regroup(step);
  move_on(std::move(step));
  const bool goes_on = go_on && (!leaves || leave_path());
  if (passes) ++state_.branches.passed;
  return goes_on;
}

/// Finds and records the events of a step, in this order: coinciding eigenvalues at its end, zeros and
/// extrema of criteria, veerings, crossings of independent parts, branch point, fold. After the first of
/// these, orders the modes behind its end.
void TraceLoop::settle_events(LandedStep& landed) {
  const EventWork work(state_.result.counts);
  search_.node = state_.result.nodes;
  Step& step = landed.step;
  mark_meetings(landed.meetings, step.right);
  FoundEvents met = meeting_events(search_, step.right, landed.meetings);
  // If the trace leaves its path here, leave_path orders the modes on the other path.
  std::vector<Birth> births;
  if (!leaves_path_at(step.right))
    births = order_departure(step, coinciding_tracks(step.right, landed.meetings), state_.numbers,
                             [&](std::size_t track, double distance) {
                               const auto point = points_.follow(one_track(step.right, track), distance);
                               return point ? point->node.tracks.front().roots : ComplexVector();
                             });
  mark_doubtful(landed.meetings, step.right);
  name_births(births, met);
  number_modes(state_, step.right);
  log(std::move(met));
  log(scan_criteria(search_, step, state_.histories));
  inherit_histories(births, criteria_, state_.histories);  // after the scan of their parents up to here
  if (options_.events.veerings) log(find_veerings(search_, step));
  log(find_part_crossings(search_, step));
  log_branch_point(step.right);
  log(find_fold(search_, step.right, step.h));
  log(find_trimmed_crossing(search_, step));
  if (auto remark = unexplained_growth(search_, step)) add_note(state_.result, std::move(*remark));
}

/// If a point lies on a branch point, records it with a note on the paths that leave it.
void TraceLoop::log_branch_point(const PathNode& node) {
  FoundEvents found = find_branch_point(search_, node);
  if (found.events.empty()) return;
  const int choice = choice_at(options_.branch, state_.branches.passed);
  if (choice != 1) found.events.front().direction = 0;  // what grows straight on says nothing of that path
  if (!options_.events.other_paths && choice == 1) return log(std::move(found));
  BranchSurvey survey = survey_branch_point(points_, node, choice, place_text(options_, node.p));
  state_.branches.other = std::move(survey.other);
  found.notes.push_back(std::move(survey.note));
  log(std::move(found));
}

/// Chooses which modes are followed together from the end of a step on: separates blocks, or else joins modes
/// that limit the step.
void TraceLoop::regroup(Step& step) {
  TraceResult& result = state_.result;
  const double next_step = state_.control.step();
  const std::size_t before = step.right.tracks.size();
  part(problem_, step.left, step.right, next_step, step.h, {reach_, accepted_share * options_.tolerance},
       result.counts);
  const std::size_t after = step.right.tracks.size();
  result.regroupings.parted += static_cast<int>(after - std::min(before, after));
  if (after != before) return;
  add(regroup_limiting_modes(problem_, joining_rules(), step, state_.frame.direction * next_step,
                             result.counts),
      result.regroupings);
}

/// Makes the end of a step the origin of the next one. Changes the coordinate along the path where needed.
void TraceLoop::move_on(Step step) {
  StepMemory& memory = state_.steps;
  StepOrigin& origin = state_.origin;
  PathFrame& frame = state_.frame;
  memory.longest_step = std::max(std::abs(step.h), forgetting * memory.longest_step);
  memory.joins = 0;
  memory.ended = 0;
  state_.branches.tries = 0;
  const bool grows = grows_towards_pole(frame, origin.node, step.right);
  origin.node = std::move(step.right);
  memory.towards_pole = grows ? memory.towards_pole + 1 : 0;
  note_size(problem_.model, origin.node, frame);
  for (const Track& track : origin.node.tracks) {
    // Where eigenvalues of the next step can be told apart is on it.
    if (state_.control.step() < 2.0 * track.hidden_within) state_.control.restart(2.0 * track.hidden_within);
  }
  if (leaves_path_at(origin.node)) return;
  if (renew_plane(frame, origin.node)) ++state_.result.regroupings.planes;
  if (const auto turned =
          turn_to_plane(problem_, frame, origin.node, frame.direction * state_.control.step())) {
    memory.turned_step = *turned;
    ++state_.result.regroupings.planes;
  }
}

/// Continues along the other path from the branch point that was just reached. Returns whether the trace goes
/// on.
bool TraceLoop::leave_path() {
  const PathNode& arrived = state_.origin.node;
  const int choice = choice_at(options_.branch, state_.branches.passed);
  std::optional<OtherStart> start;
  if (state_.branches.other) start = start_on_other_path(points_, arrived, *state_.branches.other, choice);
  if (!start) {
    return stop(TraceStatus::no_branch,
                "the branch asked for at " + place_text(options_, arrived.p) + " was not found");
  }
  const auto births = order_on_other_path(arrived, start->next_step, start->node, state_.numbers);
  inherit_histories(births, criteria_, state_.histories);
  number_modes(state_, start->node);
  state_.frame = std::move(start->frame);
  state_.origin.node = std::move(start->node);
  state_.steps.turned_step = start->next_step;
  ++state_.result.regroupings.planes;
  return true;
}

double TraceLoop::longest_allowed_step() const {
  const std::vector<Track>& tracks = state_.origin.node.tracks;
  const bool large = std::any_of(tracks.begin(), tracks.end(), [](const Track& t) { return t.size() > 2; });
  return large ? longest_step_of_large_blocks * state_.frame.coordinate_range()
               : std::numeric_limits<double>::max();
}

bool TraceLoop::leaves_path_at(const PathNode& node) const {
  return state_.frame.on_branch_point(node) && choice_at(options_.branch, state_.branches.passed) != 1;
}

void TraceLoop::log(FoundEvents found) {
  const std::size_t before = state_.events.size();
  for (std::string& note : found.notes) add_note(state_.result, std::move(note));
  if (!options_.events.veerings)  // narrow ones are met without a search
    std::erase_if(found.events, [](const Event& event) { return event.kind == EventKind::veering; });
  record(log_, std::move(found.events), state_.events);
  for (std::size_t i = before; i < state_.events.size(); ++i) {
    for (Event& event : with_copies(state_.copies, state_.events[i]))
      state_.result.events.push_back(std::move(event));
  }
}

bool TraceLoop::emit(const PathNode& node, const PathStep* step) {
  TraceResult& result = state_.result;
  result.reached = node.p;
  ++result.nodes;
  const StageTimer timer(result.counts.output_seconds);
  const double along = state_.frame.plane ? rounding_along_path(node) : 0.0;
  const TracePoint point{
      node, mode_states(node, problem_.traced, state_.copies, problem_.thresholds.rounding, along), step,
      growing_unfollowed_};
  take_least_known(problem_, state_.frame, node, along, state_.least_known);
  if (observer_.point(point)) return true;
  return stop(TraceStatus::stopped, "stopped on request at " + place_text(options_, node.p));
}

bool TraceLoop::stop(TraceStatus status, const std::string& message) {
  state_.result.status = status;
  state_.result.message = message;
  return false;
}

double TraceLoop::seconds_so_far() const {
  return seconds_before_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

}  // namespace eigentrail
