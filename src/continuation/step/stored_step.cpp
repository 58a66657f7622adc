#include "continuation/step/stored_step.hpp"

#include "continuation/step/shared_basis.hpp"
#include "continuation/tracks/eigenvalue_branches.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

/// Largest distance, relative to the largest eigenvalue of the block, at which two eigenvalues count as
/// equal: the square root of rounding, the accuracy in a defective block. With a larger value a block may be
/// marked certified although the stored output exchanges close modes, with a smaller one rounding prevents
/// the mark.
constexpr double same = 1e-8;

/// Whether the modes followed on the stored dense output from one end arrive at the modes of the other end,
/// in both directions. The trace has ordered the modes with one more coefficient of the series. If the
/// tolerance is wider than a veering, the stored output may exchange its modes.
bool keeps_order(const DenseBlock& block, double h, const Track& left, const Track& right) {
  if (left.size() == 1 || right.departure) return true;
  double from = 0.0;
  const ComplexVector start = departing_roots(left, h, from);
  const auto leads = [&](const ComplexVector& a, double at_a, const ComplexVector& b, double at_b) {
    const ComplexVector found = in_order_of(follow_roots(block, h, a, at_a, at_b), b);
    return (found - b).cwiseAbs().maxCoeff() <= same * b.cwiseAbs().maxCoeff();
  };
  return leads(start, from, right.roots, 1.0) && leads(right.roots, 1.0, start, from);
}

/// The series of a row at both ends of a step.
Matrix ends(const VectorSeries& left, const VectorSeries& right, Eigen::Index row, Eigen::Index count) {
  Matrix result(2, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    result(0, k) = coefficient(left, row, k);
    result(1, k) = coefficient(right, row, k);
  }
  return result;
}

}  // namespace

PathStep stored_step(const PathProblem& problem, const Step& step, const std::vector<bool>& certified) {
  PathStep stored;
  stored.length = step.h;
  const Eigen::Index count = problem.order + 1;
  stored.parameter = ends(step.left->path.parameters, step.right.path.parameters, problem.traced, count);
  for (Eigen::Index i = problem.model.n_constraints(); i < problem.model.n_multipliers(); ++i)
    stored.trimmed.push_back(ends(step.left->path.lambda, step.right.path.lambda, i, count));
  for (std::size_t i = 0; i < step.right.tracks.size(); ++i) {
    const Track& left = step.left->tracks[i];
    const Track& right = step.right.tracks[i];
    DenseBlock block = block_on_step(*step.left, step.right, i);
    block.left = block.left.leftCols(count).eval();
    block.right = block.right.leftCols(count).eval();
    block.certified =
        i < certified.size() && certified[i] && right.told_apart && keeps_order(block, step.h, left, right);
    for (const int mode : left.modes) {
      if (mode >= 0) block.modes.push_back(mode);
    }
    stored.blocks.push_back(std::move(block));
  }
  return stored;
}

}  // namespace eigentrail
