// What factors large sparse matrices: the seam between the projection of large models and the library that
// does it. The library's own solver uses SuiteSparse in this process; a program may give another one.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "eigentrail/core/system_matrix.hpp"

namespace eigentrail {

using ComplexSparseMatrix = Eigen::SparseMatrix<Complex>;

/// What is known of a matrix before it is factored. `near_symmetric`: its pattern is nearly symmetric, but
/// for rows and columns with many entries, such as a border: these are eliminated last.
enum class SparseKind { symmetric, near_symmetric, general };

/// Memory and work of a factorization, as the symbolic analysis foresees them.
struct FactorEstimate {
  double bytes = 0.0;
  double operations = 0.0;
  std::string method;
};

/// Factors matrices, one at a time. While the sparsity pattern stays the same, the symbolic analysis is made
/// once.
class SparseSolver {
 public:
  SparseSolver() = default;
  virtual ~SparseSolver() = default;
  SparseSolver(const SparseSolver&) = delete;
  SparseSolver& operator=(const SparseSolver&) = delete;

  /// Factors A, n x n, compressed; the factors before are freed first. Returns whether it succeeded: false if
  /// A is singular. Throws std::bad_alloc if memory does not suffice. A matrix with another pattern than the
  /// one before is analyzed anew. Of a symmetric matrix both triangles are given.
  virtual bool factor(const SparseMatrix& A, SparseKind kind) = 0;
  virtual bool factor(const ComplexSparseMatrix& A) = 0;

  /// A^-1 B and A^-T B for the real matrix that was factored last; B is n x k.
  virtual Matrix solve(const Matrix& B) const = 0;
  virtual Matrix solve_transposed(const Matrix& B) const = 0;
  /// A^-1 b and A^-T b, n, for the matrix that was factored last, real or complex.
  virtual ComplexVector solve(const ComplexVector& b) const = 0;
  virtual ComplexVector solve_transposed(const ComplexVector& b) const = 0;

  /// Whether the matrix that was factored last is complex.
  virtual bool is_complex() const = 0;
  /// Memory of the factors, of all processes together.
  virtual std::size_t bytes() const = 0;
  /// Factors and library, and where several processes share the work their number: "LU (UMFPACK)".
  virtual std::string method() const = 0;

  /// What factors of a real matrix will need. Factors nothing.
  virtual FactorEstimate estimate(const SparseMatrix& A, SparseKind kind) const = 0;
};

/// Makes solvers; an empty one stands for SuiteSparse.
using SparseSolverMaker = std::function<std::unique_ptr<SparseSolver>()>;

}  // namespace eigentrail
