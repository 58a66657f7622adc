// Extrema of damping ratios that the errors of the data may have made.
#pragma once

#include <vector>

#include "eigentrail/continuation/data_errors.hpp"
#include "eigentrail/continuation/event.hpp"
#include "eigentrail/continuation/recorded_path.hpp"

namespace eigentrail {

/// Removes, from `events` and from the intervals in `errors`, the extrema of damping ratios whose depth is no
/// larger than the errors of the data: the damping ratio changes by less than the sum of both errors from
/// there to a neighbouring extremum, or to an end of the mode. The two
/// neighbours with the smallest change, in units of the errors, go first, so that a deep one stays between
/// shallow ones (persistence; Edelsbrunner, Letscher & Zomorodian, Discrete Comput. Geom. 28, 2002). Returns
/// the number of removed ones.
int remove_shallow_extrema(const RecordedPath& path, std::vector<Event>& events, DataErrors& errors);

}  // namespace eigentrail
