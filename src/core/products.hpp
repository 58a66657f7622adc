// Products of large matrices by BLAS. They are two to four times faster than Eigen's products, because the
// compiler builds Eigen's for the oldest x86-64 processors. Empty factors are allowed.
#pragma once

#include <optional>
#include <vector>

#include "core/diagonal_blocks.hpp"
#include "eigentrail/core/system_matrix.hpp"

namespace eigentrail {

/// A B.
Matrix product(const Matrix& A, const Matrix& B);

/// A^T B.
Matrix transposed_product(const Matrix& A, const Matrix& B);

/// left^T B right. Zeros of `left` and `right` are left out where they are most of the entries.
Matrix congruence(const Matrix& left, const Matrix& B, const Matrix& right);

/// |A|^T |B| |C|: for every entry of A^T B C the sum of the magnitudes of its terms.
Matrix magnitudes_of_terms(const Matrix& A, const Matrix& B, const Matrix& C);

/// Power series with sparse coefficients.
using SparseSeries = std::vector<SparseMatrix>;

/// Whether most entries of each coefficient are exactly zero.
bool is_mostly_zero(const MatrixSeries& A);

/// The series with sparse coefficients if most entries of each are exactly zero, as in a tangent basis of
/// bodies whose constraints fall into blocks; else empty.
std::optional<SparseSeries> mostly_zero(const MatrixSeries& A);

/// left(h)^T B(h) right(h) for several B, where most entries of `left` and `right` are exactly zero.
class SparseCongruence {
 public:
  /// Empty unless most entries of each coefficient are zero.
  static std::optional<SparseCongruence> of(const MatrixSeries& left, const MatrixSeries& right);

  /// The first coefficients, at most `count`.
  MatrixSeries operator()(const SystemSeries& B, std::size_t count) const;

 private:
  /// A series with entries in diagonal blocks only.
  struct Blocks {
    explicit Blocks(const MatrixSeries& A);

    std::size_t coefficients;
    Eigen::Index columns;
    std::vector<DiagonalBlock> blocks;
    std::vector<std::size_t> block_of;  ///< of each row; 0 of one that is zero
    Matrix values;  ///< of each row in a column: all coefficients in the columns of its block
  };

  SparseCongruence(const MatrixSeries& left, const MatrixSeries& right) : left_(left), right_(right) {}

  Blocks left_, right_;
};

/// The first `count` coefficients of A(h) B(h) and of A(h)^T B(h). Zeros of the factor that is given second
/// and first, respectively, are left out where they are most of its entries.
MatrixSeries product(const MatrixSeries& A, const MatrixSeries& B, std::size_t count);
MatrixSeries transposed_product(const MatrixSeries& A, const MatrixSeries& B, std::size_t count);

/// A X and A^T X for complex X, without a complex copy of A.
ComplexMatrix product(const Matrix& A, const ComplexMatrix& X);
ComplexMatrix transposed_product(const Matrix& A, const ComplexMatrix& X);

/// A x and A^H x.
ComplexVector product(const ComplexMatrix& A, const ComplexVector& x);
ComplexVector adjoint_product(const ComplexMatrix& A, const ComplexVector& x);

/// A X and A^H X.
ComplexMatrix product(const ComplexMatrix& A, const ComplexMatrix& X);
ComplexMatrix adjoint_product(const ComplexMatrix& A, const ComplexMatrix& X);

}  // namespace eigentrail
