#include "petsc_factors.hpp"

#include <numeric>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace eigentrail::app {
namespace {

static_assert(std::is_same_v<PetscScalar, double>, "expected PETSc with real double-precision scalars");

int rank_of_this() {
  int rank = 0;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  return rank;
}

PetscInt infog(Mat factors, PetscInt number) {
  PetscInt value = 0;
  check_petsc(MatMumpsGetInfog(factors, number, &value));
  return value;
}

/// Entries of the factors; MUMPS gives numbers beyond the range of int in millions, with a minus.
double entries(PetscInt value) {
  return value < 0 ? -1e6 * static_cast<double>(value) : static_cast<double>(value);
}

FactorOutcome outcome_of(Mat factors) {
  MatFactorError error = MAT_FACTOR_NOERROR;
  check_petsc(MatFactorGetError(factors, &error));
  switch (error) {
    case MAT_FACTOR_NOERROR:
      return {};
    case MAT_FACTOR_STRUCT_ZEROPIVOT:
    case MAT_FACTOR_NUMERIC_ZEROPIVOT:
      return {FactorOutcome::Status::singular};
    case MAT_FACTOR_OUTMEMORY:
      return {FactorOutcome::Status::no_memory, infog(factors, 1)};
    default:
      return {FactorOutcome::Status::failed, infog(factors, 1)};
  }
}

}  // namespace

void check_petsc(PetscErrorCode code) {
  if (code == 0) return;
  const char* text = nullptr;
  char* specific = nullptr;
  PetscErrorMessage(code, &text, &specific);
  throw std::runtime_error(std::string("PETSc: ") + (text != nullptr ? text : "") + " " +
                           (specific != nullptr ? specific : ""));
}

PetscFactors::~PetscFactors() {
  MatDestroy(&factors_);
  MatDestroy(&matrix_);
  VecDestroy(&right_);
  VecDestroy(&solution_);
}

/// Gives each process its share of the columns of A.
void PetscFactors::distribute(const SparseMatrix* A, PetscInt size) {
  int processes = 1;
  MPI_Comm_size(PETSC_COMM_WORLD, &processes);
  const int rank = rank_of_this(), n = static_cast<int>(size);
  counts_.assign(static_cast<std::size_t>(processes), n / processes);
  for (int i = 0; i < n % processes; ++i) ++counts_[static_cast<std::size_t>(i)];
  begins_.assign(counts_.size(), 0);
  std::partial_sum(counts_.begin(), counts_.end() - 1, begins_.begin() + 1);

  const int own = counts_[static_cast<std::size_t>(rank)];
  std::vector<int> lengths, own_lengths(static_cast<std::size_t>(own)), parts, part_begins;
  if (A != nullptr) {
    const int* starts = A->outerIndexPtr();
    for (int j = 0; j < n; ++j) lengths.push_back(starts[j + 1] - starts[j]);
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      part_begins.push_back(starts[begins_[i]]);
      parts.push_back(starts[begins_[i] + counts_[i]] - starts[begins_[i]]);
    }
  }
  MPI_Scatterv(lengths.data(), counts_.data(), begins_.data(), MPI_INT, own_lengths.data(), own, MPI_INT, 0,
               PETSC_COMM_WORLD);
  starts_.assign(1, 0);
  for (const int length : own_lengths) starts_.push_back(starts_.back() + length);
  const int own_entries = static_cast<int>(starts_.back());
  std::vector<int> rows(static_cast<std::size_t>(own_entries));
  values_.resize(static_cast<std::size_t>(own_entries));
  MPI_Scatterv(A == nullptr ? nullptr : A->innerIndexPtr(), parts.data(), part_begins.data(), MPI_INT,
               rows.data(), own_entries, MPI_INT, 0, PETSC_COMM_WORLD);
  MPI_Scatterv(A == nullptr ? nullptr : A->valuePtr(), parts.data(), part_begins.data(), MPI_DOUBLE,
               values_.data(), own_entries, MPI_DOUBLE, 0, PETSC_COMM_WORLD);
  columns_.assign(rows.begin(), rows.end());

  check_petsc(MatDestroy(&matrix_));
  check_petsc(MatCreateMPIAIJWithArrays(PETSC_COMM_WORLD, own, own, size, size, starts_.data(),
                                        columns_.data(), values_.data(), &matrix_));
  check_petsc(
      MatSetOption(matrix_, MAT_SYMMETRIC, kind_ == SparseKind::symmetric ? PETSC_TRUE : PETSC_FALSE));
  check_petsc(VecDestroy(&right_));
  check_petsc(VecDestroy(&solution_));
  check_petsc(MatCreateVecs(matrix_, &solution_, &right_));
}

void PetscFactors::analyze() {
  MatDestroy(&factors_);
  MatFactorInfo info;
  check_petsc(MatFactorInfoInitialize(&info));
  const bool symmetric = kind_ == SparseKind::symmetric;
  check_petsc(
      MatGetFactor(matrix_, MATSOLVERMUMPS, symmetric ? MAT_FACTOR_CHOLESKY : MAT_FACTOR_LU, &factors_));
  check_petsc(symmetric ? MatCholeskyFactorSymbolic(factors_, matrix_, nullptr, &info)
                        : MatLUFactorSymbolic(factors_, matrix_, nullptr, nullptr, &info));
}

FactorOutcome PetscFactors::factor(const SparseMatrix* A, PetscInt size, SparseKind kind, bool analyzed) {
  constexpr PetscInt first_room = 20, most_room = 640;  // per cent beyond the estimate of the analysis
  constexpr PetscInt room_option = 14;                  // ICNTL(14)
  kind_ = kind;
  distribute(A, size);
  FactorOutcome outcome;
  for (PetscInt room = first_room; room <= most_room; room *= 2) {
    if (!analyzed || factors_ == nullptr) analyze();
    if (room > first_room) check_petsc(MatMumpsSetIcntl(factors_, room_option, room));
    MatFactorInfo info;
    check_petsc(MatFactorInfoInitialize(&info));
    check_petsc(kind == SparseKind::symmetric ? MatCholeskyFactorNumeric(factors_, matrix_, &info)
                                              : MatLUFactorNumeric(factors_, matrix_, &info));
    outcome = outcome_of(factors_);
    if (outcome.status == FactorOutcome::Status::done) return outcome;
    // Factors that have failed cannot be computed anew.
    MatDestroy(&factors_);
    const bool too_little_room = outcome.code == -8 || outcome.code == -9;
    if (!too_little_room) return outcome;
  }
  return outcome;
}

void PetscFactors::solve(double* b, bool transposed) const {
  const int own = counts_[static_cast<std::size_t>(rank_of_this())];
  PetscScalar* part = nullptr;
  check_petsc(VecGetArrayWrite(right_, &part));
  MPI_Scatterv(b, counts_.data(), begins_.data(), MPI_DOUBLE, part, own, MPI_DOUBLE, 0, PETSC_COMM_WORLD);
  check_petsc(VecRestoreArrayWrite(right_, &part));
  // PETSc holds A^T.
  check_petsc(transposed || kind_ == SparseKind::symmetric ? MatSolve(factors_, right_, solution_)
                                                           : MatSolveTranspose(factors_, right_, solution_));
  const PetscScalar* result = nullptr;
  check_petsc(VecGetArrayRead(solution_, &result));
  MPI_Gatherv(result, own, MPI_DOUBLE, b, counts_.data(), begins_.data(), MPI_DOUBLE, 0, PETSC_COMM_WORLD);
  check_petsc(VecRestoreArrayRead(solution_, &result));
}

FactorEstimate PetscFactors::estimate(const SparseMatrix* A, PetscInt size, SparseKind kind) {
  kind_ = kind;
  distribute(A, size);
  analyze();
  PetscReal operations = 0.0;
  check_petsc(MatMumpsGetRinfog(factors_, 1, &operations));
  return {entries(infog(factors_, 20)) * sizeof(double), operations, ""};
}

double PetscFactors::bytes() const {
  return factors_ == nullptr ? 0.0 : entries(infog(factors_, 29)) * sizeof(double);
}

}  // namespace eigentrail::app
