// Prediction of a point of the path, and the computed point before it is differentiated.
#pragma once

#include <functional>
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

/// A single mode, extrapolated from the dense output of the last step to the next point.
struct ContinuedMode {
  InvariantPair pair;  ///< Z in physical coordinates
  PairSeries series;   ///< the same
};

/// Prediction of the next point.
struct Prediction {
  double p = 0.0;
  EquilibriumGuess equilibrium;
  std::vector<InvariantPair> pairs;  ///< Z in physical coordinates
  /// A second prediction per pair, which may be accurate enough to be accepted without correction; empty if
  /// there is none.
  std::vector<std::optional<ContinuedMode>> continued = {};
  /// Whether the second prediction of the pair with that index may be accepted without correction. Called,
  /// possibly by several threads at once, only if it is accurate enough.
  std::function<bool(const ContinuedMode&, std::size_t)> may_pass = {};
  /// Per pair the track from an earlier computation of the same point, or null; empty if there is none.
  std::vector<const Track*> ready = {};
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
  std::shared_ptr<const AllPairs> all;                 ///< set if the state-space route corrected the pairs
  std::shared_ptr<const SymmetricPairs> symmetric;     ///< set if the symmetric route corrected them
  std::vector<std::optional<PairSeries>> passed = {};  ///< series of pairs accepted without correction
  std::vector<const Track*> ready = {};                ///< as in Prediction

  /// V = T Z of a pair.
  ComplexMatrix shapes(std::size_t pair) const;
};

}  // namespace eigentrail
