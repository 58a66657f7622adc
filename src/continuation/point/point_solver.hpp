// Points of the path, predicted from the series of another one and solved.
#pragma once

#include <optional>
#include <vector>

#include "continuation/path/path_frame.hpp"

namespace eigentrail {

/// Some tracks of a point, or other tracks of its pencil. Refers to what it was made from.
struct TracksAt {
  const PathNode& node;
  std::vector<const Track*> tracks;
};
TracksAt all_tracks(const PathNode& node);
TracksAt one_track(const PathNode& node, std::size_t track);

/// A point with its factorizations (for derivatives along other parameters) and its series.
struct SolvedPoint {
  PathPoint point;
  PathNode node;
};

class PointSolver {
 public:
  /// Refers to all three. Work is added to `counts`.
  PointSolver(const PathProblem& problem, const PathFrame& frame, RunCounts& counts)
      : problem_(problem), frame_(frame), counts_(counts) {}

  const PathProblem& problem() const { return problem_; }
  const PathFrame& frame() const { return frame_; }
  RunCounts& counts() const { return counts_; }

  /// What the series tell of the place at distance h along the path, in the frame's coordinate.
  Prediction predict(const TracksAt& base, double h) const;

  /// The point at a prediction, with `nearby_basis` the tangent basis of a point close by; nothing where the
  /// equilibrium or a mode is not found.
  std::optional<SolvedPoint> solve(const Prediction& prediction, const Matrix& nearby_basis) const;

  /// The point at distance h, with the tracks of `base`; nothing where it is not found.
  std::optional<SolvedPoint> follow(const TracksAt& base, double h) const;

  /// Equilibrium and pencil at distance h; no modes.
  PathPoint reduce(const PathNode& base, double h) const;

 private:
  const PathProblem& problem_;
  const PathFrame& frame_;
  RunCounts& counts_;
};

/// Between construction and destruction factorizations of modes count as work for events.
class EventWork {
 public:
  explicit EventWork(RunCounts& counts)
      : counts_(counts), before_(counts.modes.factorizations), timer_(counts.events_seconds) {}
  ~EventWork() {
    counts_.event_factorizations += counts_.modes.factorizations - before_;
    counts_.modes.factorizations = before_;
  }
  EventWork(const EventWork&) = delete;
  EventWork& operator=(const EventWork&) = delete;

 private:
  RunCounts& counts_;
  std::uint64_t before_;
  StageTimer timer_;
};

}  // namespace eigentrail
