// Cubic spline on equally spaced nodes, as used for eigenvalues on a grid.
#pragma once

#include "eigentrail/core/types.hpp"

namespace eigentrail::test {

/// Twice continuously differentiable; end slopes are those of the cubic through the four nodes nearest to
/// each end, so that the ends converge as the rest does, like h^4.
class CubicSpline {
 public:
  /// `values`: nodes x functions, at t = 0, 1, 2, ...; at least four nodes.
  explicit CubicSpline(ComplexMatrix values);

  /// All functions at t in [0, nodes - 1].
  ComplexVector operator()(double t) const;

 private:
  ComplexMatrix values_, slopes_;
};

}  // namespace eigentrail::test
