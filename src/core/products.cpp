#include "core/products.hpp"

// BLAS by its Fortran interface: not every BLAS has the C interface.
extern "C" {
void dgemm_(const char* form_A, const char* form_B, const int* m, const int* n, const int* k,
            const double* alpha, const double* A, const int* stride_A, const double* B, const int* stride_B,
            const double* beta, double* C, const int* stride_C);
void dgemv_(const char* form, const int* m, const int* n, const double* alpha, const double* A,
            const int* stride_A, const double* x, const int* increment_x, const double* beta, double* y,
            const int* increment_y);
void zgemv_(const char* form, const int* m, const int* n, const eigentrail::Complex* alpha,
            const eigentrail::Complex* A, const int* stride_A, const eigentrail::Complex* x,
            const int* increment_x, const eigentrail::Complex* beta, eigentrail::Complex* y,
            const int* increment_y);
}

namespace eigentrail {
namespace {

Matrix dgemm(char form, const Matrix& A, const Matrix& B) {
  const auto rows = static_cast<int>(form == 'N' ? A.rows() : A.cols());
  const auto columns = static_cast<int>(B.cols());
  const auto inner = static_cast<int>(B.rows());
  if (rows == 0 || columns == 0 || inner == 0) return Matrix::Zero(rows, columns);
  const auto stride = static_cast<int>(A.rows());
  const double one = 1.0, zero = 0.0;
  Matrix C(rows, columns);
  dgemm_(&form, "N", &rows, &columns, &inner, &one, A.data(), &stride, B.data(), &inner, &zero, C.data(),
         &rows);
  return C;
}

ComplexVector zgemv(char form, const ComplexMatrix& A, const ComplexVector& x) {
  const auto rows = static_cast<int>(A.rows());
  const auto columns = static_cast<int>(A.cols());
  const int size = form == 'N' ? rows : columns;
  if (rows == 0 || columns == 0) return ComplexVector::Zero(size);
  const Complex one = 1.0, zero = 0.0;
  const int next = 1;
  ComplexVector y(size);
  zgemv_(&form, &rows, &columns, &one, A.data(), &rows, x.data(), &next, &zero, y.data(), &next);
  return y;
}

/// A x (form 'N') or A^T x (form 'T') for a complex vector x, given as a matrix of one column.
ComplexMatrix dgemv(char form, const Matrix& A, const ComplexMatrix& x) {
  const auto rows = static_cast<int>(A.rows());
  const auto columns = static_cast<int>(A.cols());
  const double one = 1.0, zero = 0.0;
  const int next = 2;  // real and imaginary parts alternate in memory
  ComplexMatrix y(form == 'N' ? rows : columns, 1);
  // The standard guarantees that std::complex<double> can be read as an array of two doubles
  // ([complex.numbers]).
  const auto* const from = reinterpret_cast<const double*>(x.data());
  auto* const to = reinterpret_cast<double*>(y.data());
  for (const int part : {0, 1})
    dgemv_(&form, &rows, &columns, &one, A.data(), &rows, from + part, &next, &zero, to + part, &next);
  return y;
}

/// The same for any number of columns.
ComplexMatrix by_parts(char form, const Matrix& A, const ComplexMatrix& X) {
  const Eigen::Index columns = X.cols();
  if (A.size() == 0) return ComplexMatrix::Zero(form == 'N' ? A.rows() : A.cols(), columns);
  if (columns == 1) return dgemv(form, A, X);
  Matrix parts(X.rows(), 2 * columns);
  parts << X.real(), X.imag();
  const Matrix AX = dgemm(form, A, parts);
  ComplexMatrix result(AX.rows(), columns);
  result.real() = AX.leftCols(columns);
  result.imag() = AX.rightCols(columns);
  return result;
}

MatrixSeries series_product(char form, const MatrixSeries& A, const MatrixSeries& B, std::size_t count) {
  MatrixSeries sum(count, Matrix::Zero(form == 'N' ? A[0].rows() : A[0].cols(), B[0].cols()));
  for (std::size_t i = 0; i < A.size(); ++i) {
    for (std::size_t j = 0; j < B.size() && i + j < count; ++j) sum[i + j] += dgemm(form, A[i], B[j]);
  }
  return sum;
}

}  // namespace

Matrix product(const Matrix& A, const Matrix& B) {
  return dgemm('N', A, B);
}

Matrix transposed_product(const Matrix& A, const Matrix& B) {
  return dgemm('T', A, B);
}

MatrixSeries product(const MatrixSeries& A, const MatrixSeries& B, std::size_t count) {
  return series_product('N', A, B, count);
}

MatrixSeries transposed_product(const MatrixSeries& A, const MatrixSeries& B, std::size_t count) {
  return series_product('T', A, B, count);
}

ComplexMatrix product(const Matrix& A, const ComplexMatrix& X) {
  return by_parts('N', A, X);
}

ComplexMatrix transposed_product(const Matrix& A, const ComplexMatrix& X) {
  return by_parts('T', A, X);
}

ComplexVector product(const ComplexMatrix& A, const ComplexVector& x) {
  return zgemv('N', A, x);
}

ComplexVector adjoint_product(const ComplexMatrix& A, const ComplexVector& x) {
  return zgemv('C', A, x);
}

Matrix magnitudes_of_terms(const Matrix& A, const Matrix& B, const Matrix& C) {
  return A.cwiseAbs().transpose() * B.cwiseAbs() * C.cwiseAbs();
}

}  // namespace eigentrail
