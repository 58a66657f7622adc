#include "eigentrail/accuracy/findings.hpp"

#include "eigentrail/accuracy/data_errors.hpp"
#include "eigentrail/accuracy/shallow_extrema.hpp"
#include "eigentrail/stability/undecided_ranges.hpp"

namespace eigentrail {

Findings find_ranges_and_errors(const Model& model, const TraceOptions& options, RecordedPath path,
                                TraceResult& result) {
  const EigenvalueAccuracy accuracy{options.tolerance, result.s_ref};
  Findings found{std::move(path), {}, {}};
  found.ranges = stable_ranges(found.path, result.events, accuracy);
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
