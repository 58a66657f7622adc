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

ComplexLu::ComplexLu(ComplexMatrix A)
    : factors_(std::move(A)), pivots_(static_cast<std::size_t>(factors_.rows())) {
  const auto n = static_cast<lapack_int>(factors_.rows());
  LAPACKE_zgetrf_work(LAPACK_COL_MAJOR, n, n, factors_.data(), n, pivots_.data());
}

void ComplexLu::substitute(char triangle, char form, Eigen::Ref<ComplexMatrix> B) const {
  const auto n = static_cast<int>(factors_.rows());
  const auto columns = static_cast<int>(B.cols());
  const auto stride = static_cast<int>(B.outerStride());
  // L has a unit diagonal that is not stored, U stores its own
  const char diagonal = triangle == 'L' ? 'U' : 'N';
  if (columns == 1) {
    const int next = 1;
    ztrsv_(&triangle, &form, &diagonal, &n, factors_.data(), &n, B.data(), &next);
  } else {
    const char side = 'L';
    const Complex one(1.0);
    ztrsm_(&side, &triangle, &form, &diagonal, &n, &columns, &one, factors_.data(), &n, B.data(), &stride);
  }
}

void ComplexLu::solve_in_place(Eigen::Ref<ComplexMatrix> B) const {
  for (std::size_t i = 0; i < pivots_.size(); ++i)
    B.row(static_cast<Eigen::Index>(i)).swap(B.row(pivots_[i] - 1));
  substitute('L', 'N', B);
  substitute('U', 'N', B);
}

void ComplexLu::solve_adjoint_in_place(Eigen::Ref<ComplexMatrix> B) const {
  substitute('U', 'C', B);
  substitute('L', 'C', B);
  for (std::size_t i = pivots_.size(); i-- > 0;)
    B.row(static_cast<Eigen::Index>(i)).swap(B.row(pivots_[i] - 1));
}

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
