// Power series of invariant pairs along the path, coefficient by coefficient. The right side for coefficient
// j is coefficient j of the equations formed with Z_j = Lambda_j = 0 (Eq. 35 of the seed paper for one mode
// and j = 1).
#pragma once

#include <functional>

#include "modes/pair_set.hpp"

namespace eigentrail {

/// The equations of several pairs of one chart. Products of matrix series are filled order by order.
class SeriesEquations {
 public:
  /// Solves the linearized equations at the pairs, as PairFactorization::solve.
  using Solve = std::function<void(const ComplexMatrix& R, const ComplexMatrix& N, ComplexMatrix& dZ,
                                   ComplexMatrix& dLambda)>;

  /// Keeps references to the pencil and to the pairs, whose W1 is zero where they have one column.
  SeriesEquations(const ReducedPencil& pencil, Chart chart, const PairSet& pairs, int order);

  /// Solves for coefficient j, the next one, and refines it: until the corrections do not decrease any more,
  /// the estimated remaining error, relative to the coefficient, is below `accuracy`, or there were `most` of
  /// them. Returns their number.
  int solve_for(std::size_t j, int most, double accuracy, const Solve& solve);

  /// The series of one of the pairs.
  PairSeries of(const PairSet::Place& place) const;

 private:
  void known_terms(std::size_t j, ComplexMatrix& residual, ComplexMatrix& defect);
  void add_unknown_terms(std::size_t j, ComplexMatrix& residual, ComplexMatrix& defect) const;
  void update(std::size_t j);
  ComplexMatrix product(const MatrixSeries& B, std::size_t j) const;

  const MatrixSeries &M_, &C_, &K_;
  const PairSet& pairs_;
  bool undamped_, massless_;
  double size_;      ///< of Lambda, one if that is zero
  ComplexMatrix P_;  ///< the pencil at the eigenvalue of a single mode; else empty
  std::vector<ComplexMatrix> Z_, Lambda_;
  std::vector<ComplexMatrix> MZ_, CZ_, square_;  ///< M Z, C Z and Lambda^2
};

}  // namespace eigentrail
