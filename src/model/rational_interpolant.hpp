// Barycentric rational interpolation without poles on the real axis (Floater & Hormann, Numer. Math. 107,
// 2007, Eqs. 4, 11, 18): the blend of the polynomials of degree d through every d + 1 neighbouring nodes,
//
//   r(x) = sum_j b_j(x) f_j,   b_j(x) = w_j / (x - x_j) / sum_k w_k / (x - x_k).
//
// The error falls like h^(d+1) for any distribution of nodes, and constants are reproduced. With a
// denominator q, w_j becomes w_j q(x_j): then q f is interpolated in that way and the result divided by q.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "eigentrail/core/series.hpp"
#include "eigentrail/core/types.hpp"
#include "model/sample_poles.hpp"

namespace eigentrail {

class RationalInterpolant {
 public:
  /// `nodes`: ascending, at least one; degree of the denominator <= degree < number of nodes.
  RationalInterpolant(std::vector<double> nodes, int degree, Denominator denominator = {});

  const std::vector<double>& nodes() const { return nodes_; }
  int degree() const { return degree_; }
  const Denominator& denominator() const { return denominator_; }

  /// The basis functions b_j at x: a number, or a power series about a number. All terms are multiplied by
  /// x - x_m, x_m the nearest node, so that nothing is divided by zero at a node.
  template <class Scalar>
  std::vector<Scalar> basis(const Scalar& x) const {
    const std::size_t m = nearest(leading_value(x));
    const Scalar from_nearest = x - Scalar(nodes_[m]);
    std::vector<Scalar> terms;
    terms.reserve(nodes_.size());
    Scalar sum(0.0);
    for (std::size_t j = 0; j < nodes_.size(); ++j) {
      const Scalar term =
          j == m ? Scalar(weights_[j]) : from_nearest / (x - Scalar(nodes_[j])) * Scalar(weights_[j]);
      sum += term;
      terms.push_back(term);
    }
    for (Scalar& term : terms) term = term / sum;
    return terms;
  }

  /// Coefficients c_0, ..., c_n of sum_j f_j b_j(x + t) = sum_k c_k t^k for values f at the nodes, n + 1 the
  /// size of `coefficients`; not numbers outside the nodes, if not by rounding.
  template <class Real>
  void taylor(const Real& x, const std::vector<double>& values, std::span<Real> coefficients) const {
    const double at = static_cast<double>(x);
    const double slack = 1e-12 * (nodes_.back() - nodes_.front());
    const bool inside = at >= nodes_.front() - slack && at <= nodes_.back() + slack;
    std::fill(coefficients.begin(), coefficients.end(),
              Real(inside ? 0.0 : std::numeric_limits<double>::quiet_NaN()));
    if (!inside) return;
    const std::size_t m = nearest(at);
    const Real from_nearest = x - Real(nodes_[m]);
    std::vector<Real> sum(coefficients.size(), Real(0.0));
    const auto add = [&](std::size_t j, std::size_t k, const Real& share) {
      sum[k] += share;
      coefficients[k] += share * Real(values[j]);
    };
    for (std::size_t j = 0; j < nodes_.size(); ++j) {
      if (j == m) {
        add(j, 0, Real(weights_[j]));
        continue;
      }
      // (from_nearest + t) / (from_node + t)
      const Real from_node = x - Real(nodes_[j]);
      Real quotient = from_nearest / from_node;
      add(j, 0, quotient * Real(weights_[j]));
      for (std::size_t k = 1; k < sum.size(); ++k) {
        quotient = (Real(k == 1 ? 1.0 : 0.0) - quotient) / from_node;
        add(j, k, quotient * Real(weights_[j]));
      }
    }
    for (std::size_t k = 0; k < sum.size(); ++k) {
      for (std::size_t i = 0; i < k; ++i) coefficients[k] -= coefficients[i] * sum[k - i];
      coefficients[k] /= sum[0];
    }
  }

  /// The basis functions at a number, as a vector.
  Vector values(double x) const;

  /// The factor of the divided differences of order degree + 1 in the error at x, up to a constant (Eq. 13 of
  /// the source): large where another node helps most.
  double error_factor(double x) const;

 private:
  std::size_t nearest(double x) const;

  std::vector<double> nodes_;
  std::vector<double> weights_;
  int degree_;
  Denominator denominator_;
};

}  // namespace eigentrail
