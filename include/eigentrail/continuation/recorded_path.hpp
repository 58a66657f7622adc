// The dense output of a whole trace: its points and the steps between them.
#pragma once

#include <vector>

#include "eigentrail/continuation/path_step.hpp"
#include "eigentrail/continuation/trace.hpp"

namespace eigentrail {

/// A place on the path: t in [0, 1] on the step between two nodes. Ordered as the trace goes.
struct PathPosition {
  std::size_t step = 0;
  double t = 0.0;
  auto operator<=>(const PathPosition&) const = default;
};

struct RecordedPath {
  std::vector<double> p;        ///< per node; monotonic unless the path turns back at a fold
  ComplexMatrix eigenvalues;    ///< node x mode, NaN where a mode does not exist
  std::vector<PathStep> steps;  ///< between neighbouring nodes

  std::size_t n_nodes() const { return p.size(); }
  double lowest() const;   ///< of the traced range; not a number when there are no points
  double highest() const;  ///< likewise

  using Position = PathPosition;

  /// Where the path passes a parameter value, in the order of the trace; more than once behind a fold.
  std::vector<Position> positions(double parameter_value) const;

  /// Parameter at a place.
  double parameter_at(const Position& position) const;

  /// Eigenvalues of all modes at a place; NaN where a mode does not exist. A complex pair is reported by its
  /// member with Im s >= 0.
  ComplexVector eigenvalues_at(const Position& position) const;
};

/// Collects the points of a trace, as its observer.
class PathRecorder {
 public:
  PathRecorder() = default;
  /// Goes on with what was recorded before.
  explicit PathRecorder(const RecordedPath& path);

  int points() const { return static_cast<int>(p_.size()); }
  void append(const TracePoint& point);

  /// What was collected so far.
  RecordedPath path() const;

 private:
  std::vector<double> p_;
  std::vector<std::vector<Complex>> eigenvalues_;  ///< per node, by mode
  std::vector<PathStep> steps_;
  std::size_t n_modes_ = 0;
};

}  // namespace eigentrail
