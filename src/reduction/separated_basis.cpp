#include "reduction/separated_basis.hpp"

#include <Eigen/QR>
#include <cmath>

#include "core/diagonal_blocks.hpp"
#include "core/orthonormal.hpp"

namespace eigentrail {
namespace {

/// Entries of the projection onto the tangent space, whose norm is one, up to which they are rounding.
constexpr double negligible = 1e-13;

}  // namespace

Matrix separated_basis(const ConstraintFactorization& constraints) {
  const Matrix& Q2 = constraints.null_basis();
  const Matrix all = Q2 * Q2.transpose();
  const Matrix P = (all.array().abs() > negligible).select(all, 0.0);
  Matrix basis = Matrix::Zero(Q2.rows(), Q2.cols());
  Eigen::Index first = 0;
  for (const DiagonalBlock& block : diagonal_blocks(MatrixSeries{P})) {
    if (block.rows.empty()) continue;  // a coordinate that cannot move
    const Matrix own = P(block.rows, block.columns);
    const auto rank = static_cast<Eigen::Index>(std::lround(own.trace()));
    if (first + rank > Q2.cols()) return Q2;
    const Matrix Q = whole_Q(own.colPivHouseholderQr());
    basis(block.rows, Eigen::seqN(first, rank)) = Q.leftCols(rank);
    first += rank;
  }
  return first == Q2.cols() ? basis : Q2;  // Q2 where rounding leaves the ranks in doubt
}

}  // namespace eigentrail
