#include "eigentrail/accuracy/findings.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/texts.hpp"
#include "eigentrail/accuracy/data_errors.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/stability/undecided_ranges.hpp"

namespace eigentrail {
namespace {

/// An extremum of the damping ratio of a mode, or an end of the mode.
struct Turn {
  double place = 0.0;  ///< in steps from the first point
  double ratio = 0.0;
  double error = 0.0;        ///< of the ratio
  std::size_t event = 0;     ///< number of the event
  bool is_extremum = false;  ///< not an end
};

Turn turn_at(const RecordedPath& path, const DataErrors& errors, PathPosition at, Eigen::Index mode) {
  const Complex s = path.eigenvalues_at(at)[mode];
  const double size = std::abs(s);
  return {at.in_steps(), -s.real() / size, errors.at(at.step, mode, path.parameter_at(at)) / size};
}

/// The first and the last point of the path at which the mode exists.
std::vector<Turn> ends_of(const RecordedPath& path, const DataErrors& errors, Eigen::Index mode) {
  std::vector<Turn> ends;
  const std::size_t count = path.steps.size();
  for (std::size_t i = 0; i < count && ends.empty(); ++i) {
    const Turn turn = turn_at(path, errors, {i, 0.0}, mode);
    if (std::isfinite(turn.ratio)) ends.push_back(turn);
  }
  for (std::size_t i = count; i > 0 && ends.size() == 1; --i) {
    const Turn turn = turn_at(path, errors, {i - 1, 1.0}, mode);
    if (std::isfinite(turn.ratio)) ends.push_back(turn);
  }
  return ends;
}

/// The change of the damping ratio between neighbours, in units of their errors. Two ends are none.
double depth(const Turn& a, const Turn& b) {
  if (!a.is_extremum && !b.is_extremum) return INFINITY;
  const double error = a.error + b.error;
  return error > 0.0 ? std::abs(a.ratio - b.ratio) / error : INFINITY;
}

/// Takes turns out as long as two neighbours differ by no more than their errors; returns the events.
std::vector<std::size_t> shallow(std::vector<Turn> turns) {
  std::vector<std::size_t> events;
  while (turns.size() > 1) {
    std::size_t least = 0;
    for (std::size_t i = 1; i + 1 < turns.size(); ++i) {
      if (depth(turns[i], turns[i + 1]) < depth(turns[least], turns[least + 1])) least = i;
    }
    if (depth(turns[least], turns[least + 1]) > 1.0) break;
    // Beside an end only the extremum goes.
    for (const std::size_t i : {least + 1, least}) {
      if (!turns[i].is_extremum) continue;
      events.push_back(turns[i].event);
      turns.erase(turns.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
  return events;
}

/// Removes, from `events` and from the intervals in `errors`, the extrema of damping ratios whose depth is no
/// larger than the errors of the data: the damping ratio changes by less than the sum of both errors from
/// there to a neighbouring extremum, or to an end of the mode. The two
/// neighbours with the smallest change, in units of the errors, go first, so that a deep one stays between
/// shallow ones (persistence; Edelsbrunner, Letscher & Zomorodian, Discrete Comput. Geom. 28, 2002). Returns
/// the number of removed ones.
int remove_shallow_extrema(const RecordedPath& path, std::vector<Event>& events, DataErrors& errors) {
  std::map<int, std::vector<Turn>> turns;  // by mode
  for (std::size_t i = 0; i < events.size(); ++i) {
    const Event& event = events[i];
    if (event.kind != EventKind::extremum || event.modes.empty()) continue;
    const auto positions = path.positions(event.p);
    if (positions.empty()) continue;
    Turn turn = turn_at(path, errors, positions.front(), event.modes.front());
    turn.event = i;
    turn.is_extremum = true;
    if (std::isfinite(turn.ratio)) turns[event.modes.front()].push_back(turn);
  }
  std::vector<bool> remove(events.size(), false);
  for (auto& [mode, list] : turns) {
    const std::vector<Turn> ends = ends_of(path, errors, mode);
    list.insert(list.end(), ends.begin(), ends.end());
    std::ranges::stable_sort(list, {}, &Turn::place);
    for (const std::size_t event : shallow(list)) remove[event] = true;
  }
  std::vector<Event> kept;
  std::vector<EventInterval> intervals;
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (remove[i]) continue;
    kept.push_back(std::move(events[i]));
    intervals.push_back(errors.intervals[i]);
  }
  const auto removed = static_cast<int>(events.size() - kept.size());
  events = std::move(kept);
  errors.intervals = std::move(intervals);
  return removed;
}

/// Whether a mode of a trace is in the band somewhere.
bool is_reached(const FrequencyBand& band, const RecordedPath& path, const std::vector<Event>& events) {
  const auto frequency = path.eigenvalues.imag().array();
  return (frequency >= band.lowest && frequency <= band.highest).any() ||
         std::ranges::find(events, EventKind::band_edge, &Event::kind) != events.end();
}

/// Notes where a range ends at no special point: one was missed, or none could be located.
void note_unlocated(const TraceOptions& options, const std::vector<StableRange>& ranges,
                    TraceResult& result) {
  for (const StableRange& range : ranges) {
    for (const RangeEnd& end : {range.from, range.to}) {
      if (end.cause == "sign change")
        result.notes.push_back("stability changes near " + options.parameter + " = " + short_text(end.p, 12) +
                               ", where no special point was located; see verify");
    }
  }
}

}  // namespace

Findings find_ranges_and_errors(const Model& model, const TraceOptions& options, RecordedPath path,
                                TraceResult& result) {
  const EigenvalueAccuracy accuracy{options.tolerance, result.s_ref};
  Findings found{std::move(path), {}, {}};
  if (result.status == TraceStatus::completed && options.modes.band &&
      !is_reached(*options.modes.band, found.path, result.events)) {
    result.status = TraceStatus::outside_band;
    result.message = "no mode lies in the band from " + exact_text(options.modes.band->lowest) + " to " +
                     exact_text(options.modes.band->highest) +
                     " rad/s anywhere on the range; the nearest was followed";
  }
  found.ranges = stable_ranges(found.path, result.events, accuracy);
  note_unlocated(options, found.ranges, result);
  found.errors = data_errors(model, options, found.path, result.events);
  if (!found.errors) return found;
  const int shallow = remove_shallow_extrema(found.path, result.events, *found.errors);
  if (shallow > 0)
    result.notes.push_back(std::to_string(shallow) + (shallow == 1 ? " extremum" : " extrema") +
                           " of damping ratios left out: no deeper than the errors of the data");
  found.ranges = with_undecided(found.ranges, found.path, result.events, *found.errors, accuracy);
  return found;
}

}  // namespace eigentrail
