#include "accuracy/eigen_triples.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/lapack.hpp"

namespace eigentrail {
namespace {

/// |beta| below this share of |alpha|: the eigenvalue is infinite.
constexpr double infinite = 1e-13;
/// Eigenvalues closer than this share of their magnitude are equal.
constexpr double equal = 1e-7;

/// Column j of LAPACK's real storage as a complex vector; `conjugate`: the second of a pair.
ComplexVector column(const Matrix& vectors, Eigen::Index j, bool is_complex, bool conjugate) {
  if (!is_complex) return vectors.col(j).cast<Complex>();
  const Eigen::Index first = conjugate ? j - 1 : j;
  ComplexVector result(vectors.rows());
  result.real() = vectors.col(first);
  result.imag() = (conjugate ? -1.0 : 1.0) * vectors.col(first + 1);
  return result;
}

/// Replaces entries by zero that are below rounding of others of their row and of their column: noise of the
/// computation that the matrix comes from. Balancing would take it for the size of its row or column.
void drop_noise(Matrix& a) {
  const Vector rows = a.cwiseAbs().rowwise().maxCoeff();
  const Vector columns = a.cwiseAbs().colwise().maxCoeff().transpose();
  for (Eigen::Index j = 0; j < a.cols(); ++j) {
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      if (std::abs(a(i, j)) <= std::numeric_limits<double>::epsilon() * std::min(rows[i], columns[j]))
        a(i, j) = 0.0;
    }
  }
}

/// a x = lambda b x, with vectors u^H a = lambda u^H b.
std::vector<EigenTriple> generalized(Matrix a, Matrix b) {
  drop_noise(a);
  drop_noise(b);
  const Eigen::Index n = a.rows();
  const auto size = static_cast<lapack_int>(n);
  Vector real(n), imaginary(n), beta(n), left_scale(n), right_scale(n), rcond_values(n), rcond_vectors(n);
  Matrix left(n, n), right(n, n);
  lapack_int low = 0, high = 0;
  double norm_a = 0.0, norm_b = 0.0;
  const lapack_int info = LAPACKE_dggevx(
      LAPACK_COL_MAJOR, 'B', 'V', 'V', 'N', size, a.data(), size, b.data(), size, real.data(),
      imaginary.data(), beta.data(), left.data(), size, right.data(), size, &low, &high, left_scale.data(),
      right_scale.data(), &norm_a, &norm_b, rcond_values.data(), rcond_vectors.data());
  std::vector<EigenTriple> all;
  if (info != 0) return all;
  bool second = false;
  for (Eigen::Index j = 0; j < n; ++j) {
    const bool is_complex = imaginary[j] != 0.0;
    const Complex alpha(real[j], imaginary[j]);
    const bool conjugate = is_complex && second;
    second = is_complex && !second;
    if (std::abs(beta[j]) <= infinite * std::abs(alpha)) continue;
    all.push_back(
        {alpha / beta[j], column(right, j, is_complex, conjugate), column(left, j, is_complex, conjugate)});
  }
  return all;
}

/// Replaces the left vectors of equal eigenvalues by combinations with Y^H P'(s) Z diagonal.
void make_biorthogonal(std::vector<EigenTriple>& all, const Matrix& M, const Matrix& C) {
  std::sort(all.begin(), all.end(), [](const EigenTriple& a, const EigenTriple& b) {
    return std::pair(a.s.imag(), a.s.real()) < std::pair(b.s.imag(), b.s.real());
  });
  for (std::size_t begin = 0; begin < all.size();) {
    std::size_t end = begin + 1;
    while (end < all.size() && std::abs(all[end].s - all[begin].s) <= equal * std::abs(all[begin].s)) ++end;
    const auto count = static_cast<Eigen::Index>(end - begin);
    if (count > 1) {
      ComplexMatrix Y(M.rows(), count), slopes(M.rows(), count);
      for (Eigen::Index i = 0; i < count; ++i) {
        const EigenTriple& one = all[begin + static_cast<std::size_t>(i)];
        Y.col(i) = one.left.normalized();
        slopes.col(i) = 2.0 * one.s * (M * one.right) + C * one.right;
      }
      Eigen::FullPivLU<ComplexMatrix> gram(Y.adjoint() * slopes);
      gram.setThreshold(1e-6);  // defective: the vectors stay as they are
      if (gram.isInvertible()) {
        const ComplexMatrix combined = Y * gram.inverse().adjoint();
        for (Eigen::Index i = 0; i < count; ++i)
          all[begin + static_cast<std::size_t>(i)].left = combined.col(i);
      }
    }
    begin = end;
  }
}

}  // namespace

std::vector<EigenTriple> eigen_triples(const Matrix& M, const Matrix& C, const Matrix& K) {
  const Eigen::Index n = M.rows();
  std::vector<EigenTriple> all;
  if (M.isZero(0.0)) {
    all = generalized(-K, C);
  } else {
    Matrix a = Matrix::Zero(2 * n, 2 * n), b = Matrix::Identity(2 * n, 2 * n);
    a.topRightCorner(n, n).setIdentity();
    a.bottomLeftCorner(n, n) = -K;
    a.bottomRightCorner(n, n) = -C;
    b.bottomRightCorner(n, n) = M;
    const std::vector<EigenTriple> doubled = generalized(std::move(a), std::move(b));
    for (const EigenTriple& one : doubled) {
      const ComplexVector upper = one.right.head(n), lower = one.right.tail(n);
      all.push_back({one.s, upper.norm() >= lower.norm() ? upper : lower, one.left.tail(n)});
    }
  }
  make_biorthogonal(all, M, C);
  for (EigenTriple& one : all) one.right /= one.left.dot(2.0 * one.s * (M * one.right) + C * one.right);
  return all;
}

}  // namespace eigentrail
