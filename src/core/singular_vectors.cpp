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
SingularVectors<Values> decompose(Values A, const Svd& svd) {
  const auto m = static_cast<lapack_int>(A.rows());
  const auto n = static_cast<lapack_int>(A.cols());
  const lapack_int count = std::min(m, n);
  // zgemv of OpenBLAS 0.3.21 for AVX2 and AVX-512 reads up to a column past the end of a matrix, and crashes
  // where no memory follows. So every matrix has one more.
  SingularVectors<Values> result{Vector::Zero(count), Values::Identity(m, m + 1), Values::Identity(n, n + 1)};
  const auto without_the_last = [](Values& B, lapack_int size) { B = Values(B.leftCols(size)); };
  if (count > 0) {
    A.conservativeResize(Eigen::NoChange, n + 1);
    A.col(n).setZero();
  }
  const lapack_int info = count > 0 ? svd(m, n, A, result) : 0;
  without_the_last(result.V, n);
  without_the_last(result.U, m);
  result.V.adjointInPlace();
  if (info == 0) return result;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  result.values.setConstant(nan);
  result.U.setConstant(nan);
  result.V.setConstant(nan);
  return result;
}

/// By divide and conquer, in half the time of QR iteration or less. `gesdd`: LAPACK's function for the type
/// of the matrix.
template <class Values, class Gesdd>
SingularVectors<Values> by_division(Values A, const Gesdd& gesdd) {
  return decompose(std::move(A),
                   [&](lapack_int m, lapack_int n, Values& matrix, SingularVectors<Values>& result) {
                     return gesdd(LAPACK_COL_MAJOR, 'A', m, n, matrix.data(), m, result.values.data(),
                                  result.U.data(), m, result.V.data(), n);
                   });
}

/// Without U that of the triangular factor is enough.
template <class Values, class Gesdd, class Geqrf>
SingularVectors<Values> of_triangular_factor(Values A, const Gesdd& gesdd, const Geqrf& geqrf) {
  const auto m = static_cast<lapack_int>(A.rows());
  const auto n = static_cast<lapack_int>(A.cols());
  if (m > n && n > 0) {
    A.conservativeResize(Eigen::NoChange, n + 1);  // as above
    A.col(n).setZero();
    Eigen::Vector<typename Values::Scalar, Eigen::Dynamic> factors(n);
    const lapack_int info = geqrf(LAPACK_COL_MAJOR, m, n, A.data(), m, factors.data());
    A = Values(A.topLeftCorner(n, n).template triangularView<Eigen::Upper>());
    if (info != 0) A.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  SingularVectors<Values> result = by_division(std::move(A), gesdd);
  result.U.resize(0, 0);
  return result;
}

}  // namespace

SingularVectors<Matrix> singular_vectors(Matrix A) {
  return by_division(std::move(A), LAPACKE_dgesdd);
}

SingularVectors<ComplexMatrix> singular_vectors(ComplexMatrix A) {
  return by_division(std::move(A), LAPACKE_zgesdd);
}

SingularVectors<Matrix> right_singular_vectors(Matrix A) {
  return of_triangular_factor(std::move(A), LAPACKE_dgesdd, LAPACKE_dgeqrf);
}

SingularVectors<ComplexMatrix> right_singular_vectors(ComplexMatrix A) {
  return of_triangular_factor(std::move(A), LAPACKE_zgesdd, LAPACKE_zgeqrf);
}

}  // namespace eigentrail
