// Factors of a sparse matrix by MUMPS through PETSc, shared by all processes. Every function is called by all
// processes together; what the first one gives, the matrix or the right-hand side, is null in the others.
#pragma once

#include <petscmat.h>

#include <vector>

#include "eigentrail/core/sparse_solver.hpp"

namespace eigentrail::app {

/// Throws std::runtime_error with PETSc's text if a call has failed.
void check_petsc(PetscErrorCode code);

/// What has become of a factorization; the same in all processes.
struct FactorOutcome {
  enum class Status { done, singular, no_memory, failed } status = Status::done;
  PetscInt code = 0;  ///< of MUMPS if it has failed: INFOG(1)
};

class PetscFactors {
 public:
  PetscFactors() = default;
  ~PetscFactors();
  PetscFactors(const PetscFactors&) = delete;
  PetscFactors& operator=(const PetscFactors&) = delete;

  /// Factors A, `size` x `size`: L D L^T if it is symmetric, definite or not, else L U. `analyzed`: the
  /// matrix before had the same pattern and kind, and its symbolic analysis serves again.
  FactorOutcome factor(const SparseMatrix* A, PetscInt size, SparseKind kind, bool analyzed);

  /// Replaces b, `size` numbers, by A^-1 b or A^-T b.
  void solve(double* b, bool transposed) const;

  /// The symbolic analysis alone. `method` stays empty.
  FactorEstimate estimate(const SparseMatrix* A, PetscInt size, SparseKind kind);

  double bytes() const;  ///< of the factors in all processes

 private:
  void distribute(const SparseMatrix* A, PetscInt size);
  void analyze();

  SparseKind kind_ = SparseKind::general;
  std::vector<int> counts_, begins_;  ///< rows of each process, and the first of them
  Mat matrix_ = nullptr;              ///< A^T: the rows of PETSc are the columns of A
  Mat factors_ = nullptr;
  Vec right_ = nullptr, solution_ = nullptr;
  // The matrix refers to these.
  std::vector<PetscInt> starts_, columns_;
  std::vector<double> values_;
};

}  // namespace eigentrail::app
