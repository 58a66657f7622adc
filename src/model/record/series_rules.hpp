// Rules for power series whose coefficients are packs of numbers, one for each element (Griewank & Walther,
// Evaluating Derivatives, 2nd ed., Table 13.2). A series that does not vary along the path has one
// coefficient.
#pragma once

#include <array>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// An operand: the coefficients of a series, and whether it varies along the path.
template <class Pack>
struct Operand {
  const Pack* c = nullptr;
  bool varies = false;

  Pack at(int k) const { return k == 0 || varies ? c[k] : Pack(Pack::Zero()); }
};

/// Rules for series of packs. They write coefficients up to `top`.
template <class Pack>
class Rules {
 public:
  using Real = typename Pack::Scalar;
  using In = Operand<Pack>;

  /// Coefficient k of a b, summed from a_0 b_k on.
  static Pack product(const In& a, const In& b, int k) {
    if (!a.varies) return b.varies || k == 0 ? Pack(a.c[0] * b.c[k]) : Pack(Pack::Zero());
    if (!b.varies) return a.c[k] * b.c[0];
    Pack sum = a.c[0] * b.c[k];
    for (int i = 1; i <= k; ++i) sum += a.c[i] * b.c[k - i];
    return sum;
  }

  /// q_k = (a_k - sum_{j<k} q_j b_{k-j}) / b_0
  static Pack quotient(const Pack* q, const In& a, const In& b, int k) {
    Pack rest = a.at(k);
    if (b.varies) {
      for (int j = 0; j < k; ++j) rest -= q[j] * b.c[k - j];
    }
    return rest / b.c[0];
  }

  /// Of these rules y_0 is there already.
  static void sqrt(Pack* y, int top, const In& x) {
    for (int k = 1; k <= top; ++k) {
      Pack rest = x.c[k];
      for (int j = 1; j < k; ++j) rest -= y[j] * y[k - j];
      y[k] = rest / (Real(2.0) * y[0]);
    }
  }

  /// y' = g x' with y_0 there already: k y_k = sum_j j x_j g_{k-j}. g may be y.
  static void integrate(Pack* y, int top, const In& x, const In& g) {
    for (int k = 1; k <= top; ++k) {
      y[k] = weight(1, k) * (x.c[1] * g.at(k - 1));
      for (int j = 2; j <= k; ++j) y[k] += weight(j, k) * (x.c[j] * g.at(k - j));
    }
  }

  /// Sine and cosine (sign = -1) or hyperbolic ones (sign = +1), with s_0 and c_0 there already.
  static void sine_cosine(Pack* s, Pack* c, int top, const In& x, double sign) {
    for (int k = 1; k <= top; ++k) {
      s[k].setZero();
      c[k].setZero();
      for (int j = 1; j <= k; ++j) {
        s[k] += weight(j, k) * (x.c[j] * c[k - j]);
        c[k] += (sign * weight(j, k)) * (x.c[j] * s[k - j]);
      }
    }
  }

  /// y' = (1 - y^2) x', because sinh and cosh overflow for large |x|.
  static void tanh(Pack* y, int top, const In& x) {
    std::array<Pack, max_order> rates;
    for (int k = 1; k <= top; ++k) {
      Pack& rate = rates[static_cast<std::size_t>(k - 1)];
      rate = Pack::Constant(Real(k == 1 ? 1.0 : 0.0));
      for (int i = 0; i < k; ++i) rate -= y[i] * y[k - 1 - i];
      y[k].setZero();
      for (int j = 1; j <= k; ++j) y[k] += weight(j, k) * (x.c[j] * rates[static_cast<std::size_t>(k - j)]);
    }
  }

  static Real weight(int j, int k) { return Real(double(j) / k); }
};

}  // namespace eigentrail
