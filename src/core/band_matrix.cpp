#include "core/band_matrix.hpp"

#include <algorithm>
#include <limits>

#include "core/lapack.hpp"

extern "C" {
void dgbmv_(const char* form, const int* m, const int* n, const int* lower, const int* upper,
            const double* alpha, const double* A, const int* stride, const double* x, const int* increment_x,
            const double* beta, double* y, const int* increment_y);
void zgbmv_(const char* form, const int* m, const int* n, const int* lower, const int* upper,
            const eigentrail::Complex* alpha, const eigentrail::Complex* A, const int* stride,
            const eigentrail::Complex* x, const int* increment_x, const eigentrail::Complex* beta,
            eigentrail::Complex* y, const int* increment_y);
void dtbmv_(const char* triangle, const char* form, const char* diagonal, const int* n, const int* width,
            const double* A, const int* stride, double* x, const int* increment);
void dtbsv_(const char* triangle, const char* form, const char* diagonal, const int* n, const int* width,
            const double* A, const int* stride, double* x, const int* increment);
}

namespace eigentrail {
namespace {

/// Real and imaginary parts of a complex vector alternate in memory: each is a vector with increment two. The
/// standard guarantees that std::complex<double> can be read as an array of two doubles ([complex.numbers]).
constexpr int next_part = 2;

void zgbmv(char form, const ComplexMatrix& band, const Complex* x, Complex* y) {
  const auto n = static_cast<int>(band.cols());
  const auto stride = static_cast<int>(band.rows());
  const int width = stride / 2;
  const Complex one = 1.0;
  const int next = 1;
  zgbmv_(&form, &n, &n, &width, &width, &one, band.data(), &stride, x, &next, &one, y, &next);
}

ComplexMatrix dgbmv(char form, const Matrix& band, const ComplexMatrix& X) {
  const auto n = static_cast<int>(band.cols());
  const auto stride = static_cast<int>(band.rows());
  const int width = stride / 2;
  const double one = 1.0, zero = 0.0;
  ComplexMatrix Y(X.rows(), X.cols());
  for (Eigen::Index j = 0; j < X.cols(); ++j) {
    const auto* const x = reinterpret_cast<const double*>(X.col(j).data());
    auto* const y = reinterpret_cast<double*>(Y.col(j).data());
    for (int part = 0; part < 2; ++part)
      dgbmv_(&form, &n, &n, &width, &width, &one, band.data(), &stride, x + part, &next_part, &zero, y + part,
             &next_part);
  }
  return Y;
}

/// Overwrites x with what a map of real vectors by a triangular band makes of it.
template <class Map>
void for_both_parts(Map map, char form, const Matrix& factor, Complex* x) {
  const auto n = static_cast<int>(factor.cols());
  const auto stride = static_cast<int>(factor.rows());
  const int width = stride - 1;
  auto* const parts = reinterpret_cast<double*>(x);
  for (int part = 0; part < 2; ++part)
    map("U", &form, "N", &n, &width, factor.data(), &stride, parts + part, &next_part);
}

}  // namespace

Eigen::Index band_width(const Matrix& A, Eigen::Index least) {
  const Eigen::Index n = A.rows();
  // Sums of magnitudes are zero only if every entry is, and are faster to form than a search.
  const auto is_zero = [](const auto& entries) {
    return entries.size() == 0 || entries.template lpNorm<1>() == 0.0;
  };
  Eigen::Index width = least;
  for (Eigen::Index j = 0; j < A.cols(); ++j) {
    const auto above = [&] { return A.col(j).head(std::max<Eigen::Index>(j - width, 0)); };
    const auto below = [&] { return A.col(j).tail(std::max<Eigen::Index>(n - 1 - j - width, 0)); };
    while (!is_zero(above()) || !is_zero(below())) ++width;
  }
  return width;
}

Matrix band_of(const Matrix& A, Eigen::Index width) {
  const Eigen::Index n = A.rows();
  Matrix band = Matrix::Zero(2 * width + 1, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const Eigen::Index first = std::max<Eigen::Index>(j - width, 0);
    const Eigen::Index count = std::min(n, j + width + 1) - first;
    band.col(j).segment(width + first - j, count) = A.col(j).segment(first, count);
  }
  return band;
}

ComplexMatrix band_product(const Matrix& band, const ComplexMatrix& X) {
  return dgbmv('N', band, X);
}

ComplexMatrix transposed_band_product(const Matrix& band, const ComplexMatrix& X) {
  return dgbmv('T', band, X);
}

void add_band_product(const ComplexMatrix& band, const Complex* x, Complex* y) {
  zgbmv('N', band, x, y);
}

void add_adjoint_band_product(const ComplexMatrix& band, const Complex* x, Complex* y) {
  zgbmv('C', band, x, y);
}

BandCholesky::BandCholesky(const Matrix& A) {
  const Eigen::Index width = band_width(A);
  factor_ = band_of(A, width).topRows(width + 1);
  const auto n = static_cast<lapack_int>(factor_.cols());
  const auto stride = static_cast<lapack_int>(factor_.rows());
  const bool is_factored =
      n > 0 && LAPACKE_dpbtrf_work(LAPACK_COL_MAJOR, 'U', n, stride - 1, factor_.data(), stride) == 0;
  const double rounding = std::numeric_limits<double>::epsilon() * static_cast<double>(n);
  // Not a number is not above it either.
  exists_ = is_factored &&
            (factor_.row(width).transpose().array().square() > rounding * A.diagonal().array()).all();
}

Matrix BandCholesky::full() const {
  const Eigen::Index n = factor_.cols();
  Matrix R = Matrix::Zero(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const Eigen::Index count = std::min(j, width()) + 1;
    R.col(j).segment(j + 1 - count, count) = factor_.col(j).tail(count);
  }
  return R;
}

Matrix BandCholesky::full_inverse() const {
  Matrix R = full();
  const auto n = static_cast<lapack_int>(R.rows());
  LAPACKE_dtrtri_work(LAPACK_COL_MAJOR, 'U', 'N', n, R.data(), n);
  return R;
}

void BandCholesky::apply(Complex* x) const {
  for_both_parts(dtbmv_, 'N', factor_, x);
}

void BandCholesky::apply_transposed(Complex* x) const {
  for_both_parts(dtbmv_, 'T', factor_, x);
}

void BandCholesky::solve(Complex* x) const {
  for_both_parts(dtbsv_, 'N', factor_, x);
}

void BandCholesky::solve_transposed(Complex* x) const {
  for_both_parts(dtbsv_, 'T', factor_, x);
}

}  // namespace eigentrail
