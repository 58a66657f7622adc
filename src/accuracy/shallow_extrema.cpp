#include "eigentrail/accuracy/shallow_extrema.hpp"

#include <algorithm>
#include <cmath>
#include <map>

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

}  // namespace

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
    std::stable_sort(list.begin(), list.end(),
                     [](const Turn& a, const Turn& b) { return a.place < b.place; });
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

}  // namespace eigentrail
