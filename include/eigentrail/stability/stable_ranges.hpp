// The ranges of the traced parameter on which no mode grows.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "eigentrail/stability/axis_stretches.hpp"

namespace eigentrail {

struct RangeEnd {
  double p = 0.0;     ///< value of the traced parameter
  std::string cause;  ///< what ends the range: an event's name, "start", "end", "infinity", "sign change" or
                      ///< "data error"
  double margin = 0.0;  ///< -max Re s there, 1/s; zero where an eigenvalue meets the imaginary axis
  int mode = -1;        ///< the mode that meets the axis or has the largest Re s, from 0; -1: none is known
};

/// A range without growing modes, in the order of the trace. If the path turns back at a fold, the ranges
/// before and behind the fold may contain the same parameter values.
struct StableRange {
  Stability kind = Stability::stable;  ///< stable, marginal or undecided
  RangeEnd from, to;
  double least_margin = 0.0;    ///< at the ends and at extrema between them, 1/s
  double largest_margin = 0.0;  ///< of the same margins, 1/s
  double largest_at = 0.0;      ///< parameter value with the largest margin
  /// Whether it holds for the whole model; otherwise for the followed modes, and others may grow.
  bool whole = false;

  /// Sets the margins to that of the begin; those of other places are included one by one, in order.
  void begin_margins() {
    least_margin = largest_margin = from.margin;
    largest_at = from.p;
  }
  void include(double margin, double p) {
    least_margin = std::min(least_margin, margin);
    if (margin <= largest_margin) return;
    largest_margin = margin;
    largest_at = p;
  }
};

/// Stable and marginal ranges from the first point of the path to the last. `events`: all events of the
/// trace, in any order.
std::vector<StableRange> stable_ranges(const RecordedPath& path, const std::vector<Event>& events,
                                       const EigenvalueAccuracy& accuracy);

/// What begins, or ends, at a special point.
enum class Onset {
  none,
  flutter,    ///< a pair grows: Re s changes its sign, or frequencies without damping coalesce
  divergence  ///< a real eigenvalue grows, or an equilibrium loses its stability at a fold or a branch point
};

/// `ranges`: those of the whole trace.
Onset onset_at(const Event& event, const std::vector<StableRange>& ranges);

}  // namespace eigentrail
