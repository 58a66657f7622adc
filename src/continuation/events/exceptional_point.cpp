#include "continuation/events/exceptional_point.hpp"

#include <algorithm>
#include <cmath>

#include "core/products.hpp"
#include "eigentrail/core/complex_lu.hpp"

namespace eigentrail {
namespace {

/// Newton iterations: from the prediction a few, close to another exceptional point linear convergence first.
constexpr int most_iterations = 30;
/// As a share of the reach: the last move, and moves that may be rounding.
constexpr double settled = 1e-12;
constexpr double loose = 1e-6;
/// As a share of the move before: a longer move no longer shrinks. Beside a double root each is half as long.
constexpr double still_shrinking = 0.7;
/// As a share of the reach, and of mu: longer moves are shortened.
constexpr double longest_move = 0.5;
/// Steps of the way down to the real axis: first share of it, and least one.
constexpr double first_share = 0.02;
constexpr double least_share = 1e-4;
/// Largest growth of a step on that way.
constexpr double growth = 1.6;
/// An eigenvalue counts as followed if its correction is at most this share of its distance from the other
/// one, and of what it moved.
constexpr double certain = 0.2;
/// As a share of the distance of the other one: the last move of an eigenvalue on that way, which only leads
/// to the next place. With a smaller one the way takes up to twice as many factorizations.
constexpr double on_the_way = 1e-2;

/// A matrix series at a complex place. Its derivatives are formed only of the vectors that they are applied
/// to.
class SeriesAt {
 public:
  SeriesAt(const MatrixSeries& series, Complex h) : series_(series), h_(h) {}

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

 private:
  const MatrixSeries& series_;
  Complex h_;
};

/// P(mu, h) = mu^2 A + mu B + C with its derivatives.
class PencilAt {
 public:
  PencilAt(const ReducedPencil& pencil, Chart chart, Complex h)
      : second_(chart == Chart::finite ? pencil.M : pencil.K, h),
        first_(pencil.C, h),
        zeroth_(chart == Chart::finite ? pencil.K : pencil.M, h) {}

  /// Writes P into a block.
  void write(Complex mu, Eigen::Ref<ComplexMatrix> block) const {
    Matrix real = Matrix::Zero(block.rows(), block.cols()), imag = real;
    second_.add_to(mu * mu, real, imag);
    first_.add_to(mu, real, imag);
    zeroth_.add_to(1.0, real, imag);
    block.real() = real;
    block.imag() = imag;
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
};

/// The same at one h, for many mu: its matrices are computed once, and only the derivative by mu is known.
class FixedPencil {
 public:
  FixedPencil(const ReducedPencil& pencil, Chart chart, Complex h) : n_(pencil.size()), terms_(n_ * n_, 3) {
    set(0, chart == Chart::finite ? pencil.M : pencil.K, h);
    set(1, pencil.C, h);
    set(2, chart == Chart::finite ? pencil.K : pencil.M, h);
  }

  void write(Complex mu, Eigen::Ref<ComplexMatrix> block) const { block = sum(mu * mu, mu, 1.0); }
  /// The derivative of P by mu times vectors.
  ComplexMatrix by_mu(Complex mu, const ComplexMatrix& v) const {
    return product(sum(2.0 * mu, 1.0, 0.0), v);
  }

 private:
  void set(Eigen::Index term, const MatrixSeries& series, Complex h) {
    Matrix real = Matrix::Zero(n_, n_), imag = real;
    SeriesAt(series, h).add_to(1.0, real, imag);
    terms_.col(term).real() = real.reshaped();
    terms_.col(term).imag() = imag.reshaped();
  }

  /// A sum of the matrices, by BLAS: Eigen's takes as long as the factorization.
  ComplexMatrix sum(Complex second, Complex first, Complex zeroth) const {
    return product(terms_, ComplexVector(Eigen::Vector3cd(second, first, zeroth))).reshaped(n_, n_);
  }

  Eigen::Index n_;
  ComplexMatrix terms_;  ///< n^2 x 3: the matrices of mu^2, mu and 1, column by column
};

using TwoByTwo = Eigen::Matrix2cd;

/// The derivative of det G by x and y, from those of G.
Complex mixed(const TwoByTwo& G, const TwoByTwo& x, const TwoByTwo& y, const TwoByTwo& xy) {
  const auto term = [&](int i, int j, int k, int l) {
    return xy(i, j) * G(k, l) + x(i, j) * y(k, l) + y(i, j) * x(k, l) + G(i, j) * xy(k, l);
  };
  return term(0, 0, 1, 1) - term(0, 1, 1, 0);
}

Complex slope_of(const TwoByTwo& G, const TwoByTwo& x) {
  return x(0, 0) * G(1, 1) + G(0, 0) * x(1, 1) - x(0, 1) * G(1, 0) - G(0, 1) * x(1, 0);
}

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

  static ComplexMatrix orthonormal(const ComplexMatrix& columns) {
    return columns.householderQr().householderQ() * ComplexMatrix::Identity(columns.rows(), columns.cols());
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

bool is_finite(Complex z) {
  return std::isfinite(z.real()) && std::isfinite(z.imag());
}

/// A root mu of f at fixed h by Newton's method; empty if it does not settle. `moved`: largest allowed way.
/// `last_move`: how short the last move is to be; what is left is about its square over the distance of other
/// roots. `has_borders`: they belong to the root already.
std::optional<Complex> root_at(const FixedPencil& pencil, Complex mu, double moved, double last_move,
                               bool has_borders, Bordered& bordered) {
  const Complex start = mu;
  if (!has_borders) bordered.at(pencil, mu);
  for (int i = 0; i < most_iterations; ++i) {
    const auto values = bordered.at(pencil, mu);
    const Complex move = -values.f / values.mu;
    if (!is_finite(move)) return std::nullopt;
    mu += move;
    if (std::abs(mu - start) > moved) return std::nullopt;
    if (std::abs(move) <= std::max(settled * std::abs(mu), last_move)) return mu;
  }
  return std::nullopt;
}

/// The place between two close eigenvalues where f_mu vanishes, from a place near it. The borders come to
/// belong to the two.
Complex between_eigenvalues(const PencilAt& pencil, Complex mu, Bordered& bordered) {
  constexpr int rounds = 10;       // f is a parabola in mu once the borders belong to the two
  constexpr double enough = 1e-9;  // relative: the last move. What is left, Newton's method for both corrects
  constexpr double farthest = 0.2;  // of mu, from the start: beyond that it is between others
  bordered.at(pencil, mu, Bordered::Derivatives::none);  // with borders that belong to nothing yet
  const Complex start = mu;
  for (int i = 0; i < rounds; ++i) {
    const auto f = bordered.at(pencil, mu, Bordered::Derivatives::second_by_mu);
    const Complex move = -f.mu / f.mumu;
    if (!is_finite(move) || std::abs(mu + move - start) > farthest * std::abs(start)) return start;
    mu += move;
    if (std::abs(move) <= enough * std::abs(mu)) break;
  }
  return mu;
}

}  // namespace

std::optional<ExceptionalPoint> find_exceptional_point(const ReducedPencil& pencil, Chart chart, Complex h,
                                                       Complex mu, double reach,
                                                       const std::vector<Complex>& known) {
  Bordered bordered(pencil.size());
  const Complex start = h;
  const double size_of_mu = std::abs(mu);
  mu = between_eigenvalues(PencilAt(pencil, chart, h), mu, bordered);
  double last_move = INFINITY;
  for (int i = 0; i < most_iterations; ++i) {
    const auto f = bordered.at(PencilAt(pencil, chart, h), mu);
    // [f_mu f_h; f_mumu f_muh] [dmu; dh] = -[f; f_mu]
    const Complex determinant = f.mu * f.muh - f.h * f.mumu;
    Complex dh = (f.mumu * f.f - f.mu * f.mu) / determinant;
    Complex repelled = 0.0;
    for (const Complex other : known) repelled += 1.0 / (h - other);
    dh /= 1.0 + dh * repelled;
    Complex dmu = (-f.mu - f.muh * dh) / f.mumu;
    if (!is_finite(dh) || !is_finite(dmu)) return std::nullopt;
    const double too_far = std::max(std::abs(dh) / reach, std::abs(dmu) / size_of_mu) / longest_move;
    if (too_far > 1.0) {
      dh /= too_far;
      dmu /= too_far;
    }
    h += dh;
    mu += dmu;
    if (std::abs(h - start) > reach) return std::nullopt;
    // The place is known to rounding over the slope of the discriminant: below that moves no longer shrink.
    const bool at_rounding = std::abs(dh) <= loose * reach && std::abs(dh) > still_shrinking * last_move;
    last_move = std::abs(dh);
    if (std::abs(dh) > settled * reach && !at_rounding) continue;
    // The next root of the critical value of f over mu, by its curvature.
    const Complex curvature = f.hh - f.muh * f.muh / f.mumu;
    return ExceptionalPoint{h, mu, -2.0 * f.h / f.mumu, h - 2.0 * f.h / curvature};
  }
  return std::nullopt;
}

std::optional<Complex> mean_at(const ReducedPencil& pencil, Chart chart, double from, Complex h,
                               std::array<Complex, 2> mu) {
  constexpr double first_way = 0.125;
  constexpr double least_way = 1e-3;
  constexpr double enough = 0.9;  // of the way: close to an exceptional point only the mean is smooth
  std::array<Bordered, 2> bordered{Bordered(pencil.size()), Bordered(pencil.size())};
  const Complex way = h - from;
  std::array<Complex, 2> slope{};
  double share = 0.0, step = 0.0;
  bool has_borders = false;
  const auto go_to = [&](double next) {
    const PencilAt here(pencil, chart, from + next * way);
    const FixedPencil fixed(pencil, chart, from + next * way);
    const std::array<Complex, 2> before = mu;
    std::array<Complex, 2> slope_there{};
    for (std::size_t k = 0; k < 2; ++k) {
      const Complex predicted = before[k] + (next - share) * slope[k];
      const double apart = std::abs(before[0] - before[1]);
      const auto root =
          root_at(fixed, predicted, certain * apart, on_the_way * apart, has_borders, bordered[k]);
      if (!root) {
        mu = before;
        return has_borders = false;
      }
      mu[k] = *root;
      const auto f = bordered[k].at(here, mu[k], Bordered::Derivatives::first);
      slope_there[k] = -f.h / f.mu * way;
    }
    slope = slope_there;
    share = next;
    return has_borders = true;
  };
  if (!go_to(0.0)) return std::nullopt;
  step = first_way;
  while (share < enough) {
    if (go_to(std::min(share + step, 1.0))) {
      step *= growth;
    } else if ((step *= 0.5) < least_way) {
      return std::nullopt;
    }
  }
  return 0.5 * (mu[0] + mu[1]) + (1.0 - share) * 0.5 * (slope[0] + slope[1]);
}

std::optional<std::array<EigenvalueBelow, 2>> eigenvalues_below(const ReducedPencil& pencil, Chart chart,
                                                                const ExceptionalPoint& point) {
  std::array<Bordered, 2> bordered{Bordered(pencil.size()), Bordered(pencil.size())};
  const Complex down(0.0, -point.h.imag());
  const auto apart = [&](double share) { return std::sqrt(point.slope * share * down); };
  double share = first_share, step = first_share;
  std::array<Complex, 2> mu{point.mu + apart(share), point.mu - apart(share)}, before{point.mu, point.mu};
  double before_share = 0.0;
  bool at_start = true, has_borders = false;
  while (true) {
    const FixedPencil here(pencil, chart, point.h + share * down);
    std::array<Complex, 2> found{};
    bool followed = true;
    for (std::size_t k = 0; k < 2 && followed; ++k) {
      const double other = std::abs(mu[0] - mu[1]);
      const double last_move = share < 1.0 ? on_the_way * other : 0.0;
      const auto root =
          root_at(here, mu[k], (at_start ? 0.5 : certain) * other, last_move, has_borders, bordered[k]);
      followed = root.has_value();
      if (followed) found[k] = *root;
    }
    has_borders = followed;
    if (!followed) {
      if (at_start && share > least_share * first_share) {
        share *= 0.25;
        step = share;
        mu = {point.mu + apart(share), point.mu - apart(share)};
        continue;
      }
      step *= 0.5;
      if (at_start || step < least_share * before_share) return std::nullopt;
      share = before_share + step;
    } else {
      if (share >= 1.0) {
        return std::array<EigenvalueBelow, 2>{EigenvalueBelow{found[0], bordered[0].vector()},
                                              EigenvalueBelow{found[1], bordered[1].vector()}};
      }
      at_start = false;
      before = found;
      before_share = share;
      step *= growth;
      share = std::min(1.0, share + step);
    }
    // The distance from the double eigenvalue grows like the square root of the way, at first.
    const double ratio = std::sqrt(share / before_share);
    for (std::size_t k = 0; k < 2; ++k) mu[k] = point.mu + ratio * (before[k] - point.mu);
  }
}

}  // namespace eigentrail
