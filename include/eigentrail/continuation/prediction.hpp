// Where a point of the path is expected, and the point before its modes are differentiated.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "eigentrail/continuation/path_node.hpp"

namespace eigentrail {

struct SymmetricPairs;

/// Where an equilibrium is looked for.
struct EquilibriumGuess {
  Vector x;
  Vector lambda;        ///< empty: the least-squares multipliers at x
  bool solved = false;  ///< an equilibrium of a neighbouring point, or its series; not the scene's own guess
};

/// A single mode as the dense output of the last step goes on, at the next point.
struct ContinuedMode {
  InvariantPair pair;  ///< Z in physical coordinates
  PairSeries series;   ///< the same
};

/// Where the next point is expected.
struct Prediction {
  double p = 0.0;
  EquilibriumGuess equilibrium;
  std::vector<InvariantPair> pairs;  ///< Z in physical coordinates
  /// Per pair another prediction, which may be good enough to stand; empty where there is none.
  std::vector<std::optional<ContinuedMode>> continued = {};
  /// Whether the one of that pair may stand; asked, by several threads at once, where it is accurate enough.
  std::function<bool(const ContinuedMode&, std::size_t)> may_pass = {};
  /// Per pair its track where the same point was computed before, or null; empty where there is none.
  std::vector<const Track*> ready = {};
  std::optional<PathPlane> plane = {};  ///< where p is not given but found: the plane that the point lies on
  std::optional<Path> known = {};       ///< the equilibrium's series, where it cannot be solved for
};

enum class PointStatus { computed, no_equilibrium, mode_lost };

/// A point whose modes are corrected but not yet differentiated.
struct PathPoint {
  PointStatus status = PointStatus::computed;
  std::string message;  ///< reason when not computed
  int lost_track = -1;  ///< the track that was not corrected
  double p = 0.0;
  std::optional<PathPlane> plane;
  std::optional<Path> known;  ///< as in Prediction
  Equilibrium equilibrium;
  TangentBasis basis;
  ReducedPencil pencil;  ///< of order 0
  std::vector<InvariantPair> pairs;
  std::shared_ptr<const AllPairs> all;                 ///< where the pairs were corrected in state space
  std::shared_ptr<const SymmetricPairs> symmetric;     ///< where they were corrected by the symmetric route
  std::vector<std::optional<PairSeries>> passed = {};  ///< of pairs that stand as they were continued
  std::vector<const Track*> ready = {};                ///< as in Prediction

  /// V = T Z of a pair.
  ComplexMatrix shapes(std::size_t pair) const;
};

}  // namespace eigentrail
