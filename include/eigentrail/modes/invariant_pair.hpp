// Invariant pairs (Z, Lambda) of the reduced pencil: one mode, or several close modes followed as a block.
//
//     M Z Lambda^2 + C Z Lambda + K Z = 0,     W0^H Z + W1^H Z Lambda = I
//
// (Betcke & Kressner, Linear Algebra Appl. 435, 2011). The eigenvalues of Lambda are eigenvalues of the
// pencil. Single eigenvalues lose half of their digits where they coalesce. The pair stays a smooth function
// of the parameter as long as the block as a whole is separated from the other modes. A block of one mode is
// an ordinary eigenpair; its equations are Eqs. 32 and 35 of the seed paper.
//
// With Lambda in Schur form, the linearized equations become one bordered system of size n + k per column.
// Its LU is computed once per point, at the predicted pair. It serves the Newton corrections, the condition
// numbers and all orders of the sensitivities. Because the factors belong to the predicted pair, solutions
// are refined with residuals of the exact matrices.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "eigentrail/core/complex_lu.hpp"
#include "eigentrail/modes/pencil_at_point.hpp"
#include "eigentrail/reduction/complex_blocks.hpp"

namespace eigentrail {

class BorderedBand;

struct CorrectorOptions {
  double tolerance = 1e-14;  ///< stop when the last correction is below this, relative; > 0
  /// Ratio of two corrections above which the equations are factored again, 0 < . < 1.
  double refactor_contraction = 0.1;
  int max_iterations = 30;         ///< >= 1
  double series_accuracy = 1e-15;  ///< relative accuracy of every coefficient of the series of a single mode
};

/// Work done on modes, summed over a run.
struct ModeCounts {
  std::uint64_t factorizations = 0;  ///< LU of size n + k, in real numbers if the equations are real
  std::uint64_t iterations = 0;      ///< Newton corrections
  std::uint64_t solves = 0;          ///< back-substitutions for all purposes
  /// modal bases that serve all modes at once (all_pairs.hpp, symmetric_pairs.hpp)
  std::uint64_t modal_bases = 0;
  std::uint64_t modal_solves = 0;  ///< solutions for all modes at once with these bases

  ModeCounts& operator+=(const ModeCounts& other);
};

/// LU factors of a bordered matrix with n + k rows. In a complex part (complex_blocks.hpp) it is restricted
/// to the n / 2 dimensions of its vectors: the solution is the inverse there, and what is beside them is
/// dropped. Where the pencil is banded, so are the factors.
class BorderedLu {
 public:
  /// Factors [P, X; Y, D]: `pencil` at mu, n x n, the columns X (n x k), the rows Y (k x n) and D (k x k).
  /// The columns of Z (n x k) span about the vectors for which P is singular.
  BorderedLu(const PencilAtPoint& pencil, Complex mu, const ComplexMatrix& Z, const ComplexMatrix& X,
             const ComplexMatrix& Y, const ComplexMatrix& D);

  Eigen::Index size() const { return n_ + k_; }
  /// Overwrites the columns of B, of n + k rows, with the solutions, or with those of the adjoint equations.
  void solve_in_place(Eigen::Ref<ComplexMatrix> B) const;
  void solve_adjoint_in_place(Eigen::Ref<ComplexMatrix> B) const;

 private:
  template <class Solve>
  void solve(Eigen::Ref<ComplexMatrix> B, const Solve& by_factors) const;
  ComplexMatrix restricted(const ComplexMatrix& b) const;

  Eigen::Index n_, k_;
  int complex_sign_;
  std::shared_ptr<const BorderedBand> banded_;  ///< null where the pencil is not banded
  std::optional<ComplexLu> lu_;                 ///< empty where it is
};

/// How much Lambda of a pair changes, as bounds of |dLambda| in the Frobenius norm.
struct PairSensitivity {
  double to_residual = 0.0;  ///< by a residual R: |dLambda| / |R|
  double to_terms = 0.0;     ///< by a residual whose rows are at most as large as the entries of given terms
};

/// LU factors of the linearized equations at an invariant pair.
class PairFactorization {
 public:
  /// W = [W0; W1] is 2n x k. Cost: k LU factorizations of size n + k.
  PairFactorization(const PencilAtPoint& pencil, const ComplexMatrix& Z, const ComplexMatrix& Lambda,
                    const ComplexMatrix& W);

  /// Solves for the change (dZ, dLambda) that changes the residual by R (n x k) and the normalization by N (k
  /// x k), to first order.
  void solve(const ComplexMatrix& R, const ComplexMatrix& N, ComplexMatrix& dZ, ComplexMatrix& dLambda) const;

  /// The same on every column of B: overwrites (R, N), stored column by column, with (dZ, dLambda). All
  /// together take less time than one by one.
  void solve_in_place(Eigen::Ref<ComplexMatrix> B) const;
  /// Applies the adjoint of the linear map of solve_in_place.
  void solve_adjoint_in_place(Eigen::Ref<ComplexMatrix> B) const;

  /// Of the block as a whole. `terms`: n numbers, >= 0.
  PairSensitivity sensitivity(const Vector& terms) const;

 private:
  /// Data that couple the columns of a block of several modes: Lambda = U T U^H, T2 = T^2, Z U and W1 U.
  struct Coupling {
    Matrix M, C;  ///< empty where there are bands
    PencilBands bands;
    ComplexMatrix U, T, T2, Z, W1;
  };

  /// A single mode with z real up to a phase, and with s real, or imaginary in an undamped pencil: its
  /// equations are real.
  struct RealMode {
    RealLu lu;
    Complex phase;      ///< phase of z
    Complex direction;  ///< direction of s in the complex plane: 1 or i
  };

  /// Factors the real form of the equations of a single mode. Returns false if they are not real.
  bool factor_real(const PencilAtPoint& pencil, const ComplexVector& z, Complex s, const ComplexVector& w,
                   const ComplexVector& slope);
  /// Columns of right sides of a block, in the basis of its Schur form: for each column j of the block those
  /// of X (n x m) and of Y (k x m), one after the other.
  struct InSchurForm {
    ComplexMatrix X, Y;
  };
  InSchurForm in_schur_form(const Eigen::Ref<const ComplexMatrix>& B) const;
  /// Overwrites B.
  void from_schur_form(const InSchurForm& columns, Eigen::Ref<ComplexMatrix> B) const;
  void solve_block(Eigen::Ref<ComplexMatrix> B) const;
  void solve_block_adjoint(Eigen::Ref<ComplexMatrix> B) const;

  std::optional<Coupling> coupling_;
  std::optional<RealMode> real_;
  std::vector<BorderedLu> columns_;
  double slope_scale_, border_scale_;
};

/// Outcome of a correction; `singular` means that a number is not finite.
enum class PairStatus { converged, not_converged, singular };

struct InvariantPair {
  PairStatus status = PairStatus::not_converged;
  Chart chart = Chart::finite;
  int part = 0;          ///< of the reduced equations, where they fall apart (ReducedPencil::of)
  bool is_real = false;  ///< real Z and Lambda; the eigenvalues of the block are closed under conjugation
  ComplexMatrix Z = {};  ///< n x k
  ComplexMatrix Lambda = {};    ///< k x k
  ComplexMatrix W = {};         ///< 2n x k, normalization
  double backward_error = 0.0;  ///< |residual| / (magnitude |Z|), see PencilAtPoint::magnitude
  double condition = 0.0;  ///< relative condition number of the block, with respect to max(|mu|, reference)
  /// Bound of the change of Lambda where every entry of the matrices changes by a rounding error of 2.2e-16
  /// of its magnitude: eps |y|^T (|mu|^2 |M| + |mu| |C| + |K|) |z| / |y^H P' z| for one mode.
  double rounding = 0.0;
  std::shared_ptr<const PairFactorization> factors = {};  ///< null if the pair was not corrected by itself

  Eigen::Index size() const { return Lambda.rows(); }
  /// The eigenvalue (s, or 1/s in the reciprocal chart) of a block of one mode.
  Complex eigenvalue() const { return Lambda(0, 0); }
};

/// Changes the basis of a pair so that [Z; Z Lambda / gamma] has orthonormal columns, from which the
/// normalization W is formed. gamma = max(|Lambda| / sqrt(k / 2), reference) balances the two halves;
/// `reference` keeps eigenvalues that count as zero from making the lower half dominant. Where the columns of
/// Z are independent by themselves, W1 = 0 and they are orthonormal; for a block of one mode |z| = 1. The
/// eigenvalues of Lambda do not change.
void normalize_pair(ComplexMatrix& Z, ComplexMatrix& Lambda, ComplexMatrix& W, double reference);

/// Sets entries to zero that are what Newton's method leaves of one: each correction is about the square of
/// the one before, and the last one was not larger than the tolerance. Of 1/s what is below the tolerance
/// itself: such an s is farther beyond what counts as infinite than any number tells.
void remove_remnants(Chart chart, double reference, double tolerance, ComplexMatrix& Lambda);

/// Refines a pair by the chord-Newton method. `reference` > 0 is the magnitude below which an eigenvalue (1/s
/// in the reciprocal chart) counts as zero. Of `start` only Z, Lambda, chart and is_real are used.
InvariantPair correct_pair(const PencilAtPoint& pencil, const InvariantPair& start, double reference,
                           const CorrectorOptions& options, ModeCounts& counts);

/// Sets backward error, condition and rounding of a pair. `residual`: norm of that of the pair; `reference`:
/// as above.
void settle_accuracy(const PencilAtPoint& pencil, double residual, const PairSensitivity& sensitivity,
                     double reference, InvariantPair& pair);

/// The factors of the pair, or new factors at the pair if it has none.
std::shared_ptr<const PairFactorization> factors_of(const PencilAtPoint& pencil, const InvariantPair& pair);

/// Rounding error of the eigenvalue of a block of one mode: the Newton correction whose residual is formed in
/// extended precision (long double). It gives the small real part of an eigenvalue near the imaginary axis to
/// its own digits.
Complex eigenvalue_remainder(const PencilAtPoint& pencil, const InvariantPair& pair);

/// Power series of an invariant pair along the path.
struct PairSeries {
  std::vector<ComplexMatrix> Z;       ///< order + 1 coefficients, n x k
  std::vector<ComplexMatrix> Lambda;  ///< order + 1 coefficients, k x k
};

/// Power series of an invariant pair up to h^order. The right side for coefficient j is coefficient j of the
/// equations formed with Z_j = Lambda_j = 0 (Eq. 35 for one mode and j = 1). `accuracy` is the relative
/// accuracy of every coefficient of a single mode; series of blocks are refined to the rounding level.
PairSeries differentiate_pair(const ReducedPencil& pencil, const InvariantPair& pair, int order,
                              ModeCounts& counts, double accuracy = 1e-15);

}  // namespace eigentrail
