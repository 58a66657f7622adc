// The mode whose boundary is followed, at one place of the window, and the function g that vanishes on it.
#pragma once

#include <optional>

#include "eigentrail/modes/spectrum.hpp"
#include "stability/window.hpp"

namespace eigentrail {

/// What is followed.
struct BoundaryFunction {
  BoundaryKind kind = BoundaryKind::flutter;
  double damping_ratio = 0.0;  ///< of kind damping_ratio

  /// g from the series of a block's functions; real.
  Vector series(const ComplexMatrix& functions) const;

  /// Whether the curve ends at or before a point with these values of tau and delta: a pair has become real.
  bool passed_end(double tau, double delta) const;

  /// The distance to that end, negative beyond it.
  double distance_to_end(double tau, double delta) const;
};

/// The followed block at a place, as it is expected or as it is.
struct BoundaryBlock {
  ComplexMatrix Z;       ///< n x k, physical coordinates; k = 2 for a pair, 1 for divergence
  ComplexMatrix Lambda;  ///< k x k, real
  Vector left;           ///< n, physical: left null vector of the stiffness, about; divergence only
};

/// Where a point is looked for.
struct PlaceGuess {
  Place place;
  EquilibriumGuess equilibrium;
  BoundaryBlock block;
  Matrix basis;  ///< tangent basis of a neighbouring point
};

/// A place with the equilibrium and the mode there.
struct Situation {
  PointStatus status = PointStatus::computed;
  std::string message;  ///< reason when not computed
  Place place;
  PathPoint point;          ///< without pairs
  ReducedPencil pencil;     ///< order 0: that of the point, or for divergence -g b c' + K
  bool bordered = false;    ///< the latter
  InvariantPair pair;       ///< of `pencil`, in reduced coordinates
  ComplexMatrix functions;  ///< of the block, order 0
};

Situation compute_situation(const Window& window, const BoundaryFunction& function, const PlaceGuess& guess,
                            RunCounts& counts);

/// The same situation as a guess for another place.
PlaceGuess as_guess(const Situation& situation, const Place& place);

/// Left null vector of the stiffness, bordered as the pencil of the situation; physical coordinates. Empty
/// when it is not bordered.
Vector left_vector(const Situation& situation);

/// Everything at a place as series along a curve through it.
struct SituationSeries {
  PathNode node;            ///< without tracks
  PairSeries mode;          ///< Z in physical coordinates
  ComplexMatrix functions;  ///< of the block
};

/// `places` (2 x <= order + 1) is the curve, scaled; column 0 the place itself. Empty when a coefficient is
/// not finite.
std::optional<SituationSeries> differentiate_situation(const Window& window, const Situation& situation,
                                                       const Matrix& places, int order, RunCounts& counts);

/// Derivatives of the block's functions along P and Q: k x 2.
std::optional<Matrix> function_gradients(const Window& window, const Situation& situation, RunCounts& counts);

/// Gradient of g at a place with these functions (order 0) and their gradients.
Place gradient(const BoundaryFunction& function, const ComplexMatrix& functions, const Matrix& gradients);

/// The block of a mode of a spectrum at a reduced point; of kind divergence: of the smallest singular value
/// of the stiffness.
BoundaryBlock starting_block(BoundaryKind kind, const PathPoint& point, const StartingMode& mode);

}  // namespace eigentrail
