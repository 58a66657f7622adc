// A chain of springs with constraints, for tests of the solvers of its equilibrium.
#pragma once

#include <Eigen/Eigenvalues>

#include <random>

#include "eigentrail/steady/kkt_factorization.hpp"

namespace eigentrail::test {

/// Springs between neighbours, with forces that circulate; constraints on three neighbouring coordinates
/// each.
struct ConstrainedChain {
  static constexpr int n = 60, m = 25;
  Matrix K = Matrix::Zero(n, n), A = Matrix::Zero(m, n);

  ConstrainedChain(std::mt19937_64& engine, double circulating) {
    std::uniform_real_distribution<double> number(0.5, 1.5);
    for (int i = 0; i < n; ++i) {
      K(i, i) += number(engine);
      if (i == 0) continue;
      const double k = number(engine);
      K(i, i) += k;
      K(i - 1, i - 1) += k;
      K(i, i - 1) -= k + circulating;
      K(i - 1, i) -= k - circulating;
    }
    for (int row = 0; row < m; ++row) {
      for (int i = 0; i < 3; ++i) A(row, 2 * row + i) = number(engine) * (i == 1 ? -1.0 : 1.0);
    }
  }

  /// Least stiffness in the motions that the constraints allow, of a symmetric K, and its motion.
  std::pair<double, Vector> least() const {
    const Matrix Q2 = ConstraintFactorization(A).null_basis();
    const Eigen::SelfAdjointEigenSolver<Matrix> solver(Matrix(Q2.transpose() * K * Q2));
    return {solver.eigenvalues()[0], Q2 * solver.eigenvectors().col(0)};
  }
};

}  // namespace eigentrail::test
