// The dense output of one step: what the file stores and `eval` evaluates.
#pragma once

#include <vector>

#include "eigentrail/modes/invariant_pair.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {

class HermiteInterpolant;

/// A block on a step: its smooth functions as series at both ends, and the modes its eigenvalues belong to.
struct DenseBlock {
  Chart chart = Chart::finite;
  std::vector<int> modes;     ///< from 0; at most as many as the block has eigenvalues
  ComplexMatrix left, right;  ///< k x (order + 1)
  bool certified = false;     ///< the modes are known to be the same at both ends

  Eigen::Index size() const { return block_size(left.rows()); }
};

struct PathStep {
  double length =
      0.0;           ///< signed, in the path's coordinate; that is p itself unless `parameter` says otherwise
  Matrix parameter;  ///< 2 x (order + 1): series of p at both ends
  std::vector<DenseBlock> blocks;
};

/// Eigenvalues of a block in its chart, followed from one end of a step (t = from) to t = to: `roots` at
/// `from` give the order. `left`, `right` as in DenseBlock. `told_apart`, when given, says whether any two
/// that are distinct at both ends were told apart all the way.
ComplexVector follow_roots(const DenseBlock& block, double length, const ComplexVector& roots, double from,
                           double to, bool* told_apart = nullptr);

/// The same with the block's functions on the step at hand.
ComplexVector follow_roots(const HermiteInterpolant& functions, const ComplexVector& roots, double from,
                           double to, bool* told_apart = nullptr);

/// Eigenvalues of all modes at t in [0, 1]; NaN where a mode does not exist on the step. `at_left` and
/// `at_right` are the eigenvalues of all modes at the ends; they tell which eigenvalue of a block is which
/// mode. Complex pairs are reported by the member with Im s >= 0.
ComplexVector step_eigenvalues(const PathStep& step, const ComplexVector& at_left,
                               const ComplexVector& at_right, double t);

/// Whether the coordinate of the step is the parameter itself.
bool follows_parameter(const PathStep& step);

/// The values of t in [0, 1] where the step passes the parameter value p; more than one near a fold.
std::vector<double> step_positions(const PathStep& step, double p);

/// s or 1/s; the point at infinity is (inf, 0).
Complex chart_value(Complex s, Chart chart);

}  // namespace eigentrail
