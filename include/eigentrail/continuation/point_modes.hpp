// Prediction of a point of the path, the computed point before it is differentiated, and correction and
// differentiation of its modes, one by one or all at once.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "eigentrail/continuation/path_node.hpp"

namespace eigentrail {

struct SymmetricPairs;

/// Initial guess of an equilibrium.
struct EquilibriumGuess {
  Vector x;
  Vector lambda;        ///< empty: the least-squares multipliers at x
  bool solved = false;  ///< true: from an equilibrium or its series nearby; false: the scene's own guess
};

/// Prediction of the next point.
struct Prediction {
  double p = 0.0;
  EquilibriumGuess equilibrium;
  std::vector<InvariantPair> pairs;     ///< Z in physical coordinates
  std::optional<PathPlane> plane = {};  ///< the plane that the point lies on, if p is an unknown
  std::optional<Path> known = {};       ///< series of the equilibrium, where it cannot be solved for
};

enum class PointStatus { computed, no_equilibrium, mode_lost };

/// A point whose modes are corrected but not yet differentiated.
struct PathPoint {
  PointStatus status = PointStatus::computed;
  std::string message;  ///< reason when not computed
  int lost_track = -1;  ///< index of the pair whose correction did not converge
  double p = 0.0;
  std::optional<PathPlane> plane;
  std::optional<Path> known;  ///< as in Prediction
  Equilibrium equilibrium;
  TangentBasis basis;
  ReducedPencil pencil;  ///< of order 0
  std::vector<InvariantPair> pairs;
  std::shared_ptr<const AllPairs> all;              ///< set if the state-space route corrected the pairs
  std::shared_ptr<const SymmetricPairs> symmetric;  ///< set if the symmetric route corrected them

  /// V = T Z of a pair.
  ComplexMatrix shapes(std::size_t pair) const;
};

/// Whether the work on that many modes of a pencil of size n pays for the start of several threads.
bool is_worth_sharing(std::size_t modes, Eigen::Index n);

/// Corrects the predicted pairs at a reduced point. Sets the point's pairs, or its status if a pair does not
/// converge.
void correct_modes(const PathProblem& problem, const Prediction& prediction, PathPoint& point,
                   RunCounts& counts);

/// Tracks with the series of all pairs of a point, computed by the route that corrected them. `node` holds
/// the series of basis and pencil.
std::vector<Track> tracks_of(const PathProblem& problem, const PathPoint& point, const PathNode& node,
                             RunCounts& counts);

/// Track with the series of one corrected pair at a point whose pencil is already differentiated.
Track differentiate_track(const PathProblem& problem, const PathNode& node, InvariantPair pair,
                          RunCounts& counts);

}  // namespace eigentrail
