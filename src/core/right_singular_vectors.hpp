#pragma once

#include <optional>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// Singular values, descending, and right singular vectors.
template <class Values>
struct RightSingularVectors {
  Vector values;
  Values V;  ///< square, unitary
};

/// The right half of the singular value decomposition of A, by LAPACK. The left vectors are not computed: A
/// may have many more rows than columns. Empty if the iteration does not converge or A is not finite.
std::optional<RightSingularVectors<Matrix>> right_singular_vectors(Matrix A);
std::optional<RightSingularVectors<ComplexMatrix>> right_singular_vectors(ComplexMatrix A);

}  // namespace eigentrail
