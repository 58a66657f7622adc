// Families whose modes meet, for tests of modes that are followed together.
#pragma once

#include <cmath>

#include "continuation/planted_points.hpp"

namespace eigentrail::test {

/// Frequencies 2 + p, 2.6 - p, 5 and 9: the first two cross at p = 0.3.
inline Planted crossing() {
  return Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.6, -1.0}, {5.0, 0.0}, {9.0, 0.0}}));
}
inline const std::vector<Complex> at_zero{2.0 * j, 2.6 * j, 5.0 * j, 9.0 * j};

/// s^2 + 2 d s + 1 - p: a pair that meets the real axis at p = 1 - d^2, beside a mode far away.
inline Planted towards_the_axis(double d) {
  return Planted({{Matrix::Identity(2, 2)},
                  {Matrix{{2.0 * d, 0.0}, {0.0, 0.2}}},
                  {Matrix{{1.0, 0.0}, {0.0, 36.01}}, Matrix{{-1.0, 0.0}, {0.0, 0.0}}}});
}
inline Complex upper(double d, double p) {
  return {-d, std::sqrt(1.0 - p - d * d)};
}
constexpr Complex far_away(-0.1, 6.0);

}  // namespace eigentrail::test
