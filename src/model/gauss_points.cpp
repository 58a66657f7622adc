#include "model/gauss_points.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace eigentrail {

std::vector<std::array<double, 2>> gauss_points(int n) {
  Eigen::MatrixXd jacobi = Eigen::MatrixXd::Zero(n, n);
  for (int k = 1; k < n; ++k) jacobi(k, k - 1) = jacobi(k - 1, k) = k / std::sqrt(4.0 * k * k - 1.0);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(jacobi);
  std::vector<std::array<double, 2>> points;
  for (int k = 0; k < n; ++k) {
    const double first = solver.eigenvectors()(0, k);
    points.push_back({0.5 * (1.0 + solver.eigenvalues()[k]), first * first});
  }
  return points;
}

}  // namespace eigentrail
