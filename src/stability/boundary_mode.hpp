// The mode whose boundary is followed, at one place of the window, and the function g that vanishes on the
// boundary (boundary.hpp).
#pragma once

#include <optional>
#include <span>

#include "eigentrail/modes/spectrum.hpp"
#include "stability/window.hpp"

namespace eigentrail {

/// The function g of one kind of boundary.
struct BoundaryFunction {
  BoundaryKind kind = BoundaryKind::flutter;
  double damping_ratio = 0.0;  ///< the ratio asked for; used by kind damping_ratio only

  /// Power series of the functions of a block with this Lambda. Row 0: tau, row 1: delta; divergence: g;
  /// coalescence: tau and delta of the pair that two modes become, row 2: delta of both.
  ComplexMatrix functions(const std::vector<ComplexMatrix>& Lambda) const;
  /// Row of the functions that g depends on first.
  Eigen::Index row() const { return kind == BoundaryKind::coalescence ? 2 : 0; }
  /// Power series of g from those of the functions.
  Vector series(const ComplexMatrix& functions) const;

  /// Positive if a mode is unstable or less damped than asked: Re s + damping_ratio |s|, without a damping
  /// ratio Re s.
  double instability(Complex s) const { return s.real() + damping_ratio * std::abs(s); }

  /// A measure of the distance to the end of the curve from a point with these values of tau and delta,
  /// negative beyond it: flutter ends where the pair becomes real (-delta = 0), a damping ratio where tau
  /// changes its sign (-tau * damping_ratio = 0). Infinite for divergence.
  double distance_to_end(double tau, double delta) const;
};

/// The function whose zeros are the boundaries of a kind.
BoundaryFunction function_of(BoundaryKind kind, const BoundaryOptions& options);

/// The followed block (the mode and its conjugate, two modes without theirs, or the null vector of K) at a
/// place, predicted or computed.
struct BoundaryBlock {
  ComplexMatrix Z;       ///< n x k, physical coordinates; k = 2 for a pair or two modes, 1 for divergence
  ComplexMatrix Lambda;  ///< k x k, real but for two modes
  Vector left;           ///< n, physical: approximate left null vector of the stiffness; divergence only
};

/// A place and starting values for the equilibrium and the block there.
struct PlaceGuess {
  Place place;
  EquilibriumGuess equilibrium;
  BoundaryBlock block;
  Matrix basis;  ///< tangent basis of a neighbouring point
};

/// A place with the computed equilibrium and block.
struct Situation {
  Place place = {};
  PathPoint point = {};          ///< with the status; its invariant pairs are not computed
  ReducedPencil pencil = {};     ///< order 0: that of the point, or K - g b c' for divergence
  bool bordered = false;         ///< whether it is K - g b c'
  InvariantPair pair = {};       ///< of `pencil`, in reduced coordinates
  ComplexMatrix functions = {};  ///< of the block, order 0

  bool computed() const { return point.status == PointStatus::computed; }
};

/// A situation that was not computed, and why.
Situation failed_situation(PointStatus status, const std::string& message);

/// Solves the equilibrium and corrects the block at the place of a guess. A failure is reported in the
/// point's status.
Situation compute_situation(const Window& window, const BoundaryFunction& function, const PlaceGuess& guess,
                            RunCounts& counts);

/// The same situation as a guess for another place.
PlaceGuess as_guess(const Situation& situation, const Place& place);

/// Left null vector of K from the transposed bordered system; physical coordinates, unit norm in reduced
/// ones. Exact where g = 0. Empty if the situation is not bordered.
Vector left_vector(const Situation& situation);

/// Equilibrium, block and its functions as power series along a curve through a place.
struct SituationSeries {
  PathNode node;            ///< without the tracks of modes
  PairSeries mode;          ///< Z in physical coordinates
  ComplexMatrix functions;  ///< of the block
};

/// `places`: series of the curve in scaled coordinates, 2 x m with m <= order + 1; column 0 is the place
/// itself. Empty if a coefficient is not finite.
std::optional<SituationSeries> differentiate_situation(const Window& window, const Situation& situation,
                                                       const BoundaryFunction& function, const Matrix& places,
                                                       int order, RunCounts& counts);

/// Derivatives of the block's k functions with respect to the scaled P and Q: k x 2. Empty if one is not
/// finite.
std::optional<Matrix> function_gradients(const Window& window, const Situation& situation,
                                         const BoundaryFunction& function, RunCounts& counts);

/// Gradient of g with respect to the scaled P and Q, from the functions (order 0) and their gradients.
Place gradient(const BoundaryFunction& function, const ComplexMatrix& functions, const Matrix& gradients);

/// The block of the first mode, or the first two, at a reduced point. For divergence: the singular vectors of
/// the smallest singular value of K; `modes` is not used.
BoundaryBlock starting_block(BoundaryKind kind, const PathPoint& point, std::span<const StartingMode> modes);

}  // namespace eigentrail
