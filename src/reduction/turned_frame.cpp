#include <Eigen/Eigenvalues>

#include "core/diagonal_blocks.hpp"
#include "core/products.hpp"
#include "eigentrail/reduction/independent_parts.hpp"

namespace eigentrail {
namespace {

/// The least squared cosine between the tangent space and the frame: that of 80 degrees. Closer to a right
/// angle rounding would be magnified by more than six, and a motion of the frame could have no counterpart.
constexpr double least_cosine_squared = 0.03;

/// Entries of a projected orthonormal basis up to which they are rounding. Without them what the constraints
/// keep apart stays apart, and blocks of it are orthonormalized each by itself.
constexpr double negligible_entry = 1e-13;

}  // namespace

std::optional<Matrix> turned_frame(const ConstraintFactorization& constraints, const Matrix& frame) {
  if (constraints.rank() + frame.cols() != frame.rows()) return std::nullopt;
  Matrix T = constraints.allowed_part(frame);
  T = (T.array().abs() > negligible_entry).select(T, 0.0).eval();
  for (const DiagonalBlock& block : diagonal_blocks(MatrixSeries{T})) {
    const Matrix P = T(block.rows, block.columns);
    const Eigen::SelfAdjointEigenSolver<Matrix> gram(transposed_product(P, P));
    if (gram.info() != Eigen::Success || !(gram.eigenvalues()[0] > least_cosine_squared)) return std::nullopt;
    T(block.rows, block.columns) = product(P, Matrix(gram.operatorInverseSqrt()));
  }
  return T;
}

std::shared_ptr<const IndependentParts> turned(const std::shared_ptr<const IndependentParts>& parts,
                                               const ConstraintFactorization& constraints) {
  if (parts->frame.size() == 0) return parts;
  std::optional<Matrix> T = turned_frame(constraints, parts->frame);
  if (!T) return nullptr;
  auto there = std::make_shared<IndependentParts>(*parts);
  const auto turn = [&](Matrix& right, Matrix& left, Matrix& inverse) {
    right = *T * (parts->frame.transpose() * right);
    left = *T * (parts->frame.transpose() * left);
    inverse = (inverse * parts->frame) * T->transpose();
  };
  turn(there->right, there->left, there->inverse);
  for (IndependentParts::Range& range : there->ranges) {
    for (PartCopy& copy : range.copies) turn(copy.right, copy.left, copy.inverse);
  }
  there->frame = std::move(*T);
  return there;
}

}  // namespace eigentrail
