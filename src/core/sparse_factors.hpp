// LU factors of a large sparse matrix, real or complex, by SuiteSparse: Cholesky factors (CHOLMOD) where the
// matrix is symmetric and turns out to be positive definite, else LU (UMFPACK).
//
// This is the only place that knows which library factors sparse matrices.
#pragma once

#include <cstddef>
#include <memory>

#include "eigentrail/core/system_matrix.hpp"

namespace eigentrail {

using ComplexSparseMatrix = Eigen::SparseMatrix<Complex>;

/// What is known of a matrix before it is factored.
enum class SparseKind { symmetric, general };

/// Upper bounds of memory and work of a factorization, from the symbolic analysis.
struct FactorEstimate {
  double bytes = 0.0;
  double operations = 0.0;
  const char* method = "";
};
FactorEstimate estimate_factors(const SparseMatrix& A, SparseKind kind);

/// Factors matrices of one sparsity pattern, one at a time; the symbolic analysis is made once.
class SparseFactors {
 public:
  SparseFactors();
  ~SparseFactors();
  SparseFactors(SparseFactors&&) noexcept;
  SparseFactors& operator=(SparseFactors&&) noexcept;

  /// Factors A, n x n; the factors before are freed first. Returns whether it succeeded: false if A is
  /// singular. Throws std::bad_alloc if memory does not suffice. A matrix with another pattern than the one
  /// before is analyzed anew.
  bool factor(const SparseMatrix& A, SparseKind kind);
  bool factor(const ComplexSparseMatrix& A);

  /// A^-1 B and A^-T B for the matrix that was factored last; B is n x k. If A is real and B complex, both
  /// parts are solved for.
  Matrix solve(const Matrix& B) const;
  Matrix solve_transposed(const Matrix& B) const;
  ComplexVector solve(const ComplexVector& b) const;
  ComplexVector solve_transposed(const ComplexVector& b) const;

  bool is_complex() const;
  /// An estimate of the reciprocal condition number by the diagonal of the factors.
  double reciprocal_condition() const;
  /// Memory of the factors.
  std::size_t bytes() const;
  /// "Cholesky (CHOLMOD)" or "LU (UMFPACK)".
  const char* method() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace eigentrail
