// Barycentric rational interpolation without poles on the real axis (Floater & Hormann, Numer. Math. 107,
// 2007, Eqs. 4, 11, 18): the blend of the polynomials of degree d through every d + 1 neighbouring nodes,
//
//   r(x) = sum_j b_j(x) f_j,   b_j(x) = w_j / (x - x_j) / sum_k w_k / (x - x_k).
//
// The error falls like h^(d+1) for any distribution of nodes, and constants are reproduced. With a
// denominator q, w_j becomes w_j q(x_j): then q f is interpolated in that way and the result divided by q.
#pragma once

#include <Eigen/Core>
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

  /// The same at a number, as a vector.
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
