// A function of one variable that is known by its Taylor coefficients: a table of a scene, for instance.
#pragma once

#include <array>
#include <span>

#include "eigentrail/core/extended.hpp"
#include "eigentrail/core/series.hpp"
#include "eigentrail/core/types.hpp"

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

/// f', for series up to max_order.
class Derivative final : public SmoothFunction {
 public:
  explicit Derivative(const SmoothFunction& f) : f_(f) {}
  void taylor(double x, std::span<double> coefficients) const override { differentiate(x, coefficients); }
  void taylor(const Extended& x, std::span<Extended> coefficients) const override {
    differentiate(x, coefficients);
  }

 private:
  template <class Real>
  void differentiate(const Real& x, std::span<Real> coefficients) const {
    std::array<Real, max_order + 2> all;
    f_.taylor(x, std::span<Real>(all.data(), coefficients.size() + 1));
    for (std::size_t k = 0; k < coefficients.size(); ++k)
      coefficients[k] = Real(static_cast<double>(k + 1)) * all[k + 1];
  }

  const SmoothFunction& f_;
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

/// The same with a derivative.
template <class T, int Q>
Series<Series<T, Q>, 1> apply(const SmoothFunction& f, const Series<Series<T, Q>, 1>& x) {
  Series<Series<T, Q>, 1> value(apply(f, x[0]));
  value[1] = apply(Derivative(f), x[0]) * x[1];
  return value;
}

}  // namespace eigentrail
