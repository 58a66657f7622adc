// A trace on a planted family, stopped between two points: solver, frame and log, and steps between points
// that the test chooses.
#pragma once

#include "continuation/events/event_search.hpp"
#include "continuation/planted_points.hpp"
#include "continuation/step/step_solver.hpp"
#include "support/traced_path.hpp"

namespace eigentrail::test {

/// Keeps references to itself, and so is neither copied nor moved.
struct PlantedSearch {
  explicit PlantedSearch(Planted planted, double from = -1.0, double to = 1.0)
      : family(std::move(planted)),
        options(options_on(from, to)),
        frame{PathRange{family.problem().traced, from, to}},
        solver(family.problem(), frame, family.counts),
        log{events, frame.range, family.problem().thresholds},
        search{solver, options, criteria, log, 1} {
    frame.direction = to > from ? 1.0 : -1.0;
  }
  PlantedSearch(const PlantedSearch&) = delete;
  PlantedSearch& operator=(const PlantedSearch&) = delete;

  /// The step between two points with the same tracks in the same order. `left` must outlive it.
  Step step(const PathNode& left, double to, const std::vector<Together>& tracks) {
    Step step;
    step.left = &left;
    step.right = family.point(to, tracks, left.basis.T[0]);
    step.h = to - left.p;
    return step;
  }

  Planted family;
  TraceOptions options;
  PathFrame frame;
  PointSolver solver;
  std::vector<Criterion> criteria = {};
  std::vector<Event> events = {};
  EventLog log;
  EventSearch search;
};

}  // namespace eigentrail::test
