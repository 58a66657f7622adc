// Processes that factor together: the first one sends a command before each step that all make, the others
// wait for it.
//
// Between two commands only the first process works, and an error in it ends the others in order. Within a
// step all processes exchange messages, and an error in one of them ends all at once.
#include <mpi.h>
#include <petscsys.h>
#include <sched.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "commands.hpp"
#include "factor_team.hpp"
#include "launcher.hpp"
#include "mpi_session.hpp"
#include "petsc_factors.hpp"

namespace eigentrail::app {
namespace {

enum class Step : std::int64_t { factor, solve, estimate, forget, stop };

/// What the first process tells the others.
struct Command {
  Step step = Step::stop;
  std::int64_t solver = 0;  ///< number of the factors
  std::int64_t size = 0;
  SparseKind kind = SparseKind::general;  ///< factor, estimate
  bool analyzed = false;                  ///< factor
  bool transposed = false;                ///< solve
};

/// Waits for the next command. It leaves the core to others: right away where other processes wait for it as
/// well, and by sleeping when the first process has been busy for longer.
Command receive() {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds short_wait{2};
  constexpr std::chrono::microseconds sleep{500};
  Command command;
  MPI_Request request{};
  MPI_Ibcast(&command, sizeof command, MPI_BYTE, 0, MPI_COMM_WORLD, &request);
  const auto begin = Clock::now();
  int complete = 0;
  while (MPI_Test(&request, &complete, MPI_STATUS_IGNORE), complete == 0) {
    if (Clock::now() - begin < short_wait) {
      sched_yield();
    } else {
      std::this_thread::sleep_for(sleep);
    }
  }
  return command;
}

void send(Command command) {
  MPI_Request request{};
  MPI_Ibcast(&command, sizeof command, MPI_BYTE, 0, MPI_COMM_WORLD, &request);
  MPI_Wait(&request, MPI_STATUS_IGNORE);
}

/// A step of all processes: after an error in it the others would wait for this one for ever.
template <class Work>
auto all_or_none(Work&& work) {
  try {
    return work();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "eigentrail: a process that factors with others has failed: %s\n", error.what());
    std::fflush(stderr);
    MPI_Abort(MPI_COMM_WORLD, numbers_failed);
    throw;
  }
}

/// The factors of every solver, by its number; the same in all processes.
using AllFactors = std::map<std::int64_t, PetscFactors>;

/// What the processes beside the first one do.
void serve(AllFactors& factors) {
  while (true) {
    const Command command = receive();
    const auto size = static_cast<PetscInt>(command.size);
    switch (command.step) {
      case Step::factor:
        factors[command.solver].factor(nullptr, size, command.kind, command.analyzed);
        break;
      case Step::solve:
        factors[command.solver].solve(nullptr, command.transposed);
        break;
      case Step::estimate:
        (void)factors[command.solver].estimate(nullptr, size, command.kind);
        break;
      case Step::forget:
        factors.erase(command.solver);
        break;
      case Step::stop:
        return;
    }
  }
}

/// A complex matrix as a real one of twice the size: each entry a + ib is [a -b; b a]. A complex vector in
/// memory, real and imaginary parts in turn, is the vector of the real system.
SparseMatrix as_real(const ComplexSparseMatrix& A) {
  SparseMatrix real(2 * A.rows(), 2 * A.cols());
  real.reserve(4 * A.nonZeros());
  for (Eigen::Index j = 0; j < A.cols(); ++j) {
    for (const bool imaginary : {false, true}) {
      const Eigen::Index column = 2 * j + (imaginary ? 1 : 0);
      real.startVec(column);
      for (ComplexSparseMatrix::InnerIterator it(A, j); it; ++it) {
        const double a = it.value().real(), b = it.value().imag();
        real.insertBack(2 * it.row(), column) = imaginary ? -b : a;
        real.insertBack(2 * it.row() + 1, column) = imaginary ? a : b;
      }
    }
  }
  real.finalize();
  return real;
}

/// The solver of the first process.
class PetscSolver final : public SparseSolver {
 public:
  PetscSolver(AllFactors& factors, std::int64_t number, int processes)
      : all_(factors), number_(number), processes_(processes) {}
  ~PetscSolver() override {
    send({.step = Step::forget, .solver = number_});
    all_.erase(number_);
  }

  bool factor(const SparseMatrix& A, SparseKind kind) override {
    complex_ = false;
    return factor_real(A, kind);
  }
  bool factor(const ComplexSparseMatrix& A) override {
    complex_ = true;
    return factor_real(as_real(A), SparseKind::general);
  }

  Matrix solve(const Matrix& B) const override { return solve_columns(B, false); }
  Matrix solve_transposed(const Matrix& B) const override { return solve_columns(B, true); }
  ComplexVector solve(const ComplexVector& b) const override {
    if (!complex_) return solve_parts(b, false);
    ComplexVector x = b;
    solve_in_place(reinterpret_cast<double*>(x.data()), false);  // NOLINT: pairs of numbers
    return x;
  }
  ComplexVector solve_transposed(const ComplexVector& b) const override {
    if (!complex_) return solve_parts(b, true);
    // The transpose of the real system is that of the conjugate transpose.
    ComplexVector x = b.conjugate();
    solve_in_place(reinterpret_cast<double*>(x.data()), true);  // NOLINT: pairs of numbers
    return x.conjugate();
  }

  bool is_complex() const override { return complex_; }
  std::size_t bytes() const override { return bytes_; }
  std::string method() const override { return method_of(kind_); }

  FactorEstimate estimate(const SparseMatrix& A, SparseKind kind) const override {
    const PetscSolver apart(all_, -1, processes_);  // its factors are forgotten
    send({.step = Step::estimate, .solver = apart.number_, .size = A.rows(), .kind = kind});
    FactorEstimate estimate =
        all_or_none([&] { return all_[apart.number_].estimate(&A, static_cast<PetscInt>(A.rows()), kind); });
    estimate.method = method_of(kind);
    return estimate;
  }

 private:
  bool factor_real(const SparseMatrix& A, SparseKind kind) {
    const bool analyzed = take_pattern(A) && kind == kind_;
    kind_ = kind;
    send({.step = Step::factor, .solver = number_, .size = A.rows(), .kind = kind, .analyzed = analyzed});
    const FactorOutcome outcome = all_or_none([&] {
      PetscFactors& factors = all_[number_];
      const FactorOutcome result = factors.factor(&A, static_cast<PetscInt>(A.rows()), kind, analyzed);
      bytes_ = static_cast<std::size_t>(factors.bytes());
      return result;
    });
    if (outcome.status == FactorOutcome::Status::no_memory) throw std::bad_alloc();
    if (outcome.status == FactorOutcome::Status::failed)
      throw std::runtime_error("MUMPS: factorization failed with INFOG(1) = " + std::to_string(outcome.code));
    return outcome.status == FactorOutcome::Status::done;
  }

  /// Whether the pattern is that of the matrix before.
  bool take_pattern(const SparseMatrix& A) {
    std::vector<int> starts(A.outerIndexPtr(), A.outerIndexPtr() + A.cols() + 1);
    std::vector<int> rows(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros());
    const bool same = starts == starts_ && rows == rows_;
    starts_ = std::move(starts);
    rows_ = std::move(rows);
    return same;
  }

  void solve_in_place(double* b, bool transposed) const {
    send({.step = Step::solve, .solver = number_, .transposed = transposed});
    all_or_none([&] { all_.at(number_).solve(b, transposed); });
  }
  Matrix solve_columns(Matrix X, bool transposed) const {
    for (Eigen::Index j = 0; j < X.cols(); ++j) solve_in_place(X.col(j).data(), transposed);
    return X;
  }
  ComplexVector solve_parts(const ComplexVector& b, bool transposed) const {
    Matrix parts(b.size(), 2);
    parts << b.real(), b.imag();
    parts = solve_columns(std::move(parts), transposed);
    return parts.col(0).cast<Complex>() + Complex(0.0, 1.0) * parts.col(1).cast<Complex>();
  }

  std::string method_of(SparseKind kind) const {
    return std::string(kind == SparseKind::symmetric ? "LDL^T" : "LU") + " (MUMPS through PETSc, " +
           std::to_string(processes_) + (processes_ == 1 ? " process)" : " processes)");
  }

  AllFactors& all_;
  std::int64_t number_;
  int processes_;
  bool complex_ = false;
  SparseKind kind_ = SparseKind::general;
  std::vector<int> starts_, rows_;
  std::size_t bytes_ = 0;
};

/// MPI and PETSc between their beginning and their end; PETSc ends first. Signals end the program as they do
/// without PETSc, and options are not read from files.
class Session : public MpiSession {
 public:
  Session() : MpiSession(MPI_THREAD_FUNNELED) {
    PetscOptionsSetValue(nullptr, "-no_signal_handler", "true");
    PetscOptionsSetValue(nullptr, "-skip_petscrc", "true");
    check_petsc(PetscInitializeNoArguments());
    check_petsc(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));
  }
  ~Session() { PetscFinalize(); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
};

/// Ends the other processes when the first one comes to its end, also by an error.
struct Stop {
  Stop() = default;
  ~Stop() { send({.step = Step::stop}); }
  Stop(const Stop&) = delete;
  Stop& operator=(const Stop&) = delete;
};

}  // namespace

int factoring_together(const std::function<int(const SparseSolverMaker&)>& command) {
  if (!launched()) return command({});
  const Session session;
  AllFactors factors;
  if (!session.leads()) {
    all_or_none([&] { serve(factors); });
    return done;
  }
  const Stop stop;
  std::int64_t number = 0;
  return command([&] { return std::make_unique<PetscSolver>(factors, number++, session.size()); });
}

}  // namespace eigentrail::app
