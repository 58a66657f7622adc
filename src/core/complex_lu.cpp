#include "eigentrail/core/complex_lu.hpp"

#include <type_traits>
#include <utility>

#include "core/lapack.hpp"

extern "C" void ztrsv_(const char* triangle, const char* form, const char* diagonal, const int* n,
                       const eigentrail::Complex* A, const int* stride, eigentrail::Complex* b,
                       const int* increment);
extern "C" void ztrsm_(const char* side, const char* triangle, const char* form, const char* diagonal,
                       const int* m, const int* n, const eigentrail::Complex* alpha,
                       const eigentrail::Complex* A, const int* stride_A, eigentrail::Complex* B,
                       const int* stride_B);

namespace eigentrail {

static_assert(std::is_same_v<lapack_int, int>);

namespace {

/// Exchanges rows as the factorization did, and back.
template <class Columns>
void exchange_rows(const std::vector<int>& pivots, Columns& B) {
  for (std::size_t i = 0; i < pivots.size(); ++i)
    B.row(static_cast<Eigen::Index>(i)).swap(B.row(pivots[i] - 1));
}
template <class Columns>
void restore_rows(const std::vector<int>& pivots, Columns& B) {
  for (std::size_t i = pivots.size(); i-- > 0;)
    B.row(static_cast<Eigen::Index>(i)).swap(B.row(pivots[i] - 1));
}

}  // namespace

ComplexLu::ComplexLu(ComplexMatrix A)
    : factors_(std::move(A)), pivots_(static_cast<std::size_t>(factors_.rows())) {
  const auto n = static_cast<lapack_int>(factors_.rows());
  LAPACKE_zgetrf_work(LAPACK_COL_MAJOR, n, n, factors_.data(), n, pivots_.data());
}

template <class Columns>
void ComplexLu::substitute(char triangle, char form, Columns& B) const {
  const auto n = static_cast<int>(factors_.rows());
  const auto columns = static_cast<int>(B.cols());
  // L has a unit diagonal that is not stored, U stores its own
  const char diagonal = triangle == 'L' ? 'U' : 'N';
  if (columns == 1) {
    const int next = 1;
    ztrsv_(&triangle, &form, &diagonal, &n, factors_.data(), &n, B.data(), &next);
  } else {
    const char side = 'L';
    const Complex one(1.0);
    ztrsm_(&side, &triangle, &form, &diagonal, &n, &columns, &one, factors_.data(), &n, B.data(), &n);
  }
}

void ComplexLu::solve_in_place(ComplexVector& b) const {
  exchange_rows(pivots_, b);
  substitute('L', 'N', b);
  substitute('U', 'N', b);
}

void ComplexLu::solve_adjoint_in_place(ComplexVector& b) const {
  substitute('U', 'C', b);
  substitute('L', 'C', b);
  restore_rows(pivots_, b);
}

void ComplexLu::solve_in_place(ComplexMatrix& B) const {
  exchange_rows(pivots_, B);
  substitute('L', 'N', B);
  substitute('U', 'N', B);
}

void ComplexLu::solve_adjoint_in_place(ComplexMatrix& B) const {
  substitute('U', 'C', B);
  substitute('L', 'C', B);
  restore_rows(pivots_, B);
}

}  // namespace eigentrail
