// Prediction of points of the path from the series of another point, and their computation.
#pragma once

#include <optional>
#include <vector>

#include "continuation/path/path_frame.hpp"

namespace eigentrail {

/// A point and some tracks at it: of the node, or others of its pencil. Holds references.
struct TracksAt {
  const PathNode& node;
  std::vector<const Track*> tracks;
};
TracksAt all_tracks(const PathNode& node);
TracksAt one_track(const PathNode& node, std::size_t track);

/// The pair that the series of a track predict at distance h, Z in physical coordinates.
InvariantPair predicted_pair(const Track& track, double h);

/// A point with its factorizations, for derivatives with respect to other parameters, and its series.
struct SolvedPoint {
  PathPoint point;
  PathNode node;
};

/// Computes points of the path.
class PointSolver {
 public:
  /// Keeps references to all three arguments. Work is added to `counts`.
  PointSolver(const PathProblem& problem, const PathFrame& frame, RunCounts& counts)
      : problem_(problem), frame_(frame), counts_(counts) {}

  const PathProblem& problem() const { return problem_; }
  const PathFrame& frame() const { return frame_; }
  RunCounts& counts() const { return counts_; }

  /// The prediction from the series at `base` for the signed distance h along the path, in the frame's
  /// coordinate.
  Prediction predict(const TracksAt& base, double h) const;

  /// The point computed from a prediction. `nearby_basis` is the tangent basis of a point close by, to which
  /// the new one is aligned. Empty if the equilibrium or a mode is not found.
  std::optional<SolvedPoint> solve(const Prediction& prediction, const Matrix& nearby_basis) const;

  /// The point at distance h, with the tracks of `base`; empty if it is not found.
  std::optional<SolvedPoint> follow(const TracksAt& base, double h) const;

  /// Equilibrium and reduced pencil at distance h, without modes. The status of the result tells failures.
  PathPoint reduce(const PathNode& base, double h) const;

 private:
  const PathProblem& problem_;
  const PathFrame& frame_;
  RunCounts& counts_;
};

/// Between its construction and destruction, factorizations of modes are counted as work for events, and the
/// time as that of events.
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
