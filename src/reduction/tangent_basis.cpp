#include "eigentrail/reduction/tangent_basis.hpp"

#include <Eigen/Cholesky>
#include <random>

namespace eigentrail {

TangentBasis tangent_basis(const ConstraintFactorization& constraints, const Matrix& previous) {
  const Matrix& Q2 = constraints.null_basis();
  if (constraints.rank() == 0) return {{Q2}, true};
  if (previous.cols() != Q2.cols() || previous.rows() != Q2.rows()) return {{Q2}, false};
  // W = Q2^T T_previous is close to orthogonal on a short step; W L^-T with W^T W = L L^T is the nearby
  // orthogonal matrix. A step that turns the tangent space by 90 degrees has no nearby one and starts afresh.
  const Matrix W = Q2.transpose() * previous;
  const Eigen::LLT<Matrix> cholesky(W.transpose() * W);
  if (cholesky.info() != Eigen::Success || !(cholesky.rcond() > 1e-8)) return {{Q2}, false};
  const Matrix rotation = cholesky.matrixL().solve(W.transpose()).transpose();
  return {{Q2 * rotation}, false};
}

void randomize_basis(TangentBasis& basis, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  const Eigen::Index size = basis.T[0].cols();
  const Matrix gaussian = Matrix::NullaryExpr(size, size, [&] { return normal(engine); });
  const Matrix rotation = gaussian.householderQr().householderQ();
  basis.T[0] = basis.T[0] * rotation;
  basis.is_identity = false;
}

void differentiate_basis(const ConstraintFactorization& constraints, const MatrixSeries& A, int order,
                         TangentBasis& basis) {
  basis.T.resize(1);
  if (A.size() == 1 || constraints.rank() == 0) return;
  for (int k = 1; k <= order; ++k) {
    Matrix sum = Matrix::Zero(A[0].rows(), basis.T[0].cols());
    for (int j = 1; j <= k && j < static_cast<int>(A.size()); ++j) sum += A[j] * basis.T[k - j];
    basis.T.push_back(-constraints.pseudo_inverse_times(sum));
  }
}

}  // namespace eigentrail
