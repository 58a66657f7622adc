// Blocks in a basis that turns with the parameter, as power series.
#pragma once

#include <Eigen/LU>

#include "support/families.hpp"

namespace eigentrail::test {

/// The first coefficients of S(h) D(h) S(h)^-1 with S = S0 + h S1, well conditioned.
inline std::vector<ComplexMatrix> in_turning_basis(const std::vector<ComplexMatrix>& D, std::size_t count,
                                                   unsigned seed) {
  const Eigen::Index k = D[0].rows();
  const ComplexMatrix S0 = 2.0 * ComplexMatrix::Identity(k, k) + 0.3 * random_complex(k, k, seed);
  const ComplexMatrix S1 = 0.3 * random_complex(k, k, seed + 1);
  std::vector<ComplexMatrix> inverse{S0.inverse()};
  for (std::size_t j = 1; j < count; ++j) inverse.emplace_back(-inverse[0] * S1 * inverse.back());
  std::vector<ComplexMatrix> Lambda(count, ComplexMatrix::Zero(k, k));
  for (std::size_t i = 0; i < D.size(); ++i) {
    for (std::size_t j = 0; i + j < count; ++j) {
      Lambda[i + j] += S0 * D[i] * inverse[j];
      if (i + j + 1 < count) Lambda[i + j + 1] += S1 * D[i] * inverse[j];
    }
  }
  return Lambda;
}

}  // namespace eigentrail::test
