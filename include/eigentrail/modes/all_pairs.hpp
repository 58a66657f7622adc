// Corrects and differentiates all invariant pairs of a pencil at once, by matrix products.
//
// If every finite mode is followed, the vectors of all pairs and their conjugates form a basis of the state
// space. In this basis the linearized equations of the pairs decouple. With V = [Z; Z Lambda] of all pairs, D
// the block diagonal matrix of all Lambda, and the companion matrix A of the pencil, A V = V D,
//
//     dZ_b = sum_a Z_a U_ab,    D_a U_ab - U_ab Lambda_b = -G_ab  (a /= b),    dLambda_b = G_bb,
//     G = V^-1 [0; M^-1 R]
//
// where R (n x N) are the negative residuals of the pairs and G_ab the blocks of G (modal expansion of the
// resolvent, Lancaster, Lambda-matrices and vibrating systems, 1966, Sect. 4.3). One inverse of size 2n then
// serves the corrections of all pairs and all orders of their series, at the speed of matrix products. One LU
// per mode would take n times as many operations of the same order.
//
// Coordinates without mass are of first order: their velocities are no states. The companion form then has a
// state less for each, and the columns of C of these coordinates take the place of those of M.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "eigentrail/modes/invariant_pair.hpp"

namespace eigentrail {

/// Several invariant pairs side by side, all in the finite chart; N columns in all.
struct PairSet {
  /// Columns of one pair: first ... first + size - 1.
  struct Place {
    Eigen::Index first, size;
    bool is_real;
  };
  std::vector<Place> places;
  ComplexMatrix Z;       ///< n x N
  ComplexMatrix Lambda;  ///< Lambda of every pair in its columns, from the top row; (largest pair size) x N
  ComplexMatrix W;       ///< 2n x N, normalization

  auto block(const ComplexMatrix& blocks, const Place& place) const {
    return blocks.block(0, place.first, place.size, place.size);
  }
};

/// The modal basis of a pencil. Solves the linearized equations of all its pairs.
class ModalBasis {
 public:
  /// Returns an empty value if the pairs and their conjugates are not as many as the states, or if the
  /// basis or the leading matrix is ill-conditioned (reciprocal condition below 1e-9). `leading_inverse`: the
  /// inverse of the leading matrix, for other bases of the same pencil; computed if it is empty.
  static std::optional<ModalBasis> from(const PencilAtPoint& pencil, const PairSet& pairs,
                                        std::optional<Matrix>& leading_inverse);

  /// G = V^-1 [0; M^-1 R] (for coordinates of first order, a row of M^-1 R is one of the upper half), the
  /// modal coordinates of the columns of R (n x m). Rows 0 ... N - 1 belong to the columns of the pairs, the
  /// rows from N on to the conjugates of the complex columns, in the same order.
  ComplexMatrix coordinates(const ComplexMatrix& R) const;

  /// To be called before `solve`, with the pairs of the basis.
  void prepare_division(const PairSet& pairs);

  /// Changes dZ (n x N) and dLambda (blocks as in PairSet) of all pairs. They change the residuals of the
  /// pairs by R (n x N) and their normalizations by N (blocks as in PairSet), to first order.
  void solve(const PairSet& pairs, const ComplexMatrix& R, const ComplexMatrix& N, ComplexMatrix& dZ,
             ComplexMatrix& dLambda) const;

  /// Of one pair, as PairFactorization::sensitivity.
  PairSensitivity sensitivity(const PairSet::Place& place, const Vector& terms) const;

  /// Estimate of the relative error by rounding in a solution.
  double rounding() const { return rounding_; }

  /// Number of rows of the coordinates.
  Eigen::Index size() const { return left_.rows(); }

  /// Row of the conjugate of column i in the coordinates; -1 if the pair is real.
  Eigen::Index conjugate_row(Eigen::Index i) const { return conjugate_[static_cast<std::size_t>(i)]; }

 private:
  ModalBasis() = default;
  /// For two pairs a and b of which one has more than one column: the inverse of X -> X Lambda_b - D_a X,
  /// acting on vec X. row, column, rows and columns are the position of the block in the coordinates.
  struct Division {
    Eigen::Index row, column, rows, columns;
    ComplexMatrix inverse;
  };
  void divide(ComplexMatrix& G) const;
  /// Z U for modal coordinates U, with the conjugates.
  ComplexMatrix vectors(const ComplexMatrix& U) const;

  Matrix left_;  ///< V^-1 [0; M^-1], with V in the real basis below
  /// n x 2n, real basis: for every column z of a real pair Re z, of a complex pair Re z and Im z.
  Matrix right_;
  std::vector<Eigen::Index> real_row_;  ///< for every column of Z: its (first) row in the real basis
  /// For every column of Z: the row of its conjugate in the coordinates, or -1.
  std::vector<Eigen::Index> conjugate_;
  ComplexMatrix divisors_;  ///< 1 / (s_b - s_a) of two single modes; zero on the diagonal and for blocks
  std::vector<Division> divisions_;
  /// For every row of the coordinates: the eigenvalue if its pair is a single mode, else NaN.
  std::vector<Complex> s_;
  double rounding_ = 0.0;
};

/// All pairs of a point with their modal basis.
struct AllPairs {
  PairSet set;
  ModalBasis basis;
};

/// Whether the pairs and the conjugates of the complex ones are as many as the states (state_size). False
/// also if a pair is in the reciprocal chart or has more than two columns.
bool is_complete(const std::vector<InvariantPair>& pairs, Eigen::Index states);

/// Refines all pairs of a pencil (finite chart) by the chord-Newton method, as correct_pair does for each.
/// Null if the iteration or the basis fails; the pairs must then be corrected one by one. `corrected` gets
/// the pairs.
std::shared_ptr<const AllPairs> correct_all(const PencilAtPoint& pencil,
                                            const std::vector<InvariantPair>& starts, double reference,
                                            const CorrectorOptions& options, ModeCounts& counts,
                                            std::vector<InvariantPair>& corrected);

/// Power series of all pairs, as differentiate_pair for each.
std::vector<PairSeries> differentiate_all(const ReducedPencil& pencil, const AllPairs& all, int order,
                                          double accuracy, ModeCounts& counts);

/// M Z Lambda^2 + C Z Lambda + K Z for all pairs of a pencil (matrices n x n).
ComplexMatrix residual(const Matrix& M, const Matrix& C, const Matrix& K, const PairSet& pairs);
ComplexMatrix residual(const PencilAtPoint& pencil, const PairSet& pairs);

/// B Z for a real matrix B and many complex columns. A diagonal B, such as the E of x' = A x, only scales
/// rows.
ComplexMatrix multiply_many(const Matrix& B, const ComplexMatrix& Z);

/// Inverse of X -> X L - D X for small square D and L, acting on vec X.
ComplexMatrix inverse_sylvester(const ComplexMatrix& D, const ComplexMatrix& L);

}  // namespace eigentrail
