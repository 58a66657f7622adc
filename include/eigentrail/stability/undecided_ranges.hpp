// Where errors of the model's data leave open whether a mode grows.
#pragma once

#include "eigentrail/continuation/data_errors.hpp"
#include "eigentrail/stability/stable_ranges.hpp"

namespace eigentrail {

/// The stable ranges of a trace without the parts on which the interval of some eigenvalue's real part holds
/// zero and none is positive as a whole, and those parts as ranges of their own, `undecided`. Marginal ranges
/// stay as they are: there modes lie on the axis by structure. The traced parameter must be monotonic along
/// the path. The error of an eigenvalue is that of the data plus that of the dense output.
std::vector<StableRange> with_undecided(const std::vector<StableRange>& ranges, const RecordedPath& path,
                                        const std::vector<Event>& events, const DataErrors& errors,
                                        const EigenvalueAccuracy& accuracy);

}  // namespace eigentrail
