#include "core/singular_vectors.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/lapack.hpp"

namespace eigentrail {
namespace {

/// `svd(m, n, A, result)` computes the values, U and V^H and returns LAPACK's outcome. All matrices have an
/// empty column behind their own.
template <class Values, class Svd>
SingularVectors<Values> decompose(Values A, bool with_left, const Svd& svd) {
  const auto m = static_cast<lapack_int>(A.rows());
  const auto n = static_cast<lapack_int>(A.cols());
  const lapack_int count = std::min(m, n);
  // zgemv of OpenBLAS 0.3.21 for AVX2 and AVX-512 reads up to a column past the end of a matrix, and crashes
  // where no memory follows. So every matrix has one more.
  SingularVectors<Values> result{Vector::Zero(count), {}, Values::Identity(n, n + 1)};
  if (with_left) result.U = Values::Identity(m, m + 1);
  const auto without_the_last = [](Values& B, lapack_int size) { B = Values(B.leftCols(size)); };
  if (count > 0) {
    A.conservativeResize(Eigen::NoChange, n + 1);
    A.col(n).setZero();
  }
  const lapack_int info = count > 0 ? svd(m, n, A, result) : 0;
  without_the_last(result.V, n);
  if (with_left) without_the_last(result.U, m);
  result.V.adjointInPlace();
  if (info == 0) return result;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  result.values.setConstant(nan);
  result.U.setConstant(nan);
  result.V.setConstant(nan);
  return result;
}

/// By QR iteration. `gesvd`: LAPACK's function for the type of the matrix.
template <class Values, class Gesvd>
SingularVectors<Values> by_iteration(Values A, bool with_left, Gesvd&& gesvd) {
  return decompose(std::move(A), with_left,
                   [&](lapack_int m, lapack_int n, Values& matrix, SingularVectors<Values>& result) {
                     Vector unconverged(result.values.size());
                     return gesvd(LAPACK_COL_MAJOR, with_left ? 'A' : 'N', 'A', m, n, matrix.data(), m,
                                  result.values.data(), result.U.data(), with_left ? m : 1, result.V.data(),
                                  n, unconverged.data());
                   });
}

}  // namespace

/// Divide and conquer, in half the time.
SingularVectors<Matrix> singular_vectors(Matrix A) {
  return decompose(std::move(A), true,
                   [](lapack_int m, lapack_int n, Matrix& matrix, SingularVectors<Matrix>& result) {
                     return LAPACKE_dgesdd(LAPACK_COL_MAJOR, 'A', m, n, matrix.data(), m,
                                           result.values.data(), result.U.data(), m, result.V.data(), n);
                   });
}

SingularVectors<ComplexMatrix> singular_vectors(ComplexMatrix A) {
  return by_iteration(std::move(A), true, LAPACKE_zgesvd);
}

SingularVectors<Matrix> right_singular_vectors(Matrix A) {
  return by_iteration(std::move(A), false, LAPACKE_dgesvd);
}

SingularVectors<ComplexMatrix> right_singular_vectors(ComplexMatrix A) {
  return by_iteration(std::move(A), false, LAPACKE_zgesvd);
}

}  // namespace eigentrail
