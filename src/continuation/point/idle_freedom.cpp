#include "continuation/point/idle_freedom.hpp"

#include <Eigen/QR>

#include "core/positive_or_one.hpp"

namespace eigentrail {
namespace {

constexpr double idle = 1e-12;  ///< share of the largest entry below which a matrix leaves a freedom out

}  // namespace

std::string idle_coordinate(const Model& model, const PathPoint& point) {
  const Eigen::Index n = point.pencil.size();
  if (n == 0) return {};
  Matrix all(3 * n, n);
  all << point.pencil.M[0], point.pencil.C[0], point.pencil.K[0];
  for (Eigen::Index i = 0; i < 3; ++i) {
    all.middleRows(i * n, n) /= positive_or_one(all.middleRows(i * n, n).cwiseAbs().maxCoeff());
  }
  Eigen::ColPivHouseholderQR<Matrix> qr(all);
  qr.setThreshold(idle);
  const Eigen::Index rank = qr.rank();
  if (rank == n) return {};
  // R11 v1 = -R12 e1: a vector that all three matrices take to zero.
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
