#include "eigentrail/core/real_lu.hpp"

#include <type_traits>

#include "core/lapack.hpp"

namespace eigentrail {

static_assert(std::is_same_v<lapack_int, int>);

RealLu::RealLu(Matrix A) : factors_(std::move(A)), pivots_(static_cast<std::size_t>(factors_.rows())) {
  const auto n = static_cast<lapack_int>(factors_.rows());
  LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, n, n, factors_.data(), n, pivots_.data());
}

void RealLu::solve(char form, Eigen::Ref<ComplexMatrix> B) const {
  const auto n = static_cast<lapack_int>(factors_.rows());
  Matrix parts(B.rows(), 2 * B.cols());
  parts << B.real(), B.imag();
  LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, form, n, static_cast<lapack_int>(parts.cols()), factors_.data(), n,
                      pivots_.data(), parts.data(), n);
  B.real() = parts.leftCols(B.cols());
  B.imag() = parts.rightCols(B.cols());
}

}  // namespace eigentrail
