// A model whose matrices are sums of constant matrices with factors that depend on the parameters,
//
//   M(p) = sum_i f_i(p) M_i,  and so for C, K and A;  (M s^2 + C s + K) z = 0, A z = 0,
//
// with sparse constant matrices (a large model as another program made it) or dense ones (its projection, or
// matrices given in the scene).
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "eigentrail/model/matrix_model.hpp"

namespace eigentrail {

/// A function of one number that is known at single places and interpolated between them.
class TabulatedFactor;

/// One summand: a constant matrix, n x n, and its factor, a function of the parameters' SI values.
template <class Storage>
struct AffineTerm {
  AffineTerm() : factor(1.0) {}
  AffineTerm(Expression the_factor, Storage the_matrix, std::string the_name = std::string())
      : factor(std::move(the_factor)), matrix(std::move(the_matrix)), name(std::move(the_name)) {}

  Expression factor;
  Storage matrix;
  std::string name;  ///< in the file that it comes from: "2" for /K/2, "bearing" for /K/bearing
  /// If there is one, the factor is `scale` times the tabulated function at `factor`.
  std::shared_ptr<const TabulatedFactor> table;
  Expression scale = 1.0;
};

/// The summands of M, C and K, and of the constraints A; an empty list is a zero matrix.
template <class Storage>
struct AffinePencil {
  std::vector<AffineTerm<Storage>> M, C, K, A = {};
};

/// Storage is SparseMatrix or Matrix. Only dense families have constraints.
template <class Storage>
class AffineFamily : public MatrixModel {
 public:
  /// The description gives n, and the effects; without them the matrices are the effects. The caller must
  /// have checked the sizes.
  AffineFamily(ModelDescription description, AffinePencil<Storage> pencil);

  const AffinePencil<Storage>& pencil() const { return pencil_; }
  /// The matrices M, C and K at one place; `parameters` in declared units.
  AffinePencil<Storage> at(const Vector& parameters) const;

  Structure structure(int traced_parameter) const override;
  EvaluationFault linearize(const Path& path, int order, Linearization& result,
                            EvaluationCounts& counts) const override;
  /// None for sparse matrices: looking for common structure takes work and memory of dense ones.
  CoefficientMatrices coefficient_matrices(const Vector& parameters, int traced) const override;
  std::vector<Expression> expressions() const override;
  /// Of tables whose argument is a parameter; none for sparse matrices.
  const SampleErrors* sample_errors() const override { return errors_.get(); }
  EvaluationFault extended_linearization(const BasicPath<Extended>& path,
                                         BasicLinearization<Extended>& result) const override;

 private:
  template <class Real, int Q>
  EvaluationFault evaluate_all(const BasicPath<Real>& path, int order,
                               BasicLinearization<Real>& result) const;

  AffinePencil<Storage> pencil_;
  std::shared_ptr<const SampleErrors> errors_;
};

using SparseFamily = AffineFamily<SparseMatrix>;

extern template class AffineFamily<SparseMatrix>;
extern template class AffineFamily<Matrix>;

}  // namespace eigentrail
