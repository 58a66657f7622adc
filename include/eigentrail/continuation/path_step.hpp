// The dense output of one step, as the loci file stores it and `eigentrail eval` evaluates it.
#pragma once

#include <vector>

#include "eigentrail/modes/invariant_pair.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {

class HermiteInterpolant;

/// A block on a step: its smooth functions (modes/invariants.hpp) as series at both ends, and the modes that
/// its eigenvalues belong to.
struct DenseBlock {
  Chart chart = Chart::finite;
  std::vector<int> modes;     ///< from 0; at most as many as the block has eigenvalues
  ComplexMatrix left, right;  ///< one row per function, order + 1 columns
  bool certified = false;     ///< evidence shows that the modes are the same at both ends

  Eigen::Index size() const { return block_size(left.rows()); }
};

/// A step between two neighbouring points.
struct PathStep {
  /// Signed length in the coordinate along the path: p itself, or the distance across a plane.
  double length = 0.0;
  Matrix parameter;  ///< 2 x (order + 1): series of p in that coordinate at both ends
  std::vector<DenseBlock> blocks;
  std::vector<Matrix> trimmed = {};  ///< the same as `parameter` of each trimmed parameter
};

/// Eigenvalues of a block at t = to in its chart, in the order of `roots`, its eigenvalues at t = from: each
/// one is followed in t from `from` to `to`. `length` is that of the step. `told_apart`, if given, is set to
/// whether any two that are distinct at both places could be distinguished everywhere between them.
ComplexVector follow_roots(const DenseBlock& block, double length, const ComplexVector& roots, double from,
                           double to, bool* told_apart = nullptr);

/// The same from the interpolant of the block's functions. The number of roots that were solved for is added
/// to `work`, if given.
ComplexVector follow_roots(const HermiteInterpolant& functions, const ComplexVector& roots, double from,
                           double to, bool* told_apart = nullptr, std::size_t* work = nullptr);

/// Eigenvalues s of all modes at t in [0, 1]; NaN for a mode that does not exist on the step. `at_left` and
/// `at_right` are the eigenvalues of all modes at the ends; they determine which eigenvalue of a block
/// belongs to which mode. A complex pair is represented by its member with Im s >= 0. The number
/// of roots of every block that was solved for is added to `work`, if given: in a damaged or malicious file
/// the roots of a block may change places so often that following them would take very long; the count
/// allows a limit.
ComplexVector step_eigenvalues(const PathStep& step, const ComplexVector& at_left,
                               const ComplexVector& at_right, double t, std::size_t* work = nullptr);

/// Whether the coordinate of the step is the traced parameter itself.
bool follows_parameter(const PathStep& step);

/// All t in [0, 1], ascending, at which the traced parameter has the value p; more than one near a fold.
std::vector<double> step_positions(const PathStep& step, double p);

/// The eigenvalue of a chart: s, or 1/s in the reciprocal chart, and back. 1/0 is (inf, 0), 1/inf is 0.
Complex chart_value(Complex s, Chart chart);

}  // namespace eigentrail
