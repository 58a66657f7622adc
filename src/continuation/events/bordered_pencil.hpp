// The reduced pencil at complex places, bordered twice: near two close eigenvalues a smooth scalar function
// that vanishes at both, with its derivatives (exceptional_point.hpp).
#pragma once

#include <cmath>

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

/// Writes a matrix into a block; of a complex part, the matrix in its complex coordinates.
inline void write_matrix(const Matrix& real, const Matrix& imag, int complex_sign,
                         Eigen::Ref<ComplexMatrix> block) {
  if (complex_sign != 0) {
    block = complex_block(real, complex_sign) + Complex(0.0, 1.0) * complex_block(imag, complex_sign);
    return;
  }
  block.real() = real;
  block.imag() = imag;
}

/// A matrix series at a complex place. Its derivatives are formed only of the vectors that they are applied
/// to.
class SeriesAt {
 public:
  SeriesAt(const MatrixSeries& series, Complex h, int complex_sign)
      : series_(series), h_(h), complex_sign_(complex_sign) {}

  /// Adds `factor` times the matrix.
  void add_to(Complex factor, Matrix& real, Matrix& imag) const {
    for (const Matrix& coefficient : series_) {
      if (!coefficient.isZero(0.0)) {
        real += factor.real() * coefficient;
        imag += factor.imag() * coefficient;
      }
      factor *= h_;
    }
  }

  /// The products of the matrix and of its derivatives with vectors.
  struct Jet {
    ComplexMatrix value, slope, curvature;
  };
  Jet times(const ComplexMatrix& v) const {
    if (complex_sign_ != 0) return within(jet_of(from_complex_coordinates(v, complex_sign_)));
    return jet_of(v);
  }

 private:
  Jet jet_of(const ComplexMatrix& v) const {
    const ComplexMatrix none = ComplexMatrix::Zero(v.rows(), v.cols());
    Jet jet{none, none, none};
    for (std::size_t k = series_.size(); k-- > 0;) {
      jet.curvature = h_ * jet.curvature + 2.0 * jet.slope;
      jet.slope = h_ * jet.slope + jet.value;
      jet.value = h_ * jet.value;
      if (!series_[k].isZero(0.0)) jet.value += multiply(series_[k], v);
    }
    return jet;
  }
  Jet within(const Jet& jet) const {
    return {complex_coordinates(jet.value, complex_sign_), complex_coordinates(jet.slope, complex_sign_),
            complex_coordinates(jet.curvature, complex_sign_)};
  }

  const MatrixSeries& series_;
  Complex h_;
  int complex_sign_;
};

/// P(mu, h) = mu^2 A + mu B + C with its derivatives.
class PencilAt {
 public:
  PencilAt(const ReducedPencil& pencil, Chart chart, Complex h)
      : second_(chart == Chart::finite ? pencil.M : pencil.K, h, pencil.complex_sign),
        first_(pencil.C, h, pencil.complex_sign),
        zeroth_(chart == Chart::finite ? pencil.K : pencil.M, h, pencil.complex_sign),
        size_(pencil.size()),
        complex_sign_(pencil.complex_sign) {}

  /// Writes P into a block.
  void write(Complex mu, Eigen::Ref<ComplexMatrix> block) const {
    Matrix real = Matrix::Zero(size_, size_), imag = real;
    second_.add_to(mu * mu, real, imag);
    first_.add_to(mu, real, imag);
    zeroth_.add_to(1.0, real, imag);
    write_matrix(real, imag, complex_sign_, block);
  }

  /// The products of derivatives of P with vectors.
  class Products {
   public:
    Products(const PencilAt& pencil, Complex mu, const ComplexMatrix& v)
        : mu_(mu),
          second_(pencil.second_.times(v)),
          first_(pencil.first_.times(v)),
          zeroth_(pencil.zeroth_.times(v)) {}

    ComplexMatrix by_mu() const { return 2.0 * mu_ * second_.value + first_.value; }
    ComplexMatrix by_mu_twice() const { return 2.0 * second_.value; }
    ComplexMatrix by_h() const { return mu_ * mu_ * second_.slope + mu_ * first_.slope + zeroth_.slope; }
    ComplexMatrix by_h_twice() const {
      return mu_ * mu_ * second_.curvature + mu_ * first_.curvature + zeroth_.curvature;
    }
    ComplexMatrix by_both() const { return 2.0 * mu_ * second_.slope + first_.slope; }

   private:
    Complex mu_;
    SeriesAt::Jet second_, first_, zeroth_;
  };

 private:
  SeriesAt second_, first_, zeroth_;
  Eigen::Index size_;
  int complex_sign_;
};

/// The same at one h, for many mu: its matrices are computed once, and only the derivative by mu is known.
class FixedPencil {
 public:
  FixedPencil(const ReducedPencil& pencil, Chart chart, Complex h)
      : n_(dimensions_of(pencil)), terms_(n_ * n_, 3) {
    set(0, chart == Chart::finite ? pencil.M : pencil.K, h, pencil.complex_sign);
    set(1, pencil.C, h, pencil.complex_sign);
    set(2, chart == Chart::finite ? pencil.K : pencil.M, h, pencil.complex_sign);
  }

  void write(Complex mu, Eigen::Ref<ComplexMatrix> block) const { block = sum(mu * mu, mu, 1.0); }
  /// The derivative of P by mu times vectors.
  ComplexMatrix by_mu(Complex mu, const ComplexMatrix& v) const {
    return product(sum(2.0 * mu, 1.0, 0.0), v);
  }

 private:
  void set(Eigen::Index term, const MatrixSeries& series, Complex h, int complex_sign) {
    Matrix real = Matrix::Zero(series[0].rows(), series[0].cols()), imag = real;
    SeriesAt(series, h, complex_sign).add_to(1.0, real, imag);
    ComplexMatrix matrix(n_, n_);
    write_matrix(real, imag, complex_sign, matrix);
    terms_.col(term) = matrix.reshaped();
  }

  /// A sum of the matrices, by BLAS: Eigen's takes as long as the factorization.
  ComplexMatrix sum(Complex second, Complex first, Complex zeroth) const {
    return product(terms_, ComplexVector(Eigen::Vector3cd(second, first, zeroth))).reshaped(n_, n_);
  }

  Eigen::Index n_;
  ComplexMatrix terms_;  ///< n^2 x 3: the matrices of mu^2, mu and 1, column by column
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

  /// f = det G, f_mu, f_h, and where they are asked for f_mumu, f_muh, f_hh.
  struct Values {
    Complex f, mu, h, mumu, muh, hh;
  };
  enum class Derivatives { none, first, second_by_mu, second };

  Values at(const PencilAt& pencil, Complex mu, Derivatives wanted = Derivatives::second) {
    if (b_.rows() == 1) return of_one_freedom(pencil, mu);
    const ComplexLu lu = factor(pencil, mu);
    const ComplexMatrix w = solve(lu);
    Values values{G_.determinant(), 0.0, 0.0, 0.0, 0.0, 0.0};
    if (wanted != Derivatives::none) differentiate(pencil, mu, lu, w, wanted, values);
    renew(w);
    return values;
  }

  /// f and f_mu.
  Values at(const FixedPencil& pencil, Complex mu) {
    if (b_.rows() == 1) {
      ComplexMatrix value(1, 1);
      pencil.write(mu, value);
      return {value(0, 0), pencil.by_mu(mu, ComplexMatrix::Ones(1, 1))(0, 0), 0.0, 0.0, 0.0, 0.0};
    }
    const ComplexMatrix w = solve(factor(pencil, mu));
    const TwoByTwo G_mu = -w.adjoint() * pencil.by_mu(mu, v_);
    const Values values{G_.determinant(), slope_of(G_, G_mu), 0.0, 0.0, 0.0, 0.0};
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
    const ComplexMatrix one = ComplexMatrix::Ones(1, 1);
    ComplexMatrix value(1, 1);
    pencil.write(mu, value);
    const PencilAt::Products P(pencil, mu, one);
    return {value(0, 0),           P.by_mu()(0, 0),   P.by_h()(0, 0),
            P.by_mu_twice()(0, 0), P.by_both()(0, 0), P.by_h_twice()(0, 0)};
  }

  template <class Pencil>
  ComplexLu factor(const Pencil& pencil, Complex mu) const {
    const Eigen::Index n = b_.rows();
    ComplexMatrix B(n + 2, n + 2);
    pencil.write(mu, B.topLeftCorner(n, n));
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

  void differentiate(const PencilAt& pencil, Complex mu, const ComplexLu& lu, const ComplexMatrix& w,
                     Derivatives wanted, Values& values) const {
    const PencilAt::Products P(pencil, mu, v_);
    const ComplexMatrix P_mu = P.by_mu(), P_h = P.by_h();
    const TwoByTwo G_mu = -w.adjoint() * P_mu, G_h = -w.adjoint() * P_h;
    values.mu = slope_of(G_, G_mu);
    values.h = slope_of(G_, G_h);
    if (wanted == Derivatives::first) return;
    const auto second = [&](const ComplexMatrix& P_xy, const ComplexMatrix& there) {
      return TwoByTwo(-w.adjoint() * (P_xy + there));
    };
    const PencilAt::Products of_mu(pencil, mu, change(lu, P_mu));
    values.mumu = mixed(G_, G_mu, G_mu, second(P.by_mu_twice(), 2.0 * of_mu.by_mu()));
    if (wanted == Derivatives::second_by_mu) return;
    const PencilAt::Products of_h(pencil, mu, change(lu, P_h));
    values.muh = mixed(G_, G_mu, G_h, second(P.by_both(), of_h.by_mu() + of_mu.by_h()));
    values.hh = mixed(G_, G_h, G_h, second(P.by_h_twice(), 2.0 * of_h.by_h()));
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
