#include "eigentrail/stability/axis_stretches.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "stability/axis_samples.hpp"

namespace eigentrail {
namespace {

/// Events closer together than this, relative to the steps that they are on, form one cut: nearer than the
/// dense output tells them apart.
constexpr double same_axis_place = 1e-9;
/// An event closer to a stored point than this, relative to the step, is at that point. Where eigenvalues
/// meet and at folds the trace stores a point, so that these events are at the nearer end of their step if it
/// is within this share of the parameter range (MeetingThresholds::at_point, with a margin).
constexpr double on_node = 1e-8;
/// A mode that begins or ends and is larger than this multiple of the reference comes from infinity or runs
/// there: typical eigenvalues are a thousand references, and modes that run to infinity end a hundred times
/// above the largest one at the start.
constexpr double large_size = 1e4;

/// The stability at a single sample; empty if the errors leave it open.
std::optional<Stability> verdict(const AxisSample& sample) {
  if (sample.critical < 0) return std::nullopt;
  if (!sample.unstable.empty()) return Stability::unstable;
  if (sample.all_decay()) return Stability::stable;
  return sample.exact ? std::optional(Stability::marginal) : std::nullopt;
}

/// The same position with the end of a step written as the beginning of the next step.
PathPosition normalized(const RecordedPath& path, PathPosition at) {
  return at.t >= 1.0 && at.step + 1 < path.steps.size() ? PathPosition{at.step + 1, 0.0} : at;
}

double length_of(const RecordedPath& path, std::size_t step) {
  return std::abs(path.p[step + 1] - path.p[step]);
}

/// Whether modes pass from one side of the axis to the other at an event.
bool passes(const Event& event) {
  return event.kind == EventKind::flutter || event.kind == EventKind::divergence;
}

/// Whether modes pass the axis at an event, or Re s is below its error by rounding (old files: by tolerance).
bool is_on_axis(const RecordedPath& path, const Event& event, const EigenvalueAccuracy& accuracy) {
  double doubt = path.rounding.size() > 0 ? 0.0 : accuracy.tolerance * scale_of(event.s, accuracy);
  const std::size_t node = std::min(static_cast<std::size_t>(std::max(event.node, 0)), path.p.size() - 1);
  for (const int mode : event.modes) doubt = std::fmax(doubt, path.rounding_at(node, mode));  // not NaN
  return passes(event) || std::abs(event.s.real()) <= doubt;
}

/// Position of an event on the step that ends at node `event.node`.
PathPosition position_of(const RecordedPath& path, const Event& event) {
  const std::size_t last = path.steps.size() - 1;
  const std::size_t step = std::min(static_cast<std::size_t>(std::max(event.node - 1, 0)), last);
  const double from_left = std::abs(event.p - path.p[step]);
  const double from_right = std::abs(event.p - path.p[step + 1]);
  const std::vector<double> found = step_positions(path.steps[step], event.p);
  // The nearer end is also taken if rounding has moved the event off the step.
  const double near = on_node * (passes(event) ? length_of(path, step) : path.highest() - path.lowest());
  if (found.empty() || std::min(from_left, from_right) <= near)
    return normalized(path, {step, from_left < from_right ? 0.0 : 1.0});
  return normalized(path, {step, found.front()});
}

/// The ends of the trace, its folds and branch points, and all other events on the imaginary axis except
/// veerings; sorted along the trace.
std::vector<AxisCut> event_cuts(const RecordedPath& path, const std::vector<Event>& events,
                                const EigenvalueAccuracy& accuracy) {
  std::vector<AxisCut> cuts;
  for (const Event& event : events) {
    const bool turns = event.kind == EventKind::fold || event.kind == EventKind::branch_point;
    if (!turns && (event.kind == EventKind::veering || !is_on_axis(path, event, accuracy))) continue;
    cuts.push_back({position_of(path, event), event.p, event.s, event.modes, event_name(event.kind), true,
                    passes(event), turns});
  }
  cuts.push_back({{0, 0.0}, path.p.front(), {}, {}, "start", false});
  cuts.push_back({{path.steps.size() - 1, 1.0}, path.p.back(), {}, {}, "end", false});
  std::stable_sort(cuts.begin(), cuts.end(), [](const AxisCut& a, const AxisCut& b) { return a.at < b.at; });
  return cuts;
}

/// Merges cuts at the same place. An event takes precedence over an end of the trace.
std::vector<AxisCut> united_cuts(const RecordedPath& path, std::vector<AxisCut> cuts) {
  std::vector<AxisCut> result;
  for (AxisCut& cut : cuts) {
    const std::size_t before = result.empty() ? cut.at.step : result.back().at.step;
    const double near = same_axis_place * (length_of(path, before) + length_of(path, cut.at.step));
    const bool same =
        !result.empty() && (cut.at == result.back().at || (cut.at.step - result.back().at.step <= 1 &&
                                                           std::abs(cut.p - result.back().p) <= near));
    if (!same) {
      result.push_back(std::move(cut));
      continue;
    }
    AxisCut& kept = result.back();
    if (!kept.on_axis) std::swap(kept, cut);
    kept.modes.insert(kept.modes.end(), cut.modes.begin(), cut.modes.end());
    std::sort(kept.modes.begin(), kept.modes.end());
    kept.modes.erase(std::unique(kept.modes.begin(), kept.modes.end()), kept.modes.end());
    kept.passes = kept.passes && (cut.passes || !cut.on_axis);
    kept.turns = kept.turns || cut.turns;
  }
  return result;
}

/// Whether the mode that grows at a cut is infinite there: 1/s is followed, or the mode is large and does not
/// exist on the other side, where the trace has ended it or not yet begun it.
bool is_at_infinity(const RecordedPath& path, const AxisCut& cut, const PathPosition& other_side,
                    const Judging& judging) {
  const DenseBlock* block = path.block_of(cut.at.step, cut.modes.front());
  if (block != nullptr && block->chart == Chart::reciprocal) return true;
  const bool exists = std::isfinite(path.eigenvalues_at(other_side)[cut.modes.front()].real());
  return !exists && std::abs(cut.s) > large_size * judging.accuracy.reference;
}

/// The place between two samples, one growing and one not, at which the dense output changes from growing to
/// not growing, by bisection. Beside a stored point at which modes are on the axis within rounding, all
/// growth beyond rounding counts, also what the tolerance would hide.
AxisCut sign_change(const RecordedPath& path, const AxisSample& first, const AxisSample& second,
                    const Judging& judging) {
  constexpr int halvings = 60;  // more than the 53 bits of a double: the loop ends before
  const AxisSample& growing = first.unstable.empty() ? second : first;
  const AxisSample& other = first.unstable.empty() ? first : second;
  const auto grows = [&](const AxisSample& s) {
    if (s.critical < 0) return false;
    return -s.margin > (other.all_decay() ? 0.0 : path.rounding_at(s.at, s.critical));
  };
  double inside = growing.at.in_steps();
  double outside = other.at.in_steps();
  AxisSample nearest = growing;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (inside + outside);
    if (middle == inside || middle == outside) break;
    const AxisSample there = axis_sample(path, path.position_at(middle), judging);
    (grows(there) ? inside : outside) = middle;
    if (grows(there)) nearest = there;
  }
  AxisCut cut;
  cut.at = path.position_at(inside);
  cut.p = path.parameter_at(cut.at);
  cut.modes = {nearest.critical};
  cut.s = path.eigenvalues_at(nearest.at)[nearest.critical];
  cut.cause = is_at_infinity(path, cut, path.position_at(outside), judging) ? "infinity" : "sign change";
  return cut;
}

/// A cut between the first two neighbouring samples of which one is unstable and the other is not; empty if
/// there are none. Samples without a verdict are passed over.
std::optional<AxisCut> missing_cut(const RecordedPath& path, const AxisStretch& stretch,
                                   const Judging& judging) {
  const AxisSample* before = nullptr;
  for (const AxisSample& here : stretch.samples) {
    const auto told = verdict(here);
    if (!told) continue;
    if (before != nullptr && (*told == Stability::unstable) != (verdict(*before) == Stability::unstable))
      return sign_change(path, *before, here, judging);
    before = &here;
  }
  return std::nullopt;
}

/// Whether a sign change is that of a fold or branch point, where a mode passes zero: the place of the event
/// is that of the equilibrium on a bridge, which differs a little from that of the mode.
bool is_of_turn(const RecordedPath& path, const AxisCut& turn, const AxisCut& change) {
  return turn.turns && std::abs(turn.p - change.p) <= on_node * (path.highest() - path.lowest());
}

AxisCut moved_to(const AxisCut& change, AxisCut turn) {
  turn.at = change.at;
  return turn;
}

/// Largest number of stretches between two events that were found. More sign changes than that between them
/// are noise; looking for each takes a walk along the dense output.
constexpr std::size_t most_between_events = 32;

/// Appends the stretch between two cuts. Where the samples show that a cut is missing, the stretch is split
/// there and both parts are treated likewise, while there are fewer than `most` stretches. This number and
/// the depth limit the search where noise makes signs alternate.
void add_stretches(const RecordedPath& path, const AxisCut& from, const AxisCut& to, const Judging& judging,
                   int depth, std::size_t most, std::vector<AxisStretch>& stretches) {
  constexpr int deepest = 12;
  AxisStretch stretch{from, to};
  add_samples(path, judging, stretch);
  if (stretch.samples.empty()) return;  // the sign change lies at a cut that exists already
  const bool may_split = depth < deepest && stretches.size() < most;
  if (const auto cut = may_split ? missing_cut(path, stretch, judging) : std::nullopt) {
    if (is_of_turn(path, from, *cut))
      return add_stretches(path, moved_to(*cut, from), to, judging, depth + 1, most, stretches);
    if (is_of_turn(path, to, *cut))
      return add_stretches(path, from, moved_to(*cut, to), judging, depth + 1, most, stretches);
    add_stretches(path, from, *cut, judging, depth + 1, most, stretches);
    add_stretches(path, *cut, to, judging, depth + 1, most, stretches);
    return;
  }
  stretches.push_back(std::move(stretch));
}

/// The sign of Re s of each mode on a stretch; open where its error hides it at all samples.
enum class Sign { open, decays, grows };
using Signs = std::map<int, Sign>;

Signs signs_of(const AxisStretch& stretch) {
  Signs signs;
  for (const AxisSample& here : stretch.samples) {
    for (const int mode : here.open) signs.emplace(mode, Sign::open);
    for (const int mode : here.decaying) signs[mode] = std::max(signs[mode], Sign::decays);
    for (const int mode : here.unstable) signs[mode] = Sign::grows;
  }
  return signs;
}

/// The stability of a stretch from all its samples; empty if these do not tell. `signs`: of its modes there.
std::optional<Stability> verdict(const AxisStretch& stretch, const Signs& signs) {
  std::optional<Stability> result;
  for (const AxisSample& here : stretch.samples) {
    const auto told = verdict(here);
    if (told == Stability::unstable) return told;
    // One stable sample makes the stretch stable, also if some real part is zero at a stored point.
    if (told && result != Stability::stable) result = told;
  }
  // Not if a mode that is missing there is never told from zero.
  const bool is_open =
      std::any_of(signs.begin(), signs.end(), [](const auto& mode) { return mode.second == Sign::open; });
  return result == Stability::stable && is_open ? std::nullopt : result;
}

/// Carries signs over a cut to those that are open behind it. Where modes meet the axis and do not pass it,
/// their signs say nothing about the other side. Where the path turns or branches, one passes that is not
/// known.
void carry(const Signs& from, const AxisCut& cut, Signs& to) {
  if (cut.turns) return;
  for (auto& [mode, sign] : to) {
    const auto known = from.find(mode);
    if (sign != Sign::open || known == from.end() || known->second == Sign::open) continue;
    const bool meets = std::binary_search(cut.modes.begin(), cut.modes.end(), mode);
    if (!meets)
      sign = known->second;
    else if (cut.passes)
      sign = known->second == Sign::grows ? Sign::decays : Sign::grows;
  }
}

/// Sets the stability of all stretches: by their samples where these tell, else by the signs of all modes.
void judge_stretches(std::vector<AxisStretch>& stretches) {
  std::vector<Signs> signs;
  std::vector<std::optional<Stability>> told;
  for (const AxisStretch& stretch : stretches) {
    signs.push_back(signs_of(stretch));
    told.push_back(verdict(stretch, signs.back()));
  }
  for (std::size_t i = 1; i < signs.size(); ++i) carry(signs[i - 1], stretches[i].from, signs[i]);
  for (std::size_t i = signs.size(); i-- > 1;) carry(signs[i], stretches[i].from, signs[i - 1]);
  for (std::size_t i = 0; i < signs.size(); ++i) {
    AxisStretch& stretch = stretches[i];
    bool all_decay = true;
    for (const auto& [mode, sign] : signs[i]) {
      all_decay = all_decay && sign == Sign::decays;
      if (sign == Sign::grows) stretch.growing.push_back(mode);
    }
    const Stability by_signs = !stretch.growing.empty() ? Stability::unstable
                               : all_decay              ? Stability::stable
                                                        : Stability::marginal;
    stretch.stability = told[i].value_or(by_signs);
  }
}

/// Judges a stretch by the growing modes of the whole model that are not followed, at the stored points
/// inside and next to it.
void include_unfollowed(const RecordedPath& path, AxisStretch& stretch) {
  int most = -1;
  for (std::size_t node = stretch.from.at.step; node <= stretch.to.at.step + 1; ++node) {
    if (node < path.growing_unfollowed.size()) most = std::max(most, path.growing_unfollowed[node]);
  }
  stretch.whole = most == 0;
  if (most > 0) stretch.stability = Stability::unstable;
}

}  // namespace

std::string stability_name(Stability stability) {
  return std::array{"stable", "marginal", "unstable", "undecided"}.at(static_cast<std::size_t>(stability));
}

std::vector<AxisStretch> axis_stretches(const RecordedPath& path, const std::vector<Event>& events,
                                        const EigenvalueAccuracy& accuracy) {
  if (path.steps.empty()) return {};
  const std::vector<AxisCut> cuts = united_cuts(path, event_cuts(path, events, accuracy));
  const Judging judging{accuracy, permanence_of_modes(path, accuracy)};
  std::vector<AxisStretch> stretches;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
    add_stretches(path, cuts[i], cuts[i + 1], judging, 0, stretches.size() + most_between_events, stretches);
  judge_stretches(stretches);
  for (AxisStretch& stretch : stretches) include_unfollowed(path, stretch);
  return stretches;
}

int count_growing(const AxisStretch& stretch, const AxisSample& sample) {
  if (stretch.stability != Stability::unstable) return 0;
  const auto grows_on_stretch = [&](int mode) {
    return std::binary_search(stretch.growing.begin(), stretch.growing.end(), mode);
  };
  const auto open = std::count_if(sample.open.begin(), sample.open.end(), grows_on_stretch);
  return std::max(static_cast<int>(sample.unstable.size()) + static_cast<int>(open), 1);
}

}  // namespace eigentrail
