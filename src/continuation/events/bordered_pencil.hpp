// The reduced pencil at complex places, bordered twice: near two close eigenvalues a smooth scalar function
// that vanishes at both, with its derivatives (exceptional_point.hpp).
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "core/orthonormal.hpp"
#include "core/products.hpp"
#include "eigentrail/core/complex_lu.hpp"
#include "eigentrail/reduction/complex_blocks.hpp"
#include "eigentrail/reduction/reduced_pencil.hpp"

namespace eigentrail {

/// Number of dimensions in which the eigenvectors of a pencil are looked for: those of a complex part are in
/// its complex coordinates here (complex_blocks.hpp).
inline Eigen::Index dimensions_of(const ReducedPencil& pencil) {
  return pencil.complex_sign == 0 ? pencil.size() : pencil.size() / 2;
}

/// P(mu, h) = mu^2 A + mu B + C at one complex h, for many mu, with its derivatives.
class PencilAt {
 public:
  /// `order`: of the highest derivative by h that is asked for, 0 to 2.
  PencilAt(const ReducedPencil& pencil, Chart chart, Complex h, int order)
      : n_(dimensions_of(pencil)),
        by_h_(static_cast<std::size_t>(order) + 1, ComplexMatrix::Zero(n_ * n_, 3)) {
    set(0, chart == Chart::finite ? pencil.M : pencil.K, h, pencil.complex_sign);
    set(1, pencil.C, h, pencil.complex_sign);
    set(2, chart == Chart::finite ? pencil.K : pencil.M, h, pencil.complex_sign);
  }

  int order() const { return static_cast<int>(by_h_.size()) - 1; }

  /// The derivative of P, `by_mu` times by mu and `by_h` times by h. The sum of the three matrices is formed
  /// by BLAS: Eigen's takes as long as the factorization.
  ComplexMatrix derivative(Complex mu, int by_mu, int by_h) const {
    Eigen::Vector3cd factors(mu * mu, mu, 1.0);
    if (by_mu == 1) factors = Eigen::Vector3cd(2.0 * mu, 1.0, 0.0);
    if (by_mu == 2) factors = Eigen::Vector3cd(2.0, 0.0, 0.0);
    return product(by_h_[static_cast<std::size_t>(by_h)], ComplexVector(factors)).reshaped(n_, n_);
  }

 private:
  /// Sets the matrix of one power of mu, with its derivatives, from its series.
  void set(Eigen::Index column, const MatrixSeries& series, Complex h, int complex_sign) {
    for (std::size_t k = 0; k < series.size(); ++k) {
      if (series[k].isZero(0.0)) continue;
      const ComplexMatrix coefficient = complex_sign == 0 ? ComplexMatrix(series[k].cast<Complex>())
                                                          : complex_block(series[k], complex_sign);
      for (std::size_t by_h = 0; by_h < by_h_.size() && by_h <= k; ++by_h)
        by_h_[by_h].col(column) += derivative_of_power(h, k, by_h) * coefficient.reshaped();
    }
  }

  static Complex derivative_of_power(Complex h, std::size_t power, std::size_t times) {
    Complex value = 1.0;
    for (std::size_t i = 0; i < power; ++i) value *= i < times ? static_cast<double>(power - i) : h;
    return value;
  }

  Eigen::Index n_;
  std::vector<ComplexMatrix> by_h_;  ///< each n^2 x 3: the matrices of mu^2, mu and 1, column by column
};

/// The bordered system at one place, with borders that are renewed from solution to solution.
class Bordered {
 public:
  explicit Bordered(Eigen::Index n) : b_(n, 2), c_(n, 2) {
    if (n == 1) return;  // no borders
    // Without symmetry, so that they are not orthogonal to the vectors that are wanted.
    for (Eigen::Index k = 0; k < b_.size(); ++k) {
      b_(k) = Complex(1.0, std::sin(1.0 + 2.3 * static_cast<double>(k)));
      c_(k) = Complex(std::cos(0.7 + 1.9 * static_cast<double>(k)), 1.0);
    }
    b_ = orthonormal(b_);
    c_ = orthonormal(c_);
  }

  /// f = det G, f_mu, f_h, f_mumu, f_muh, f_hh.
  struct Values {
    Complex f, mu = 0.0, h = 0.0, mumu = 0.0, muh = 0.0, hh = 0.0;
  };

  /// f with its derivatives up to `order`, 1 or 2, those by h as far as the pencil has them; others are zero.
  Values at(const PencilAt& pencil, Complex mu, int order) {
    if (b_.rows() == 1) return of_one_freedom(pencil, mu);
    const ComplexLu lu = factor(pencil, mu);
    const ComplexMatrix w = solve(lu);
    const Values values = differentiate(pencil, mu, lu, w, order);
    renew(w);
    return values;
  }

  /// The right vector at an eigenvalue, of length one: V k with G k = 0.
  ComplexVector vector() const {
    if (b_.rows() == 1) return ComplexVector::Ones(1);
    const Eigen::Vector2cd first(G_(0, 1), -G_(0, 0)), second(G_(1, 1), -G_(1, 0));
    return (v_ * (first.norm() >= second.norm() ? first : second)).normalized();
  }

 private:
  using TwoByTwo = Eigen::Matrix2cd;

  /// The derivative of det G by x and y, from those of G.
  static Complex mixed(const TwoByTwo& G, const TwoByTwo& x, const TwoByTwo& y, const TwoByTwo& xy) {
    const auto term = [&](int i, int j, int k, int l) {
      return xy(i, j) * G(k, l) + x(i, j) * y(k, l) + y(i, j) * x(k, l) + G(i, j) * xy(k, l);
    };
    return term(0, 0, 1, 1) - term(0, 1, 1, 0);
  }

  static Complex slope_of(const TwoByTwo& G, const TwoByTwo& x) {
    return x(0, 0) * G(1, 1) + G(0, 0) * x(1, 1) - x(0, 1) * G(1, 0) - G(0, 1) * x(1, 0);
  }

  /// A pencil of one freedom is f itself.
  static Values of_one_freedom(const PencilAt& pencil, Complex mu) {
    const auto f = [&](int by_mu, int by_h) {
      return by_h <= pencil.order() ? pencil.derivative(mu, by_mu, by_h)(0, 0) : Complex(0.0);
    };
    return {f(0, 0), f(1, 0), f(0, 1), f(2, 0), f(1, 1), f(0, 2)};
  }

  ComplexLu factor(const PencilAt& pencil, Complex mu) const {
    const Eigen::Index n = b_.rows();
    ComplexMatrix B(n + 2, n + 2);
    B.topLeftCorner(n, n) = pencil.derivative(mu, 0, 0);
    B.topRightCorner(n, 2) = b_;
    B.bottomLeftCorner(2, n) = c_.adjoint();
    B.bottomRightCorner(2, 2).setZero();
    return ComplexLu(std::move(B));
  }

  /// Sets v and G; returns w, the left counterpart of v.
  ComplexMatrix solve(const ComplexLu& lu) {
    const Eigen::Index n = b_.rows();
    ComplexMatrix right = ComplexMatrix::Zero(n + 2, 2);
    right.bottomRows(2).setIdentity();
    ComplexMatrix left = right;
    lu.solve_in_place(right);
    lu.solve_adjoint_in_place(left);
    v_ = right.topRows(n);
    G_ = right.bottomRows(2);
    return left.topRows(n);
  }

  /// The borders of the next place.
  void renew(const ComplexMatrix& w) {
    if (!v_.allFinite() || !w.allFinite()) return;
    c_ = orthonormal(v_);
    b_ = orthonormal(w);
  }

  /// The derivatives by mu or h, called x, of the pencil, of v and of G.
  struct ByOne {
    ComplexMatrix P, v;
    TwoByTwo G;
  };

  Values differentiate(const PencilAt& pencil, Complex mu, const ComplexLu& lu, const ComplexMatrix& w,
                       int order) const {
    const auto by_one = [&](ComplexMatrix P_x) {
      const ComplexMatrix P_x_v = product(P_x, v_);
      return ByOne{std::move(P_x), order > 1 ? change(lu, P_x_v) : ComplexMatrix(), -w.adjoint() * P_x_v};
    };
    const auto by_two = [&](const ComplexMatrix& P_xy, const ByOne& x, const ByOne& y) {
      const ComplexMatrix sum = product(P_xy, v_) + product(x.P, y.v) + product(y.P, x.v);
      return mixed(G_, x.G, y.G, -w.adjoint() * sum);
    };
    Values values{G_.determinant()};
    const ByOne by_mu = by_one(pencil.derivative(mu, 1, 0));
    values.mu = slope_of(G_, by_mu.G);
    if (order > 1) values.mumu = by_two(pencil.derivative(mu, 2, 0), by_mu, by_mu);
    if (pencil.order() == 0) return values;
    const ByOne by_h = by_one(pencil.derivative(mu, 0, 1));
    values.h = slope_of(G_, by_h.G);
    if (order == 1 || pencil.order() == 1) return values;
    values.muh = by_two(pencil.derivative(mu, 1, 1), by_mu, by_h);
    values.hh = by_two(pencil.derivative(mu, 0, 2), by_h, by_h);
    return values;
  }

  /// The derivative of v by x from P_x v.
  static ComplexMatrix change(const ComplexLu& lu, const ComplexMatrix& P_x) {
    ComplexMatrix x = ComplexMatrix::Zero(lu.size(), 2);
    x.topRows(P_x.rows()) = -P_x;
    lu.solve_in_place(x);
    return x.topRows(P_x.rows());
  }

  ComplexMatrix b_, c_, v_;  ///< n x 2
  TwoByTwo G_ = TwoByTwo::Zero();
};

}  // namespace eigentrail
