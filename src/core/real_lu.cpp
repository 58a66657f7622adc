#include "eigentrail/core/real_lu.hpp"

#include <type_traits>

#include "core/lapack.hpp"

namespace eigentrail {

static_assert(std::is_same_v<lapack_int, int>);

RealLu::RealLu(Matrix A) : factors_(std::move(A)), pivots_(static_cast<std::size_t>(factors_.rows())) {
  const auto n = static_cast<lapack_int>(factors_.rows());
  LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, n, n, factors_.data(), n, pivots_.data());
}

void RealLu::solve(char form, ComplexVector& b) const {
  const auto n = static_cast<lapack_int>(factors_.rows());
  Matrix parts(b.size(), 2);
  parts << b.real(), b.imag();
  LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, form, n, 2, factors_.data(), n, pivots_.data(), parts.data(), n);
  b.real() = parts.col(0);
  b.imag() = parts.col(1);
}

}  // namespace eigentrail
