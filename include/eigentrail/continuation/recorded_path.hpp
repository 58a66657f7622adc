// The dense output of a whole trace: its points and the steps between them.
#pragma once

#include <vector>

#include "eigentrail/continuation/path_step.hpp"
#include "eigentrail/continuation/trace.hpp"

namespace eigentrail {

/// A place on the path: t in [0, 1] on the step from node `step` to node `step` + 1. Ordered along the trace.
struct PathPosition {
  std::size_t step = 0;
  double t = 0.0;
  auto operator<=>(const PathPosition&) const = default;

  /// The place counted in steps from the first node.
  double in_steps() const { return static_cast<double>(step) + t; }
};

/// The points and steps of a trace.
struct RecordedPath {
  std::vector<double> p;        ///< per node; monotonic unless the path turns back at a fold
  ComplexMatrix eigenvalues;    ///< s, one row per node, one column per mode; NaN where a mode does not exist
  std::vector<PathStep> steps;  ///< between neighbouring nodes
  /// Errors of `eigenvalues` by rounding of the entries of the matrices, 1/s; empty if they are not known.
  Matrix rounding = {};
  /// Per node: number of growing modes that are not followed; -1 where it is not known. Empty: nowhere.
  std::vector<int> growing_unfollowed = {};

  std::size_t n_nodes() const { return p.size(); }
  /// The place of a node: where a step begins, of the last one where the last step ends.
  PathPosition at_node(std::size_t node) const {
    return node > 0 && node == steps.size() ? PathPosition{node - 1, 1.0} : PathPosition{node, 0.0};
  }
  /// The error of an eigenvalue at a node by rounding, 1/s; zero if it is not known.
  double rounding_at(std::size_t node, int mode) const;
  double lowest() const;   ///< least parameter value of all nodes; NaN without nodes
  double highest() const;  ///< largest parameter value of all nodes; NaN without nodes

  using Position = PathPosition;

  /// All places with that parameter value, in the order of the trace; several if the path has folds.
  std::vector<Position> positions(double parameter_value) const;

  /// The place that is so many steps from the first node.
  Position position_at(double in_steps) const;

  /// The block of a mode on a step; null where the mode does not exist.
  const DenseBlock* block_of(std::size_t step, int mode) const;

  /// Value of the traced parameter at a place.
  double parameter_at(const Position& position) const;

  /// Values of the trimmed parameters at a place, in their units.
  Vector trimmed_at(const Position& position) const;

  /// Eigenvalues s of all modes at a place; NaN where a mode does not exist. A complex pair is represented by
  /// its member with Im s >= 0.
  ComplexVector eigenvalues_at(const Position& position) const;

  /// The error of an eigenvalue by rounding at a place, 1/s; between two nodes the smaller one of theirs.
  double rounding_at(const Position& position, int mode) const;

  /// The eigenvalues as they are shown: zero where they, or their real parts, are below that error.
  ComplexVector shown_at(const Position& position) const;
};

/// Collects the points that a trace hands to its observer.
class PathRecorder {
 public:
  PathRecorder() = default;
  /// Starts with the points and steps of `path`, for a trace that is resumed.
  explicit PathRecorder(const RecordedPath& path);

  int points() const { return static_cast<int>(path_.n_nodes()); }
  void append(const TracePoint& point);

  /// All points and steps so far.
  RecordedPath path() const;

 private:
  RecordedPath path_;                       ///< all but the matrices
  std::vector<ComplexVector> eigenvalues_;  ///< per node, by mode
  std::vector<Vector> rounding_;
  Eigen::Index n_modes_ = 0;
};

}  // namespace eigentrail
