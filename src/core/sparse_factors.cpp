#include "core/sparse_factors.hpp"

#include <cholmod.h>
#include <umfpack.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>
#include <vector>

namespace eigentrail {
namespace suitesparse {

using Index = SuiteSparse_long;

/// Rows and columns of a compressed matrix as SuiteSparse wants them.
struct Pattern {
  std::vector<Index> starts, rows;

  template <class Sparse>
  explicit Pattern(const Sparse& A)
      : starts(A.outerIndexPtr(), A.outerIndexPtr() + A.cols() + 1),
        rows(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros()) {}
  Pattern() = default;

  Index size() const { return static_cast<Index>(starts.size()) - 1; }
  bool operator==(const Pattern&) const = default;
};

[[noreturn]] void fail(const char* library, const char* stage, Index code) {
  throw std::runtime_error(std::string(library) + ": " + stage + " failed with code " + std::to_string(code));
}

void check_umfpack(const char* stage, Index code) {
  if (code == UMFPACK_ERROR_out_of_memory) throw std::bad_alloc();
  if (code < 0) fail("UMFPACK", stage, code);
}

/// LU factors by UMFPACK, of a real or a complex matrix.
class Lu {
 public:
  explicit Lu(bool is_complex) : complex_(is_complex) {
    if (complex_) {
      umfpack_zl_defaults(control_);
    } else {
      umfpack_dl_defaults(control_);
    }
    control_[UMFPACK_ORDERING] = UMFPACK_ORDERING_CHOLMOD;  // AMD, and METIS where AMD fills much
    control_[UMFPACK_IRSTEP] = 0;                           // the caller looks at residuals
  }
  ~Lu() {
    free_numeric();
    free_symbolic();
  }
  Lu(const Lu&) = delete;
  Lu& operator=(const Lu&) = delete;

  bool is_complex() const { return complex_; }

  /// Whether A + A^T is ordered, and not A^T A, which one full row fills. By default UMFPACK chooses.
  void order_symmetrically(bool symmetrically) {
    const double strategy = symmetrically ? UMFPACK_STRATEGY_SYMMETRIC : UMFPACK_STRATEGY_AUTO;
    if (control_[UMFPACK_STRATEGY] != strategy) free_symbolic();
    control_[UMFPACK_STRATEGY] = strategy;
  }

  /// Symbolic analysis; upper bounds, for all choices of pivots, of the bytes of the factors and of the
  /// operations.
  std::pair<double, double> analyze(const Pattern& pattern, const double* values) {
    free_symbolic();
    const Index n = pattern.size();
    const Index *starts = pattern.starts.data(), *rows = pattern.rows.data();
    const Index code =
        complex_ ? umfpack_zl_symbolic(n, n, starts, rows, values, nullptr, &symbolic_, control_, info_)
                 : umfpack_dl_symbolic(n, n, starts, rows, values, &symbolic_, control_, info_);
    check_umfpack("symbolic analysis", code);
    return {info_[UMFPACK_NUMERIC_SIZE_ESTIMATE] * info_[UMFPACK_SIZE_OF_UNIT],
            info_[UMFPACK_FLOPS_ESTIMATE]};
  }

  /// `values`: real numbers, or pairs of real and imaginary part.
  bool factor(const Pattern& pattern, bool analyzed, std::vector<double> values) {
    free_numeric();
    values_ = std::move(values);
    const Index *starts = pattern.starts.data(), *rows = pattern.rows.data();
    if (!analyzed || symbolic_ == nullptr) analyze(pattern, values_.data());
    const Index code =
        complex_
            ? umfpack_zl_numeric(starts, rows, values_.data(), nullptr, symbolic_, &numeric_, control_, info_)
            : umfpack_dl_numeric(starts, rows, values_.data(), symbolic_, &numeric_, control_, info_);
    check_umfpack("factorization", code);
    bytes_ = static_cast<std::size_t>(info_[UMFPACK_NUMERIC_SIZE] * info_[UMFPACK_SIZE_OF_UNIT]);
    return code != UMFPACK_WARNING_singular_matrix;
  }

  void solve(const Pattern& pattern, bool transposed, const double* b, double* x) const {
    const Index *starts = pattern.starts.data(), *rows = pattern.rows.data();
    const Index system = transposed ? UMFPACK_Aat : UMFPACK_A;
    double info[UMFPACK_INFO];
    const Index code =
        complex_ ? umfpack_zl_solve(system, starts, rows, values_.data(), nullptr, x, nullptr, b, nullptr,
                                    numeric_, control_, info)
                 : umfpack_dl_solve(system, starts, rows, values_.data(), x, b, numeric_, control_, info);
    check_umfpack("solution", code);
  }

  /// Of a real matrix.
  LogDeterminant determinant() const {
    double mantissa = 0.0, exponent = 0.0, info[UMFPACK_INFO];
    check_umfpack("determinant", umfpack_dl_get_determinant(&mantissa, &exponent, numeric_, info));
    if (mantissa == 0.0) return {};
    return {mantissa > 0.0 ? 1.0 : -1.0, std::log(std::abs(mantissa)) + exponent * std::log(10.0)};
  }

  std::size_t bytes() const { return bytes_; }

 private:
  void free_numeric() {
    if (numeric_ != nullptr)
      complex_ ? umfpack_zl_free_numeric(&numeric_) : umfpack_dl_free_numeric(&numeric_);
    numeric_ = nullptr;
  }
  void free_symbolic() {
    if (symbolic_ != nullptr)
      complex_ ? umfpack_zl_free_symbolic(&symbolic_) : umfpack_dl_free_symbolic(&symbolic_);
    symbolic_ = nullptr;
  }

  bool complex_;
  double control_[UMFPACK_CONTROL] = {};
  double info_[UMFPACK_INFO] = {};
  void* symbolic_ = nullptr;
  void* numeric_ = nullptr;
  std::vector<double> values_;
  std::size_t bytes_ = 0;
};

/// Cholesky factors by CHOLMOD, of a symmetric matrix whose lower triangle is used.
class Cholesky {
 public:
  Cholesky() {
    cholmod_l_start(&common_);
    common_.print = 0;
    common_.quick_return_if_not_posdef = 1;
    // L L^T. The default of small matrices, L D L^T without pivoting, takes indefinite ones and loses digits.
    common_.final_ll = 1;
  }
  ~Cholesky() {
    if (factor_ != nullptr) cholmod_l_free_factor(&factor_, &common_);
    cholmod_l_finish(&common_);
  }
  Cholesky(const Cholesky&) = delete;
  Cholesky& operator=(const Cholesky&) = delete;

  /// Symbolic analysis; entries of the factor and operations.
  std::pair<double, double> analyze(Pattern& pattern, const SparseMatrix& A) {
    cholmod_sparse matrix = view(pattern, A);
    if (factor_ != nullptr) cholmod_l_free_factor(&factor_, &common_);
    factor_ = cholmod_l_analyze(&matrix, &common_);
    check_status("symbolic analysis");
    return {common_.lnz, common_.fl};
  }

  /// Whether the matrix is positive definite and could be factored.
  bool factor(Pattern& pattern, bool analyzed, const SparseMatrix& A) {
    if (!analyzed || factor_ == nullptr) analyze(pattern, A);
    cholmod_sparse matrix = view(pattern, A);
    cholmod_l_factorize(&matrix, factor_, &common_);
    check_status("factorization");
    return common_.status == CHOLMOD_OK && factor_->minor == factor_->n;
  }

  Matrix solve(const Matrix& B) const {
    cholmod_dense right{};
    right.nrow = right.d = static_cast<std::size_t>(B.rows());
    right.ncol = static_cast<std::size_t>(B.cols());
    right.nzmax = static_cast<std::size_t>(B.size());
    right.x = const_cast<double*>(B.data());  // NOLINT: CHOLMOD does not write to it
    right.xtype = CHOLMOD_REAL;
    right.dtype = CHOLMOD_DOUBLE;
    cholmod_dense* solution = cholmod_l_solve(CHOLMOD_A, factor_, &right, &common_);
    if (solution == nullptr) throw std::bad_alloc();
    Matrix X = Eigen::Map<const Matrix>(static_cast<const double*>(solution->x), B.rows(), B.cols());
    cholmod_l_free_dense(&solution, &common_);
    return X;
  }

  std::size_t bytes() const {
    const auto entries = factor_->is_super != 0 ? factor_->xsize : factor_->nzmax;
    return static_cast<std::size_t>(entries) * sizeof(double);
  }

 private:
  static cholmod_sparse view(Pattern& pattern, const SparseMatrix& A) {
    cholmod_sparse matrix{};
    matrix.nrow = matrix.ncol = static_cast<std::size_t>(A.cols());
    matrix.nzmax = pattern.rows.size();
    matrix.p = pattern.starts.data();
    matrix.i = pattern.rows.data();
    matrix.x = const_cast<double*>(A.valuePtr());  // NOLINT: CHOLMOD does not write to it
    matrix.stype = -1;
    matrix.itype = CHOLMOD_LONG;
    matrix.xtype = CHOLMOD_REAL;
    matrix.dtype = CHOLMOD_DOUBLE;
    matrix.sorted = 1;
    matrix.packed = 1;
    return matrix;
  }

  void check_status(const char* stage) const {
    if (common_.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
    if (factor_ == nullptr || common_.status < 0) fail("CHOLMOD", stage, common_.status);
  }

  mutable cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
};

template <class Sparse>
const Sparse& compressed(const Sparse& A) {
  if (!A.isCompressed()) throw std::invalid_argument("SparseFactors: expected a compressed matrix");
  return A;
}

constexpr const char* cholesky_name = "Cholesky (CHOLMOD)";
constexpr const char* lu_name = "LU (UMFPACK)";

}  // namespace suitesparse

using namespace suitesparse;

FactorEstimate SparseFactors::estimate(const SparseMatrix& A, SparseKind kind) const {
  Pattern pattern(compressed(A));
  if (kind == SparseKind::symmetric) {
    const auto [entries, operations] = Cholesky().analyze(pattern, A);
    return {entries * sizeof(double), operations, cholesky_name};
  }
  // UMFPACK's own estimate bounds the fill of all choices of pivots, and is ten to a hundred times what
  // nearly symmetric patterns need: with their pivots on the diagonal L and U fill as the Cholesky factor of
  // A + A^T.
  const auto [bound, bounding_operations] = Lu(false).analyze(pattern, A.valuePtr());
  SparseMatrix symmetric = A + SparseMatrix(A.transpose());
  symmetric.makeCompressed();
  Pattern symmetric_pattern(symmetric);
  const auto [entries, operations] = Cholesky().analyze(symmetric_pattern, symmetric);
  return {std::min(bound, 2.0 * entries * sizeof(double)), std::min(bounding_operations, 2.0 * operations),
          lu_name};
}

struct SparseFactors::Implementation {
  Pattern pattern;
  std::unique_ptr<Cholesky> cholesky;
  std::unique_ptr<Lu> lu;

  /// Whether the pattern is that of the matrix before.
  template <class Sparse>
  bool take_pattern(const Sparse& A) {
    Pattern next(compressed(A));
    if (next == pattern) return true;
    pattern = std::move(next);
    return false;
  }

  bool factor_lu(bool same, bool is_complex, std::vector<double> values,
                 SparseKind kind = SparseKind::general) {
    cholesky.reset();
    if (!lu || lu->is_complex() != is_complex) lu = std::make_unique<Lu>(is_complex);
    lu->order_symmetrically(kind == SparseKind::near_symmetric);
    return lu->factor(pattern, same, std::move(values));
  }

  Matrix solve(bool transposed, const Matrix& B) const {
    if (cholesky) return cholesky->solve(B);
    Matrix X(B.rows(), B.cols());
    for (Eigen::Index j = 0; j < B.cols(); ++j)
      lu->solve(pattern, transposed, B.col(j).data(), X.col(j).data());
    return X;
  }

  /// With real factors both parts of b are solved for, with complex ones b itself.
  ComplexVector solve(bool transposed, const ComplexVector& b) const {
    if (lu && lu->is_complex()) {
      ComplexVector x(b.size());
      lu->solve(pattern, transposed, reinterpret_cast<const double*>(b.data()),  // NOLINT: packed pairs
                reinterpret_cast<double*>(x.data()));                            // NOLINT
      return x;
    }
    Matrix parts(b.size(), 2);
    parts << b.real(), b.imag();
    const Matrix x = solve(transposed, parts);
    return x.col(0).cast<Complex>() + Complex(0.0, 1.0) * x.col(1).cast<Complex>();
  }
};

SparseFactors::SparseFactors() : implementation_(std::make_unique<Implementation>()) {}
SparseFactors::~SparseFactors() = default;

std::unique_ptr<SparseSolver> make_solver(const SparseSolverMaker& maker) {
  return maker ? maker() : std::make_unique<SparseFactors>();
}

bool SparseFactors::factor(const SparseMatrix& A, SparseKind kind) {
  Implementation& i = *implementation_;
  const bool same = i.take_pattern(A);
  if (kind == SparseKind::symmetric) {
    i.lu.reset();
    if (!i.cholesky) i.cholesky = std::make_unique<Cholesky>();
    if (i.cholesky->factor(i.pattern, same, A)) return true;
  }
  return i.factor_lu(same, false, {A.valuePtr(), A.valuePtr() + A.nonZeros()}, kind);
}

bool SparseFactors::factor(const ComplexSparseMatrix& A) {
  const bool same = implementation_->take_pattern(A);
  const auto* values = reinterpret_cast<const double*>(A.valuePtr());  // NOLINT: packed pairs
  return implementation_->factor_lu(same, true, {values, values + 2 * A.nonZeros()});
}

Matrix SparseFactors::solve(const Matrix& B) const {
  return implementation_->solve(false, B);
}

Matrix SparseFactors::solve_transposed(const Matrix& B) const {
  return implementation_->solve(true, B);
}

ComplexVector SparseFactors::solve(const ComplexVector& b) const {
  return implementation_->solve(false, b);
}

ComplexVector SparseFactors::solve_transposed(const ComplexVector& b) const {
  return implementation_->solve(true, b);
}

bool SparseFactors::is_complex() const {
  return implementation_->lu && implementation_->lu->is_complex();
}

std::size_t SparseFactors::bytes() const {
  const Implementation& i = *implementation_;
  return i.cholesky ? i.cholesky->bytes() : i.lu->bytes();
}

LogDeterminant SparseFactors::determinant() const {
  const Lu* lu = implementation_->lu.get();
  if (lu == nullptr || lu->is_complex())
    throw std::logic_error("SparseFactors: expected a real matrix, not factored as a symmetric one");
  return lu->determinant();
}

std::string SparseFactors::method() const {
  return implementation_->cholesky ? cholesky_name : lu_name;
}

}  // namespace eigentrail
