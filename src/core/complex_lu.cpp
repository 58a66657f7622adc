#include "eigentrail/core/complex_lu.hpp"

#include <type_traits>
#include <utility>

#include "core/lapack.hpp"

extern "C" void ztrsv_(const char* triangle, const char* form, const char* diagonal, const int* n,
                       const eigentrail::Complex* A, const int* stride, eigentrail::Complex* x,
                       const int* increment);

namespace eigentrail {

static_assert(std::is_same_v<lapack_int, int>);

ComplexLu::ComplexLu(ComplexMatrix A)
    : factors_(std::move(A)), pivots_(static_cast<std::size_t>(factors_.rows())) {
  const auto n = static_cast<lapack_int>(factors_.rows());
  LAPACKE_zgetrf_work(LAPACK_COL_MAJOR, n, n, factors_.data(), n, pivots_.data());
}

/// Column by column: LAPACK's zgetrs copies the factors for its kernels, which one column does not pay for.
void ComplexLu::solve(char form, Eigen::Ref<ComplexMatrix> B) const {
  const auto n = static_cast<int>(factors_.rows());
  const int next = 1;
  const auto triangle = [&](char which, char diagonal, Complex* x) {
    ztrsv_(&which, &form, &diagonal, &n, factors_.data(), &n, x, &next);
  };
  for (Eigen::Index j = 0; j < B.cols(); ++j) {
    auto b = B.col(j);
    if (form == 'N') {
      for (int i = 0; i < n; ++i) std::swap(b[i], b[pivots_[static_cast<std::size_t>(i)] - 1]);
      triangle('L', 'U', b.data());
      triangle('U', 'N', b.data());
    } else {
      triangle('U', 'N', b.data());
      triangle('L', 'U', b.data());
      for (int i = n; i-- > 0;) std::swap(b[i], b[pivots_[static_cast<std::size_t>(i)] - 1]);
    }
  }
}

}  // namespace eigentrail
