// Data that every search for events on a step needs.
#pragma once

#include "continuation/events/criterion.hpp"
#include "continuation/events/event_log.hpp"
#include "continuation/point/point_solver.hpp"
#include "core/texts.hpp"
#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

/// Keeps references to its parts.
struct EventSearch {
  const PointSolver& solver;
  const TraceOptions& options;
  const std::vector<Criterion>& criteria;
  const EventLog& log;
  int node = 0;  ///< number of the point at the end of the step

  const PathProblem& problem() const { return solver.problem(); }
  const PathFrame& frame() const { return solver.frame(); }
  const Thresholds& thresholds() const { return solver.problem().thresholds; }
};

/// "omega = 12.4", for messages.
inline std::string place_text(const TraceOptions& options, double p) {
  return options.parameter + " = " + short_text(p, 12);
}

}  // namespace eigentrail
