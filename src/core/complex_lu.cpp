#include "eigentrail/core/complex_lu.hpp"

#include <type_traits>

#include "core/lapack.hpp"

namespace eigentrail {

static_assert(std::is_same_v<lapack_int, int>);

ComplexLu::ComplexLu(ComplexMatrix A)
    : factors_(std::move(A)), pivots_(static_cast<std::size_t>(factors_.rows())) {
  const auto n = static_cast<lapack_int>(factors_.rows());
  LAPACKE_zgetrf_work(LAPACK_COL_MAJOR, n, n, factors_.data(), n, pivots_.data());
}

void ComplexLu::solve(char form, Eigen::Ref<ComplexMatrix> B) const {
  const auto n = static_cast<lapack_int>(factors_.rows());
  LAPACKE_zgetrs_work(LAPACK_COL_MAJOR, form, n, static_cast<lapack_int>(B.cols()), factors_.data(), n,
                      pivots_.data(), B.data(), static_cast<lapack_int>(B.outerStride()));
}

}  // namespace eigentrail
