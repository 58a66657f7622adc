// A series projected onto a tangent basis by the public function, which takes three.
#pragma once

#include "eigentrail/reduction/reduced_pencil.hpp"

namespace eigentrail::test {

/// T^T B T up to h^order.
inline MatrixSeries project(const TangentBasis& basis, const SystemSeries& B, int order) {
  Linearization linearization;
  linearization.M = linearization.C = linearization.K = B;
  return reduce(linearization, basis, order).K;
}

}  // namespace eigentrail::test
