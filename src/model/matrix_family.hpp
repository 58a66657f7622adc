// A model given by matrices: (M(p) s^2 + C(p) s + K(p)) z = 0, optionally with constraints A(p) x = 0; or
// E(p) s z = A(p) z.
#pragma once

#include <memory>

#include "eigentrail/model/build.hpp"
#include "eigentrail/model/matrix_model.hpp"

namespace eigentrail {

/// A matrix polynomial in the variable of the family. Its coefficients are constant matrices plus entries
/// that are expressions of parameters.
struct MatrixPolynomial {
  struct Entry {
    int power = 0;
    Eigen::Index row = 0;
    Eigen::Index column = 0;
    Expression expression;
  };
  std::vector<Matrix> coefficients;  ///< by power, lowest first
  std::vector<Entry> entries;        ///< added to the constant matrices

  bool empty() const { return coefficients.empty(); }
};

/// Whether the matrices were given as M, C, K, or as E and A of E x' = A x: then C is E, K is -A, and M is
/// zero.
enum class FamilyForm { second_order, first_order };

class MatrixFamily final : public MatrixModel {
 public:
  /// `variable` is the index of the parameter whose powers multiply the coefficients. C and A may be empty.
  /// M, C and K are n x n, A is m x n; the caller must have checked the shapes.
  MatrixFamily(ModelDescription description, int variable, MatrixPolynomial M, MatrixPolynomial C,
               MatrixPolynomial K, MatrixPolynomial A, FamilyForm form = FamilyForm::second_order);

  Structure structure(int traced_parameter) const override;
  EvaluationFault linearize(const Path& path, int order, Linearization& result,
                            EvaluationCounts& counts) const override;
  CoefficientMatrices coefficient_matrices(const Vector&, int) const override;
  std::vector<Expression> expressions() const override;
  EvaluationFault extended_linearization(const BasicPath<Extended>& path,
                                         BasicLinearization<Extended>& result) const override;

 private:
  template <class Real, int Q>
  EvaluationFault evaluate_all(const BasicPath<Real>& path, int order, BasicLinearization<Real>& result,
                               EvaluationCounts& counts) const;

  bool constant(const MatrixPolynomial& polynomial, int traced_parameter) const;

  int variable_;
  MatrixPolynomial M_, C_, K_, A_;
};

/// Reads [matrix_family] of a scene. Throws InputError for every fault in it.
std::unique_ptr<Model> read_matrix_family(const Scene& scene, const ModelRequest& request);

}  // namespace eigentrail
