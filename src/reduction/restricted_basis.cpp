#include "eigentrail/reduction/restricted_basis.hpp"

#include <Eigen/Cholesky>
#include <utility>

#include "core/products.hpp"
#include "core/sparse_factors.hpp"

namespace eigentrail {
namespace {

/// Largest squared length of a lifted motion, 1 + tan^2 of the angle by which it has turned: that of 89
/// degrees.
constexpr double longest_lifted = 3e3;

bool is_same(const SparseMatrix& A, const SparseMatrix& B) {
  return A.rows() == B.rows() && A.cols() == B.cols() && (A - B).norm() == 0.0;
}

/// u - B^T (A B^T)^-1 A u for the columns u; empty if A B^T is singular.
std::optional<Matrix> lifted(const Motions& motions, const SparseMatrix& A) {
  const Vector scale = SystemMatrix(A).row_norms().cwiseInverse();
  const SparseMatrix S = scale.asDiagonal() * A;
  const SparseMatrix Bt = SparseMatrix(motions.constraints.transpose()) * scale.asDiagonal();
  SparseMatrix product = S * Bt;
  product.makeCompressed();
  SparseFactors factors;
  if (!factors.factor(product, SparseKind::general)) return std::nullopt;
  Matrix lifted = motions.basis;
  // The second pass removes the rounding of the first one.
  for (int pass = 0; pass < 2; ++pass) lifted -= Bt * factors.solve(Matrix(S * lifted));
  if (!lifted.allFinite()) return std::nullopt;
  return lifted;
}

}  // namespace

std::optional<TangentBasis> restricted_basis(const Motions& motions, const SystemMatrix& A,
                                             const ConstraintFactorization& constraints) {
  if (A.rows() == 0 || is_same(A.sparse(), motions.constraints))
    return TangentBasis{{motions.basis}, false, {}};
  const std::optional<Matrix> turned = lifted(motions, A.sparse());
  if (!turned) return std::nullopt;
  const Matrix P = constraints.allowed_part(*turned);
  // I + X^T X, X the parts that were not allowed at the reference.
  const Matrix gram = transposed_product(P, P);
  const Eigen::LLT<Matrix> cholesky(gram);
  if (cholesky.info() != Eigen::Success || !(gram.diagonal().maxCoeff() < longest_lifted))
    return std::nullopt;
  const Matrix upper = cholesky.matrixU().solve(Matrix::Identity(P.cols(), P.cols()));
  return TangentBasis{{product(P, upper)}, false, {}};
}

}  // namespace eigentrail
