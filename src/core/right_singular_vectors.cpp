#include "core/right_singular_vectors.hpp"

#include <algorithm>
#include <utility>

#include "core/lapack.hpp"

namespace eigentrail {
namespace {

/// `gesvd`: LAPACK's function for the type of the matrix.
template <class Values, class Gesvd>
std::optional<RightSingularVectors<Values>> decompose(Values A, Gesvd&& gesvd) {
  const auto m = static_cast<lapack_int>(A.rows());
  const auto n = static_cast<lapack_int>(A.cols());
  RightSingularVectors<Values> result;
  result.values = Vector::Zero(std::min(m, n));
  Values Vh = Values::Identity(n, n);
  Vector unconverged(std::max<lapack_int>(std::min(m, n), 1));
  const lapack_int info = gesvd(LAPACK_COL_MAJOR, 'N', 'A', m, n, A.data(), std::max<lapack_int>(m, 1),
                                result.values.data(), nullptr, 1, Vh.data(), n, unconverged.data());
  if (info != 0) return std::nullopt;
  result.V = Vh.adjoint();
  return result;
}

}  // namespace

std::optional<RightSingularVectors<Matrix>> right_singular_vectors(Matrix A) {
  return decompose(std::move(A), LAPACKE_dgesvd);
}

std::optional<RightSingularVectors<ComplexMatrix>> right_singular_vectors(ComplexMatrix A) {
  return decompose(std::move(A), LAPACKE_zgesvd);
}

}  // namespace eigentrail
