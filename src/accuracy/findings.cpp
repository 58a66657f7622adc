#include "eigentrail/accuracy/findings.hpp"

#include <algorithm>

#include "core/texts.hpp"
#include "eigentrail/accuracy/data_errors.hpp"
#include "eigentrail/accuracy/shallow_extrema.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/stability/undecided_ranges.hpp"

namespace eigentrail {
namespace {

/// Whether a mode of a trace is in the band somewhere.
bool is_reached(const FrequencyBand& band, const RecordedPath& path, const std::vector<Event>& events) {
  const auto frequency = path.eigenvalues.imag().array();
  return (frequency >= band.lowest && frequency <= band.highest).any() ||
         std::any_of(events.begin(), events.end(),
                     [](const Event& event) { return event.kind == EventKind::band_edge; });
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
