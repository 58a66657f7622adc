// The eigenvalues of a large sparse pencil that are nearest to a shift, with right and left vectors:
// Arnoldi's method with implicit restarts (Spectra) on the inverse of the shifted pencil, which is factored
// once.
#pragma once

#include <optional>

#include "core/sparse_factors.hpp"
#include "eigentrail/core/constraint_factorization.hpp"
#include "eigentrail/model/affine_family.hpp"

namespace eigentrail {

/// A few vectors side by side, n x k, stored row by row: a sparse matrix is read once for all of them.
using RowBlock = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// (M s^2 + C s + K) z + A^T mu = 0, A z = 0 at one place.
struct SparsePencil {
  SparseMatrix M, C, K;    ///< n x n
  bool symmetric = false;  ///< M, C and K are symmetric
  /// Left vectors span the same real space as right ones: M and K are symmetric, C is symmetric or skew.
  bool one_sided = false;
  SparseMatrix A = {};  ///< m x n, of full rank; 0 x 0 if there are no constraints
  std::shared_ptr<const ConstraintFactorization> constraints = {};  ///< of A; null if there are none

  Eigen::Index size() const { return K.rows(); }
  Eigen::Index freedoms() const { return K.rows() - A.rows(); }
  /// The parts of vectors, n x k, that the constraints allow; of forces, what constraint forces leave.
  ComplexMatrix allowed(const ComplexMatrix& vectors) const;
};

/// A shift on the real axis or on the imaginary one.
struct Shift {
  double real = 0.0;       ///< 1/s
  double frequency = 0.0;  ///< rad/s, >= 0; if positive, `real` is zero

  Complex value() const { return {real, frequency}; }
  bool operator==(const Shift&) const = default;
};

/// Which modes are looked for.
struct ModeRequest {
  Shift shift;
  int count = 1;       ///< about that many, nearest to the shift; a conjugate pair is one mode
  double cover = 0.0;  ///< all within this distance of the shift, as far as `most` modes reach
  int most = 0;        ///< a limit for `cover`
  std::optional<double> tolerance = std::nullopt;  ///< in place of that of the finder
  bool only_right = false;                         ///< left vectors are left out
};

/// The matrix that is factored for a real shift, and whether it is symmetric: P = M s^2 + C s + K, or with
/// constraints [P, S^T; S, 0] with S = A, rows scaled to the magnitude of P.
struct ShiftedMatrix {
  SparseMatrix matrix;
  SparseKind kind = SparseKind::general;
};
ShiftedMatrix shifted_matrix(const SparsePencil& pencil, const Shift& shift);

struct NearestModes {
  ComplexVector s;      ///< one of each conjugate pair, Im s >= 0; by distance from the shift
  ComplexMatrix right;  ///< n x k, unit columns
  ComplexMatrix left;   ///< n x k': unit vectors y with y^T P(s) = 0, in any order; empty if one-sided
  double radius = 0.0;  ///< all eigenvalues (Im s >= 0) closer to the shift than this are there
};

/// Finds modes near a shift, place by place; the symbolic analysis of the factorization is kept.
class ModeFinder {
 public:
  /// `tolerance`: relative accuracy of the eigenvalues of the inverse. `maker`: what factors.
  explicit ModeFinder(double tolerance, const SparseSolverMaker& maker = {})
      : tolerance_(tolerance), factors_(make_solver(maker)) {}

  /// The modes that a request asks for, possibly a few more. Factors the pencil once; a shift on an
  /// eigenvalue is moved, which takes a second factorization. Empty if the iteration does not converge.
  std::optional<NearestModes> find(const SparsePencil& pencil, const ModeRequest& request);

  /// Adds the left vectors of the modes that were found last, of the same pencil, with the factors that are
  /// at hand. Does nothing if the pencil is one-sided. False if the iteration does not converge. `tolerance`:
  /// relative accuracy of the eigenvalues of the inverse.
  bool add_left(const SparsePencil& pencil, double tolerance, NearestModes& modes);

  int factorizations() const { return factorizations_; }
  long solutions() const { return solutions_; }
  std::size_t peak_bytes() const { return peak_bytes_; }  ///< of the factors
  std::string method() const { return factors_->method(); }

 private:
  bool factor(const SparsePencil& pencil, const Shift& shift);

  /// A shift that lay on an eigenvalue, and the one that was used instead. The next place of the path begins
  /// with that one: rigid-body motions, for example, are there everywhere.
  struct MovedShift {
    Shift requested, used;
    bool beside_singular = false;  ///< the matrix could not be factored at the requested shift
  };

  /// How modes were found last.
  struct LastSearch {
    Shift shift;
    int wanted = 0;  ///< eigenvalues of the inverse
    double scale = 1.0;
  };

  double tolerance_;
  std::optional<MovedShift> moved_;
  LastSearch last_;
  std::unique_ptr<SparseSolver> factors_;
  int factorizations_ = 0;
  long solutions_ = 0;
  std::size_t peak_bytes_ = 0;
};

}  // namespace eigentrail
