// Invariant pairs (Z, Lambda) of the reduced pencil: one mode, or several close ones followed as a block.
//
//     M Z Lambda^2 + C Z Lambda + K Z = 0,     W0^H Z + W1^H Z Lambda = I
//
// (Betcke & Kressner, Linear Algebra Appl. 435, 2011). The eigenvalues of Lambda are eigenvalues of the
// pencil. While single eigenvalues lose half their digits where they meet, the pair stays a smooth function
// of the parameter as long as the block as a whole keeps its distance from the other modes. A block of one is
// an ordinary eigenpair; its equations are those of the seed paper, Eqs. 32 and 35.
//
// With Lambda brought to Schur form the linearized equations fall apart into one bordered system of size n +
// k per column. Its LU is computed once per point, at the predicted pair, and serves the Newton corrections,
// the conditions and every order of the sensitivities; residual correction with the exact matrices makes up
// for the factors belonging to the prediction.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "eigentrail/core/complex_lu.hpp"
#include "eigentrail/core/real_lu.hpp"
#include "eigentrail/modes/pencil_at_point.hpp"

namespace eigentrail {

struct CorrectorOptions {
  double tolerance = 1e-14;           ///< relative size of the last correction, > 0
  double refactor_contraction = 0.1;  ///< a slower contraction of the corrections factors anew, 0 < . < 1
  int max_iterations = 30;            ///< >= 1
  double passing_error = 0.0;         ///< relative error below which a continued mode is not corrected, >= 0
  double series_accuracy = 1e-15;     ///< of every coefficient of the series of a single mode, relative
};

/// Work done on modes, summed over a run.
struct ModeCounts {
  std::uint64_t factorizations = 0;  ///< LU of size n + k, real where the equations are
  std::uint64_t iterations = 0;      ///< Newton corrections
  std::uint64_t solves = 0;          ///< back-substitutions, all purposes
  std::uint64_t passed = 0;          ///< modes that needed no correction
  /// Bases that serve all modes at once (all_pairs.hpp, symmetric_pairs.hpp).
  std::uint64_t modal_bases = 0;
  std::uint64_t modal_solves = 0;  ///< solutions for all modes with them

  ModeCounts& operator+=(const ModeCounts& other);
};

/// LU factors of the linearized equations at a pair.
class PairFactorization {
 public:
  /// W = [W0; W1] is 2n x k. Cost k LU factorizations of size n + k.
  PairFactorization(const PencilAtPoint& pencil, const ComplexMatrix& Z, const ComplexMatrix& Lambda,
                    const ComplexMatrix& W);

  /// Solves for the change (dZ, dLambda) that changes the residual by R (n x k) and the normalization by N (k
  /// x k).
  void solve(const ComplexMatrix& R, const ComplexMatrix& N, ComplexMatrix& dZ, ComplexMatrix& dLambda) const;

  /// The same in one vector: overwrites (R, N) with (dZ, dLambda), column by column.
  void solve_in_place(ComplexVector& b) const;
  /// Overwrites b with B^H b, B being the linear map of solve_in_place.
  void solve_adjoint_in_place(ComplexVector& b) const;

  /// Bound of |dLambda| / |R|: how far a residual moves the block as a whole.
  double sensitivity() const;

 private:
  /// What the columns of a block of more than one need of each other: Lambda = U T U^H; Z U; W U.
  struct Coupling {
    Matrix M, C;
    ComplexMatrix U, T, T2, Z, W1;
  };

  /// A single mode of which, but for the phase of z, all is real: s^2 without damping, or s itself.
  struct RealMode {
    RealLu lu;
    Complex phase;      ///< of z
    Complex direction;  ///< of s: 1 or i
  };

  /// Factors the real form of a single mode, if it has one.
  bool factor_real(const PencilAtPoint& pencil, const ComplexVector& z, Complex s, const ComplexVector& w,
                   const ComplexVector& slope);
  void solve_block(ComplexVector& b) const;
  void solve_block_adjoint(ComplexVector& b) const;

  std::optional<Coupling> coupling_;
  std::optional<RealMode> real_;
  std::vector<ComplexLu> columns_;
  double slope_scale_, border_scale_;
};

enum class PairStatus { converged, not_converged, singular };

struct InvariantPair {
  PairStatus status = PairStatus::not_converged;
  Chart chart = Chart::finite;
  bool is_real = false;         ///< real Z and Lambda: the block is closed under conjugation
  ComplexMatrix Z;              ///< n x k
  ComplexMatrix Lambda;         ///< k x k
  ComplexMatrix W;              ///< 2n x k, normalization
  double backward_error = 0.0;  ///< |residual| / (magnitude |Z|)
  double condition = 0.0;       ///< relative condition number of the block, w.r.t. max(|mu|, reference)
  std::shared_ptr<const PairFactorization> factors;  ///< null where the pair was not corrected by itself

  Eigen::Index size() const { return Lambda.rows(); }
  /// s of a block of one in the finite chart.
  Complex eigenvalue() const { return Lambda(0, 0); }
};

/// Brings [Z; Z Lambda / gamma] to orthonormal columns, which become the normalization W. gamma =
/// max(|Lambda|, reference) balances the halves (a block of one has W1 = 0 and |z| = 1); eigenvalues that
/// count as zero must not blow the lower one up. The eigenvalues of Lambda do not change.
void normalize_pair(ComplexMatrix& Z, ComplexMatrix& Lambda, ComplexMatrix& W, double reference);

/// Refines a pair by chord-Newton. `reference` is the magnitude below which an eigenvalue (1/s in the
/// reciprocal chart) counts as zero, > 0. Z, Lambda, chart and is_real are read from `start`.
InvariantPair correct_pair(const PencilAtPoint& pencil, const InvariantPair& start, double reference,
                           const CorrectorOptions& options, ModeCounts& counts);

/// The pair's factors, or new ones at the pair where it has none.
std::shared_ptr<const PairFactorization> factors_of(const PencilAtPoint& pencil, const InvariantPair& pair);

/// |residual| / (magnitude |Z|) of a pair as it is.
double backward_error(const PencilAtPoint& pencil, const InvariantPair& pair);

/// What rounding has left of the eigenvalue of a block of one: the Newton correction with its residual formed
/// in extended precision. Tells the real part of an eigenvalue on the imaginary axis, where it is small, to
/// its own digits.
Complex eigenvalue_remainder(const PencilAtPoint& pencil, const InvariantPair& pair);

/// Power series of a pair along the path.
struct PairSeries {
  std::vector<ComplexMatrix> Z;       ///< order + 1 coefficients, n x k
  std::vector<ComplexMatrix> Lambda;  ///< order + 1 coefficients, k x k
};

/// Sensitivities of any order: coefficient j of the equations formed with Z_j = Lambda_j = 0 is the right
/// side (Eq. 35 for one mode and j = 1).
/// `accuracy` is that of every coefficient of a single mode; a block gets what rounding leaves.
PairSeries differentiate_pair(const ReducedPencil& pencil, const InvariantPair& pair, int order,
                              ModeCounts& counts, double accuracy = 1e-15);

}  // namespace eigentrail
