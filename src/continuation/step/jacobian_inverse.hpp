// The inverse B of the Jacobian of a pair, in two forms with the same interface. Which one affects only the
// time.
#pragma once

#include "continuation/step/jacobian_change.hpp"
#include "core/products.hpp"
#include "eigentrail/core/complex_lu.hpp"
#include "eigentrail/modes/invariant_pair.hpp"

namespace eigentrail {

/// B = J^-1 of a pair, in the unknowns (vec Z, vec Lambda / scale), by an LU of J as one matrix. Keeps
/// references to its arguments.
class WholeInverse {
 public:
  WholeInverse(const PairAtPlace& at, const ComplexMatrix& W, double scale)
      : W_(W), scale_(scale), J_(jacobian_matrix(at, W, scale)), lu_(J_) {}

  /// B v and B^H v, of a vector or of the columns of a matrix.
  void apply(Eigen::Ref<ComplexMatrix> v) const { lu_.solve_in_place(v); }
  void apply_adjoint(Eigen::Ref<ComplexMatrix> v) const { lu_.solve_adjoint_in_place(v); }

  struct Change {
    ComplexMatrix matrix;

    template <class Vectors>
    Vectors times(const Vectors& v) const {
      return product(matrix, v);
    }
    template <class Vectors>
    Vectors adjoint_times(const Vectors& v) const {
      return adjoint_product(matrix, v);
    }
  };
  Change change_to(const PairAtPlace& other) const { return {jacobian_matrix(other, W_, scale_) - J_}; }

 private:
  const ComplexMatrix& W_;
  double scale_;
  ComplexMatrix J_;
  ComplexLu lu_;
};

/// The same by one LU of size n + k per column of the pair's Schur form. W1 (n x k): the lower half of W.
class TriangularInverse {
 public:
  TriangularInverse(const PairAtPlace& at, const ComplexMatrix& W, const ComplexMatrix& W1, double scale)
      : at_(at), W1_(W1), scale_(scale), factors_(at.pencil, at.Z, at.Lambda, W) {}

  void apply(Eigen::Ref<ComplexMatrix> v) const {
    factors_.solve_in_place(v);
    v.bottomRows(at_.Lambda.size()) *= 1.0 / scale_;  // the division of complex numbers might underflow
  }
  void apply_adjoint(Eigen::Ref<ComplexMatrix> v) const {
    v.bottomRows(at_.Lambda.size()) *= 1.0 / scale_;
    factors_.solve_adjoint_in_place(v);
  }

  JacobianChange change_to(const PairAtPlace& other) const { return {at_, other, W1_, scale_}; }

 private:
  const PairAtPlace& at_;
  const ComplexMatrix& W1_;
  double scale_;
  PairFactorization factors_;
};

}  // namespace eigentrail
