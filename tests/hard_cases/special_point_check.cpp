#include "hard_cases/special_point_check.hpp"

#include <Eigen/SVD>

namespace eigentrail::test {

Singularity::Singularity(const WidePencil& pencil, WideComplex s, double scale) {
  const Eigen::Index n = pencil.M.rows();
  const Wide size = std::abs(s) > 0 ? std::abs(s) : Wide(scale);
  const WideMatrix steep = 2 * size * pencil.M.cwiseAbs() + pencil.C.cwiseAbs();
  const WideMatrix whole =
      size * size * pencil.M.cwiseAbs() + size * pencil.C.cwiseAbs() + pencil.K.cwiseAbs();
  Eigen::Matrix<Wide, Eigen::Dynamic, 1> size_of = whole.diagonal();
  for (Eigen::Index i = 0; i < n; ++i) {
    if (size_of[i] == 0) size_of[i] = whole.row(i).maxCoeff();
  }
  const WideComplexMatrix D = size_of.cwiseSqrt().cwiseInverse().cast<WideComplex>().asDiagonal();
  const Eigen::JacobiSVD<WideComplexMatrix> svd(D * pencil.at(s) * D,
                                                Eigen::ComputeFullU | Eigen::ComputeFullV);
  for (Eigen::Index i = n; i-- > 0;) values.push_back(static_cast<double>(svd.singularValues()[i]));
  const auto y = svd.matrixU().col(n - 1);
  const auto z = svd.matrixV().col(n - 1);
  slope = static_cast<double>(std::abs(y.dot(D * pencil.slope(s) * D * z)) /
                              (D.real() * steep * D.real()).norm());
}

}  // namespace eigentrail::test
