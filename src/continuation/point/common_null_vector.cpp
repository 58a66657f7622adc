#include "continuation/point/common_null_vector.hpp"

#include <Eigen/QR>

#include "core/positive_or_one.hpp"

namespace eigentrail {
namespace {

/// Relative size of a pivot of [M; C; K], each scaled to a largest entry of one, below which it counts as
/// zero: rounding of the entries with a margin. With a larger value very light or soft freedoms are reported,
/// with a smaller one rounding hides a common null vector.
constexpr double zero_pivot = 1e-12;

}  // namespace

std::string null_vector_coordinate(const Model& model, const PathPoint& point) {
  const Eigen::Index n = point.pencil.size();
  if (n == 0) return {};
  Matrix all(3 * n, n);
  all << point.pencil.M[0], point.pencil.C[0], point.pencil.K[0];
  for (Eigen::Index i = 0; i < 3; ++i) {
    all.middleRows(i * n, n) /= positive_or_one(all.middleRows(i * n, n).cwiseAbs().maxCoeff());
  }
  Eigen::ColPivHouseholderQR<Matrix> qr(all);
  qr.setThreshold(zero_pivot);
  const Eigen::Index rank = qr.rank();
  if (rank == n) return {};
  // With the pivots of R11 nonzero and R22 = 0, R11 v1 = -R12 e1 gives a vector v = (v1, e1) with M v = C v =
  // K v = 0.
  Vector permuted = Vector::Zero(n);
  permuted[rank] = 1.0;
  const auto R = qr.matrixR();
  permuted.head(rank) =
      -R.topLeftCorner(rank, rank).triangularView<Eigen::Upper>().solve(R.col(rank).head(rank));
  const Vector v = qr.colsPermutation() * permuted;
  const Vector motion = point.basis.is_identity ? v : Vector(point.basis.T[0] * v);
  Eigen::Index most = 0;
  motion.cwiseAbs().maxCoeff(&most);
  return model.description().coordinate_names[static_cast<std::size_t>(most)];
}

}  // namespace eigentrail
