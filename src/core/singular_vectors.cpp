#include "core/singular_vectors.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/lapack.hpp"

namespace eigentrail {
namespace {

/// `gesvd`: LAPACK's function for the type of the matrix.
template <class Values, class Gesvd>
SingularVectors<Values> decompose(Values A, bool with_left, Gesvd&& gesvd) {
  const auto m = static_cast<lapack_int>(A.rows());
  const auto n = static_cast<lapack_int>(A.cols());
  const lapack_int count = std::min(m, n);
  SingularVectors<Values> result{Vector::Zero(count), {}, Values::Identity(n, n)};
  if (with_left) result.U = Values::Identity(m, m);
  if (count == 0) return result;
  // zgemv of OpenBLAS 0.3.21 for AVX2 and AVX-512 reads up to a column past the end of a matrix, and crashes
  // where no memory follows.
  A.conservativeResize(Eigen::NoChange, n + 1);
  A.col(n).setZero();
  Vector unconverged(count);
  const lapack_int info =
      gesvd(LAPACK_COL_MAJOR, with_left ? 'A' : 'N', 'A', m, n, A.data(), m, result.values.data(),
            result.U.data(), with_left ? m : 1, result.V.data(), n, unconverged.data());
  result.V.adjointInPlace();
  if (info == 0) return result;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  result.values.setConstant(nan);
  result.U.setConstant(nan);
  result.V.setConstant(nan);
  return result;
}

}  // namespace

SingularVectors<Matrix> singular_vectors(Matrix A) {
  return decompose(std::move(A), true, LAPACKE_dgesvd);
}

SingularVectors<ComplexMatrix> singular_vectors(ComplexMatrix A) {
  return decompose(std::move(A), true, LAPACKE_zgesvd);
}

SingularVectors<Matrix> right_singular_vectors(Matrix A) {
  return decompose(std::move(A), false, LAPACKE_dgesvd);
}

SingularVectors<ComplexMatrix> right_singular_vectors(ComplexMatrix A) {
  return decompose(std::move(A), false, LAPACKE_zgesvd);
}

}  // namespace eigentrail
