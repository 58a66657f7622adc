// Factors of a large sparse matrix, real or complex, by SuiteSparse: Cholesky factors (CHOLMOD) where the
// matrix is symmetric and turns out to be positive definite, else LU (UMFPACK).
//
// This is the only place of the library that knows what factors sparse matrices.
#pragma once

#include "eigentrail/core/log_determinant.hpp"
#include "eigentrail/core/sparse_solver.hpp"

namespace eigentrail {

class SparseFactors final : public SparseSolver {
 public:
  SparseFactors();
  ~SparseFactors() override;

  bool factor(const SparseMatrix& A, SparseKind kind) override;
  bool factor(const ComplexSparseMatrix& A) override;
  Matrix solve(const Matrix& B) const override;
  Matrix solve_transposed(const Matrix& B) const override;
  ComplexVector solve(const ComplexVector& b) const override;
  ComplexVector solve_transposed(const ComplexVector& b) const override;
  bool is_complex() const override;
  std::size_t bytes() const override;
  /// "Cholesky (CHOLMOD)" or "LU (UMFPACK)".
  std::string method() const override;
  FactorEstimate estimate(const SparseMatrix& A, SparseKind kind) const override;

  /// Of the real matrix that was factored last, not as a symmetric one. Throws std::logic_error if there is
  /// none.
  LogDeterminant determinant() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// A solver by the maker; by SuiteSparse if it is empty.
std::unique_ptr<SparseSolver> make_solver(const SparseSolverMaker& maker);

}  // namespace eigentrail
