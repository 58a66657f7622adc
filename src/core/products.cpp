#include "core/products.hpp"

#include <algorithm>
#include <utility>

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
void zgemm_(const char* form_A, const char* form_B, const int* m, const int* n, const int* k,
            const eigentrail::Complex* alpha, const eigentrail::Complex* A, const int* stride_A,
            const eigentrail::Complex* B, const int* stride_B, const eigentrail::Complex* beta,
            eigentrail::Complex* C, const int* stride_C);
}

namespace eigentrail {
namespace {

/// Adds A B (form 'N'), A^T B (form 'T') or A^H B (form 'C') to C. `multiply`: dgemm_ or zgemm_.
template <class Dense, class Gemm>
void add_full_product(Gemm multiply, char form, const Dense& A, const Dense& B, Dense& C) {
  const auto rows = static_cast<int>(C.rows());
  const auto columns = static_cast<int>(C.cols());
  const auto inner = static_cast<int>(B.rows());
  if (rows == 0 || columns == 0 || inner == 0) return;
  const auto stride = static_cast<int>(A.rows());
  const typename Dense::Scalar one = 1.0;
  multiply(&form, "N", &rows, &columns, &inner, &one, A.data(), &stride, B.data(), &inner, &one, C.data(),
           &rows);
}

template <class Dense, class Gemm>
Dense full_product(Gemm multiply, char form, const Dense& A, const Dense& B) {
  Dense C = Dense::Zero(form == 'N' ? A.rows() : A.cols(), B.cols());
  add_full_product(multiply, form, A, B, C);
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

/// A X (form 'N') or A^T X (form 'T') for few complex columns X. Real and imaginary parts alternate in
/// memory: each is a vector with increment two. dgemm would copy A first, which takes longer than the
/// products.
ComplexMatrix by_vectors(char form, const Matrix& A, const ComplexMatrix& X) {
  const auto rows = static_cast<int>(A.rows());
  const auto columns = static_cast<int>(A.cols());
  const double one = 1.0, zero = 0.0;
  const int next = 2;
  ComplexMatrix Y(form == 'N' ? rows : columns, X.cols());
  // The standard guarantees that std::complex<double> can be read as an array of two doubles
  // ([complex.numbers]).
  const auto* const from = reinterpret_cast<const double*>(X.data());
  auto* const to = reinterpret_cast<double*>(Y.data());
  for (Eigen::Index j = 0; j < X.cols(); ++j) {
    for (int part = 0; part < 2; ++part)
      dgemv_(&form, &rows, &columns, &one, A.data(), &rows, from + 2 * j * X.rows() + part, &next, &zero,
             to + 2 * j * Y.rows() + part, &next);
  }
  return Y;
}

/// The same for any number of columns.
ComplexMatrix by_parts(char form, const Matrix& A, const ComplexMatrix& X) {
  const Eigen::Index columns = X.cols();
  if (A.size() == 0) return ComplexMatrix::Zero(form == 'N' ? A.rows() : A.cols(), columns);
  constexpr Eigen::Index few = 2;  // affects only the time
  if (columns <= few) return by_vectors(form, A, X);
  Matrix parts(X.rows(), 2 * columns);
  parts << X.real(), X.imag();
  const Matrix AX = full_product(dgemm_, form, A, parts);
  ComplexMatrix result(AX.rows(), columns);
  result.real() = AX.leftCols(columns);
  result.imag() = AX.rightCols(columns);
  return result;
}

/// Calls add(A_i, B_j, sum_{i+j}) for all coefficients of a product of series up to h^(count - 1).
template <class Left, class Right, class Add>
MatrixSeries series_product(const std::vector<Left>& A, const std::vector<Right>& B, Eigen::Index rows,
                            std::size_t count, Add add) {
  MatrixSeries sum(count, Matrix::Zero(rows, B[0].cols()));
  for (std::size_t i = 0; i < A.size(); ++i) {
    for (std::size_t j = 0; j < B.size() && i + j < count; ++j) add(A[i], B[j], sum[i + j]);
  }
  return sum;
}

/// Products with a sparse matrix are faster than those of BLAS where at most one in so many entries is not
/// zero. It affects only the time.
constexpr Eigen::Index few_entries = 12;

bool has_few_entries(const Matrix& A) {
  Eigen::Index allowed = A.size() / few_entries;
  for (Eigen::Index j = 0; j < A.cols() && allowed >= 0; ++j) allowed -= (A.col(j).array() != 0.0).count();
  return allowed >= 0;
}

/// A B and A^T B, without the zeros of B and of A, respectively, where they are most of its entries.
Matrix by_entries(const Matrix& A, const Matrix& B) {
  if (has_few_entries(B)) return A * SparseMatrix(B.sparseView());
  return full_product(dgemm_, 'N', A, B);
}
Matrix transposed_by_entries(const Matrix& A, const Matrix& B) {
  if (has_few_entries(A)) return SparseMatrix(A.sparseView()).transpose() * B;
  return full_product(dgemm_, 'T', A, B);
}

}  // namespace

Matrix product(const Matrix& A, const Matrix& B) {
  return full_product(dgemm_, 'N', A, B);
}

Matrix transposed_product(const Matrix& A, const Matrix& B) {
  return full_product(dgemm_, 'T', A, B);
}

bool is_mostly_zero(const MatrixSeries& A) {
  return std::all_of(A.begin(), A.end(), has_few_entries);
}

std::optional<SparseSeries> mostly_zero(const MatrixSeries& A) {
  if (!is_mostly_zero(A)) return std::nullopt;
  SparseSeries sparse;
  for (const Matrix& coefficient : A) sparse.emplace_back(coefficient.sparseView());
  return sparse;
}

MatrixSeries product(const MatrixSeries& A, const MatrixSeries& B, std::size_t count) {
  if (const auto sparse = mostly_zero(B)) {
    return series_product(
        A, *sparse, A[0].rows(), count,
        [](const Matrix& a, const SparseMatrix& b, Matrix& sum) { sum.noalias() += a * b; });
  }
  return series_product(A, B, A[0].rows(), count, [](const Matrix& a, const Matrix& b, Matrix& sum) {
    add_full_product(dgemm_, 'N', a, b, sum);
  });
}

MatrixSeries transposed_product(const MatrixSeries& A, const MatrixSeries& B, std::size_t count) {
  if (const auto sparse = mostly_zero(A)) {
    return series_product(
        *sparse, B, A[0].cols(), count,
        [](const SparseMatrix& a, const Matrix& b, Matrix& sum) { sum.noalias() += a.transpose() * b; });
  }
  return series_product(A, B, A[0].cols(), count, [](const Matrix& a, const Matrix& b, Matrix& sum) {
    add_full_product(dgemm_, 'T', a, b, sum);
  });
}

namespace {

/// Adds a multiple of the first entries of a vector.
void add_scaled(double factor, const double* vector, Eigen::Index size, double* sum) {
  Eigen::Map<Vector>(sum, size) += factor * Eigen::Map<const Vector>(vector, size);
}

}  // namespace

SparseCongruence::Blocks::Blocks(const MatrixSeries& A)
    : coefficients(A.size()),
      columns(A[0].cols()),
      blocks(diagonal_blocks(A)),
      block_of(static_cast<std::size_t>(A[0].rows())) {
  values.setZero(largest_width(blocks) * std::ssize(A), A[0].rows());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    for (const Eigen::Index row : blocks[b].rows) {
      block_of[static_cast<std::size_t>(row)] = b;
      double* value = values.col(row).data();
      for (const Matrix& coefficient : A) {
        for (const Eigen::Index column : blocks[b].columns) *value++ = coefficient(row, column);
      }
    }
  }
}

// Block by block of the columns of right(h); its columns and all coefficients lie together.
MatrixSeries SparseCongruence::operator()(const SystemSeries& B, std::size_t count) const {
  const std::size_t products = std::min(count, B.size() + right_.coefficients - 1);
  MatrixSeries result(std::min(count, products + left_.coefficients - 1),
                      Matrix::Zero(left_.columns, right_.columns));
  const Eigen::Index width = largest_width(right_.blocks);
  Matrix columns = Matrix::Zero(width * static_cast<Eigen::Index>(products), B[0].rows());  // B(h) right(h)
  Matrix sums(width * std::ssize(result), left_.columns);
  std::vector<Eigen::Index> filled;  // rows of B(h) right(h) that are not zero
  std::vector<char> is_filled(static_cast<std::size_t>(B[0].rows()));
  for (const DiagonalBlock& block : right_.blocks) {
    const auto length = [&](std::size_t coefficients) {
      return static_cast<Eigen::Index>(coefficients * block.columns.size());
    };
    for (const Eigen::Index q : block.rows) {
      for (std::size_t i = 0; i < B.size() && i < products; ++i) {
        const Eigen::Index size = length(std::min(right_.coefficients, products - i));
        B[i].for_each_in_column(q, [&](Eigen::Index row, double entry) {
          add_scaled(entry, right_.values.col(q).data(), size, columns.col(row).data() + length(i));
          if (!std::exchange(is_filled[static_cast<std::size_t>(row)], true)) filled.push_back(row);
        });
      }
    }
    sums.setZero();
    for (const Eigen::Index row : filled) {
      const auto& to = left_.blocks[left_.block_of[static_cast<std::size_t>(row)]].columns;
      const double* value = left_.values.col(row).data();
      for (std::size_t i = 0; i < left_.coefficients; ++i) {
        const Eigen::Index size = i < result.size() ? length(std::min(products, result.size() - i)) : 0;
        for (const Eigen::Index column : to)
          add_scaled(*value++, columns.col(row).data(), size, sums.col(column).data() + length(i));
      }
      columns.col(row).setZero();
      is_filled[static_cast<std::size_t>(row)] = false;
    }
    filled.clear();
    for (std::size_t k = 0; k < result.size(); ++k)
      result[k](Eigen::all, block.columns) = sums.middleRows(length(k), length(1)).transpose();
  }
  return result;
}

std::optional<SparseCongruence> SparseCongruence::of(const MatrixSeries& left, const MatrixSeries& right) {
  if (!is_mostly_zero(left) || !is_mostly_zero(right)) return std::nullopt;
  return SparseCongruence(left, right);
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

ComplexMatrix product(const ComplexMatrix& A, const ComplexMatrix& X) {
  return full_product(zgemm_, 'N', A, X);
}

ComplexMatrix adjoint_product(const ComplexMatrix& A, const ComplexMatrix& X) {
  return full_product(zgemm_, 'C', A, X);
}

Matrix congruence(const Matrix& left, const Matrix& B, const Matrix& right) {
  return transposed_by_entries(left, by_entries(B, right));
}

Matrix magnitudes_of_terms(const Matrix& A, const Matrix& B, const Matrix& C) {
  const Matrix magnitudes_A = A.cwiseAbs();
  return transposed_by_entries(magnitudes_A, by_entries(B.cwiseAbs(), Matrix(C.cwiseAbs())));
}

}  // namespace eigentrail
