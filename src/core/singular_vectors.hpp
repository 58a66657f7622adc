#pragma once

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// A = U diag(values) V^H, by LAPACK. All NaN if the iteration does not converge or A is not finite.
template <class Values>
struct SingularVectors {
  Vector values;  ///< descending
  Values U;       ///< square, unitary; empty where it was not asked for
  Values V;       ///< square, unitary
};

SingularVectors<Matrix> singular_vectors(Matrix A);
SingularVectors<ComplexMatrix> singular_vectors(ComplexMatrix A);

/// The same without U: A may have many more rows than columns.
SingularVectors<Matrix> right_singular_vectors(Matrix A);
SingularVectors<ComplexMatrix> right_singular_vectors(ComplexMatrix A);

}  // namespace eigentrail
