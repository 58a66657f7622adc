// A function of one variable that is known by its Taylor coefficients: a table of a scene, for instance.
#pragma once

#include <array>
#include <span>

#include "eigentrail/core/extended.hpp"
#include "eigentrail/core/series.hpp"

namespace eigentrail {

class SmoothFunction {
 public:
  virtual ~SmoothFunction() = default;

  /// Coefficients c_0, ..., c_n of f(x + t) = sum_k c_k t^k, n + 1 the size of `coefficients`; not numbers
  /// where f is not defined. Where f is made of pieces, those of the piece of x.
  virtual void taylor(double x, std::span<double> coefficients) const = 0;
  virtual void taylor(const Extended& x, std::span<Extended> coefficients) const = 0;

 protected:
  SmoothFunction() = default;
  SmoothFunction(const SmoothFunction&) = default;
  SmoothFunction& operator=(const SmoothFunction&) = default;
};

/// f(x) for a series.
template <class T, int Q>
Series<T, Q> apply(const SmoothFunction& f, const Series<T, Q>& x) {
  std::array<T, Q + 1> taylor;
  f.taylor(x[0], taylor);
  Series<T, Q> distance = x, value;
  distance[0] = T(0.0);
  for (int k = Q; k >= 0; --k) {
    value = value * distance;
    value[0] += taylor[static_cast<std::size_t>(k)];
  }
  return value;
}

}  // namespace eigentrail
