#include "eigentrail/stability/stable_ranges.hpp"

#include <algorithm>
#include <cmath>

namespace eigentrail {
namespace {

/// Margin at a cut without the modes of the cut: used where an eigenvalue passes through infinity and so has
/// no finite margin.
double margin_of_others(const RecordedPath& path, const AxisCut& cut) {
  const ComplexVector s = path.eigenvalues_at(cut.at);
  double fastest = -INFINITY;
  for (Eigen::Index mode = 0; mode < s.size(); ++mode) {
    const bool of_cut = std::find(cut.modes.begin(), cut.modes.end(), mode) != cut.modes.end();
    if (!of_cut && std::isfinite(s[mode].real())) fastest = std::max(fastest, s[mode].real());
  }
  return -fastest;
}

enum class Side { begin, end };

/// The begin or end of a range at `cut`. `nearest`: the sample of the range next to it. Where a growing mode
/// ends at infinity, or comes from there, nothing is known on that step, and the range stays off it.
RangeEnd range_end(const RecordedPath& path, Stability kind, Side side, const AxisCut& cut,
                   const AxisSample& nearest) {
  RangeEnd end{cut.p, cut.cause};
  if (cut.on_axis) {
    end.mode = cut.modes.empty() ? nearest.critical : cut.modes.front();
    if (cut.cause == "infinity") {
      end.margin = margin_of_others(path, cut);
      if (!std::isfinite(path.eigenvalues_at(nearest.at)[end.mode].real()))
        end.p = path.p[nearest.at.step + (side == Side::begin ? 1 : 0)];
    }
  } else if (kind == Stability::stable) {
    end.margin = nearest.margin > nearest.doubt ? nearest.margin : 0.0;
    end.mode = nearest.critical;
  }
  return end;
}

/// The range that consists of the stretches `first` to `last`, all of the same stability.
StableRange join(const RecordedPath& path, const AxisStretch* first, const AxisStretch* last) {
  StableRange range;
  range.kind = first->stability;
  range.whole = std::all_of(first, last + 1, [](const AxisStretch& stretch) { return stretch.whole; });
  range.from = range_end(path, range.kind, Side::begin, first->from, first->samples.front());
  range.to = range_end(path, range.kind, Side::end, last->to, last->samples.back());
  if (range.kind == Stability::marginal) {
    range.largest_at = range.from.p;
    return range;
  }
  range.begin_margins();
  for (const AxisStretch* stretch = first; stretch <= last; ++stretch) {
    for (const AxisSample& sample : stretch->samples)
      range.include(std::max(sample.margin, 0.0), path.parameter_at(sample.at));
  }
  range.include(range.to.margin, range.to.p);
  return range;
}

/// Whether modes grow on one side of an event only: one range ends or begins there.
bool bounds_growth(const Event& event, const std::vector<StableRange>& ranges) {
  std::ptrdiff_t ends = 0;
  for (const StableRange& range : ranges)
    for (const RangeEnd& end : {range.from, range.to})
      ends += end.p == event.p && end.cause == event_name(event.kind) ? 1 : 0;
  return ends == 1;
}

}  // namespace

Onset onset_at(const Event& event, const std::vector<StableRange>& ranges) {
  switch (event.kind) {
    case EventKind::flutter:
    case EventKind::divergence:
    case EventKind::collision:  // where Re s only touches zero nothing begins
      if (event.direction == 0) return Onset::none;
      return event.s.imag() == 0.0 ? Onset::divergence : Onset::flutter;
    case EventKind::fold:
    case EventKind::cusp:
    case EventKind::branch_point:
      return event.direction != 0 || bounds_growth(event, ranges) ? Onset::divergence : Onset::none;
    default:
      return Onset::none;
  }
}

std::vector<StableRange> stable_ranges(const RecordedPath& path, const std::vector<Event>& events,
                                       const EigenvalueAccuracy& accuracy) {
  const std::vector<AxisStretch> stretches = axis_stretches(path, events, accuracy);
  std::vector<StableRange> ranges;
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    const std::size_t first = i;
    const auto goes_on = [&](std::size_t next) {
      return next < stretches.size() && stretches[next].stability == stretches[first].stability &&
             !stretches[next].from.turns;
    };
    while (goes_on(i + 1)) ++i;
    if (stretches[first].stability != Stability::unstable)
      ranges.push_back(join(path, &stretches[first], &stretches[i]));
  }
  return ranges;
}

}  // namespace eigentrail
