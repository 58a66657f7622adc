// Where everything is stable: the ranges of the parameter on which no mode grows.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/stability/axis_stretches.hpp"

namespace eigentrail {

struct RangeEnd {
  double p = 0.0;       ///< traced parameter
  std::string cause;    ///< what ends the range: an event's name, "start", "end", "infinity" or "sign change"
  double margin = 0.0;  ///< -max Re s there, 1/s; zero where an eigenvalue meets the imaginary axis
  int mode = -1;        ///< from 0: the mode that meets the axis, or has the margin; -1: none stands out
};

/// A range without growing modes, from one end to the other in the order of the trace. Where the path turns
/// back at a fold, ranges before and behind it may hold the same parameter values.
struct StableRange {
  Stability kind = Stability::stable;  ///< stable or marginal
  RangeEnd from, to;
  double least_margin = 0.0;    ///< at the ends, the stored points and eight places between two of them, 1/s
  double largest_margin = 0.0;  ///< likewise
  double largest_at = 0.0;      ///< parameter of the largest margin
};

/// Stable and marginal ranges from the first point of the path to the last. Of all modes that were followed.
std::vector<StableRange> stable_ranges(const RecordedPath& path, const std::vector<Event>& events,
                                       const EigenvalueAccuracy& accuracy);

}  // namespace eigentrail
