#include "continuation/idle_freedom.hpp"

#include <Eigen/SVD>

#include "core/positive_or_one.hpp"

namespace eigentrail {
namespace {

constexpr double idle = 1e-12;  ///< share of the largest entry below which a matrix leaves a freedom out

}  // namespace

std::string idle_coordinate(const Model& model, const PathPoint& point) {
  const Eigen::Index n = point.pencil.size();
  Matrix all(3 * n, n);
  all << point.pencil.M[0], point.pencil.C[0], point.pencil.K[0];
  for (Eigen::Index i = 0; i < 3; ++i) {
    all.middleRows(i * n, n) /= positive_or_one(all.middleRows(i * n, n).cwiseAbs().maxCoeff());
  }
  const Eigen::JacobiSVD<Matrix> svd(all, Eigen::ComputeThinV);
  if (svd.singularValues()[n - 1] > idle) return {};
  const Vector v = svd.matrixV().col(n - 1);
  const Vector motion = point.basis.is_identity ? v : Vector(point.basis.T[0] * v);
  Eigen::Index most = 0;
  motion.cwiseAbs().maxCoeff(&most);
  return model.description().coordinate_names[static_cast<std::size_t>(most)];
}

}  // namespace eigentrail
