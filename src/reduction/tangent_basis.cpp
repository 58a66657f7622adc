#include "eigentrail/reduction/tangent_basis.hpp"

#include <Eigen/Cholesky>
#include <random>
#include <utility>

#include "core/diagonal_blocks.hpp"
#include "core/orthonormal.hpp"
#include "core/products.hpp"
#include "core/sparse_factors.hpp"
#include "eigentrail/reduction/complex_blocks.hpp"

namespace eigentrail {
namespace {

/// Of the matrix of squared cosines between two tangent spaces; 0.03 is the square of cos 80 degrees.
constexpr double least_rcond = 0.03;

/// The orthonormal basis close to `previous`: P L^-T with P = (I - A+ A) previous and P^T P = L L^T. It
/// equals the basis of tangent_basis below (there W = Q2^T previous, and Q2 W = P) but does not need Q2.
/// Empty if the tangent space has turned too far. Blocks of P are orthonormalized apart.
std::optional<Matrix> turned_basis(const ConstraintFactorization& constraints, const Matrix& previous) {
  Matrix basis = constraints.allowed_part(previous);
  for (const DiagonalBlock& block : diagonal_blocks(MatrixSeries{basis})) {
    const Matrix P = basis(block.rows, block.columns);
    const Eigen::LLT<Matrix> cholesky(transposed_product(P, P));
    if (cholesky.info() != Eigen::Success || !(cholesky.rcond() > least_rcond)) return std::nullopt;
    const Matrix upper = cholesky.matrixU().solve(Matrix::Identity(P.cols(), P.cols()));
    basis(block.rows, block.columns) = product(P, upper);
  }
  return basis;
}

}  // namespace

ComplexMatrix TangentBasis::coordinates(const ComplexMatrix& V, int part) const {
  if (is_identity) return V;
  if (!parts) return transposed_product(T[0], V);
  if (parts->is_diagonal) return parts->inverse.diagonal().asDiagonal() * V;
  ComplexMatrix Z = product(Matrix(parts->coordinates(static_cast<std::size_t>(part))), V);
  const int complex_sign = parts->ranges[static_cast<std::size_t>(part)].complex_sign;
  if (complex_sign != 0) Z = from_complex_coordinates(complex_coordinates(Z, complex_sign), complex_sign);
  return Z;
}

ComplexMatrix TangentBasis::shapes(const ComplexMatrix& Z, int part, int copy) const {
  if (is_identity) return Z;
  if (copy > 0) {
    const auto& copies = parts->ranges[static_cast<std::size_t>(part)].copies;
    return product(copies[static_cast<std::size_t>(copy - 1)].right, Z);
  }
  if (parts && parts->is_diagonal) return parts->right.diagonal().asDiagonal() * Z;
  return product(parts ? Matrix(parts->columns(static_cast<std::size_t>(part))) : T[0], Z);
}

TangentBasis basis_of(std::shared_ptr<const IndependentParts> parts) {
  return {{parts->right}, false, parts};
}

int n_copies(const TangentBasis& basis, int part) {
  return basis.parts ? static_cast<int>(basis.parts->ranges[static_cast<std::size_t>(part)].copies.size())
                     : 0;
}

TangentBasis basis_with_copy(const TangentBasis& basis, int part, int copy) {
  auto parts = std::make_shared<IndependentParts>(*basis.parts);
  const IndependentParts::Range& range = parts->ranges[static_cast<std::size_t>(part)];
  const PartCopy& in_place = range.copies[static_cast<std::size_t>(copy - 1)];
  parts->right.middleCols(range.first, range.size) = in_place.right;
  parts->left.middleCols(range.first, range.size) = in_place.left;
  parts->inverse.middleRows(range.first, range.size) = in_place.inverse;
  return basis_of(std::move(parts));
}

TangentBasis tangent_basis(const ConstraintFactorization& constraints, const Matrix& previous) {
  if (constraints.is_sparse() && previous.cols() == previous.rows() - constraints.rank()) {
    if (auto turned = turned_basis(constraints, previous)) return {{std::move(*turned)}, false, {}};
  }
  const Matrix& Q2 = constraints.null_basis();
  if (constraints.rank() == 0) return {{Q2}, true, {}};
  if (previous.cols() != Q2.cols() || previous.rows() != Q2.rows()) return {{Q2}, false, {}};
  // On a short step W = Q2^T T_previous is nearly orthogonal, and W L^-T with W^T W = L L^T is an orthogonal
  // matrix close to it. If the tangent space turns by 90 degrees there is none, and the basis starts again
  // from Q2.
  const Matrix W = Q2.transpose() * previous;
  const Eigen::LLT<Matrix> cholesky(Matrix(W.transpose() * W));
  if (cholesky.info() != Eigen::Success || !(cholesky.rcond() > 1e-8)) return {{Q2}, false, {}};
  const Matrix rotation = cholesky.matrixL().solve(W.transpose()).transpose();
  return {{Q2 * rotation}, false, {}};
}

void randomize_basis(TangentBasis& basis, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  const Eigen::Index size = basis.T[0].cols();
  const Matrix gaussian = Matrix::NullaryExpr(size, size, [&] { return normal(engine); });
  const Matrix rotation = whole_Q(gaussian.householderQr());
  basis.T[0] = basis.T[0] * rotation;
  basis.is_identity = false;
}

namespace {

/// The columns of a basis that constraints do not couple, as those of different bodies.
std::vector<DiagonalBlock> independent_columns(const Matrix& T, const SystemSeries& A) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i < T.rows(); ++i) {
    for (Eigen::Index j = 0; j < T.cols(); ++j)
      if (T(i, j) != 0.0) entries.emplace_back(i, j, 1.0);
    for (const SystemMatrix& coefficient : A)
      coefficient.for_each_in_column(
          i, [&](Eigen::Index k, double) { entries.emplace_back(i, T.cols() + k, 1.0); });
  }
  SparseMatrix pattern(T.rows(), T.cols() + A[0].rows());
  pattern.setFromTriplets(entries.begin(), entries.end());
  std::vector<DiagonalBlock> blocks = diagonal_blocks(pattern);
  for (DiagonalBlock& block : blocks)
    std::erase_if(block.columns, [&](Eigen::Index j) { return j >= T.cols(); });
  return blocks;
}

/// Continues B_0, whose columns are tangent, to B_0 + B_1 h + ... with A(h) B(h) = 0.
void continue_within(const ConstraintFactorization& constraints, const SystemSeries& A, int order,
                     MatrixSeries& B) {
  const std::vector<DiagonalBlock> blocks = independent_columns(B[0], A);
  MatrixSeries together{packed(B[0], blocks)};
  for (int k = 1; k <= order; ++k) {
    Matrix sum = Matrix::Zero(A[0].rows(), together[0].cols());
    for (int j = 1; j <= k && j < static_cast<int>(A.size()); ++j) A[j].add_product_to(sum, together[k - j]);
    together.push_back(-constraints.pseudo_inverse_times(sum));
    B.push_back(unpacked(together.back(), blocks, B[0].cols()));
  }
}

}  // namespace

void differentiate_basis(const ConstraintFactorization& constraints, const SystemSeries& A, int order,
                         TangentBasis& basis) {
  basis.T.resize(1);
  basis.left.clear();
  if (A.size() == 1 || constraints.rank() == 0) return;
  continue_within(constraints, A, order, basis.T);
  if (!basis.parts) return;
  basis.left = {basis.parts->left};
  continue_within(constraints, A, order, basis.left);
}

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
