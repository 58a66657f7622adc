// All pairs of a pencil at once, by matrix products.
//
// Where every mode is followed, their vectors side by side, conjugates included, are a basis of the state
// space in which the linearized equations of each pair fall apart. With V = [Z; Z Lambda] of all pairs and
// the companion matrix A of the pencil, A V = V D,
//
//     dZ_b = sum_a Z_a U_ab,    D_a U_ab - U_ab Lambda_b = -G_ab  (a /= b),    dLambda_b = G_bb,
//     G = V^-1 [0; M^-1 R]
//
// (modal expansion of the resolvent, Lancaster, Lambda-matrices and vibrating systems, 1966, Sect. 4.3). One
// inverse of size 2n then serves the corrections of all pairs and every order of their series, at the speed
// of matrix products; one LU per mode costs n times as many operations of the same order.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "eigentrail/modes/invariant_pair.hpp"

namespace eigentrail {

/// Pairs side by side, all in the finite chart.
struct PairSet {
  /// One of them: columns first ... first + size - 1.
  struct Place {
    Eigen::Index first, size;
    bool is_real;
  };
  std::vector<Place> places;
  ComplexMatrix Z;       ///< n x N
  ComplexMatrix Lambda;  ///< largest size x N: every pair's block in its columns, from the top
  ComplexMatrix W;       ///< 2n x N

  auto block(const ComplexMatrix& blocks, const Place& place) const {
    return blocks.block(0, place.first, place.size, place.size);
  }
};

/// The modal basis of a pencil, as the solver of the linearized equations of all its pairs.
class ModalBasis {
 public:
  /// Empty when the pairs and their conjugates are not 2n columns, or no basis that can be relied on.
  static std::optional<ModalBasis> from(const PencilAtPoint& pencil, const PairSet& pairs);

  /// G = V^-1 [0; M^-1 R] in modal coordinates: row i < N of the pairs' own columns, rows from N on of the
  /// conjugates of complex ones, in order. R is n x m.
  ComplexMatrix coordinates(const ComplexMatrix& R) const;

  /// Changes dZ (n x N) and dLambda (blocks as in PairSet) of all pairs that change their residuals by R (n x
  /// N) and their normalizations by N (blocks).
  void solve(const PairSet& pairs, const ComplexMatrix& R, const ComplexMatrix& N, ComplexMatrix& dZ,
             ComplexMatrix& dLambda) const;

  /// Bound of |dLambda| / |R| of one pair, as PairFactorization::sensitivity.
  double sensitivity(const PairSet::Place& place) const;

  /// Relative error that rounding leaves in a solution, about.
  double rounding() const { return rounding_; }

  /// Number of rows of the coordinates.
  Eigen::Index size() const { return left_.rows(); }

  /// Row of the conjugate of column i; -1 where the pair is real.
  Eigen::Index conjugate_row(Eigen::Index i) const { return conjugate_[static_cast<std::size_t>(i)]; }

 private:
  ModalBasis() = default;
  /// Beside blocks of more than one: the inverse of X -> D_a X - X Lambda_b on vec X, negative.
  struct Division {
    Eigen::Index row, column, rows, columns;
    ComplexMatrix inverse;
  };
  void prepare_division(const PairSet& pairs);
  void divide(ComplexMatrix& G) const;
  /// Z U of modal coordinates U, conjugates included.
  ComplexMatrix vectors(const ComplexMatrix& U) const;

  Matrix left_;                          ///< V^-1 [0; M^-1] in the real basis below
  Matrix right_;                         ///< n x 2n: Re z, or Re z and Im z, of every column
  std::vector<Eigen::Index> real_row_;   ///< of every column of Z: its row in the real basis
  std::vector<Eigen::Index> conjugate_;  ///< of every column of Z: the row of its conjugate, or -1
  ComplexMatrix divisors_;               ///< 1 / (s_b - s_a); zero within a pair and beside blocks
  std::vector<Division> divisions_;
  std::vector<Complex> s_;  ///< of every row, where its pair is a single mode
  double rounding_ = 0.0;
};

/// What a point keeps of all its pairs.
struct AllPairs {
  PairSet set;
  ModalBasis basis;
};

/// Whether the pairs, with the conjugates of complex ones, are all that a pencil of size n has, none of them
/// in the other chart.
bool is_complete(const std::vector<InvariantPair>& pairs, Eigen::Index n);

/// Refines all pairs of a pencil (chart finite) by chord-Newton; as correct_pair for each. Null when that did
/// not work: the pairs then want to be corrected one by one.
std::shared_ptr<const AllPairs> correct_all(const PencilAtPoint& pencil,
                                            const std::vector<InvariantPair>& starts, double reference,
                                            const CorrectorOptions& options, ModeCounts& counts,
                                            std::vector<InvariantPair>& corrected);

/// Power series of all of them, as differentiate_pair for each.
std::vector<PairSeries> differentiate_all(const ReducedPencil& pencil, const AllPairs& all, int order,
                                          double accuracy, ModeCounts& counts);

/// B Z for a real matrix and many complex columns.
ComplexMatrix multiply_many(const Matrix& B, const ComplexMatrix& Z);

}  // namespace eigentrail
