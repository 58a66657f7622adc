#include "completeness/random_family.hpp"

#include <Eigen/QR>
#include <cmath>
#include <numbers>
#include <random>

namespace eigentrail::test {
namespace {

constexpr double quantum = 0x1p-24;  ///< of all coefficients: what is symmetric stays so

class Generator {
 public:
  // Where several numbers are drawn, each has a statement of its own: the order of evaluation within one is
  // not specified.
  explicit Generator(std::uint64_t seed) : engine_(seed * 7919 + 17) {}

  void fill(RandomFamily& family) {
    family.kind = static_cast<FamilyKind>(integer(0, family_kinds - 1));
    n_ = integer(2, 15);
    strength_ = uniform(0.0, 1.0) < 0.3 ? uniform(1.0, 5.0) : 1.0;
    const double spread = uniform(0.0, 0.3);
    const Matrix mass = Matrix::Identity(n_, n_) + spread * definite(0.0, 1.0);
    Family& m = family.matrices;
    m.M = {mass};
    switch (family.kind) {
      case FamilyKind::light:
        m.K = stiffness();
        m.C = light_damping();
        break;
      case FamilyKind::proportional:
        proportional(m);
        break;
      case FamilyKind::heavy: {
        m.K = stiffness();
        const double least = uniform(0.2, 2.0);
        m.C = {definite(least, uniform(2.5, 6.0))};
        m.C = sum(m.C, symmetric(uniform(0.0, 1.5)));
        break;
      }
      case FamilyKind::gyroscopic:
        m.K = stiffness();
        m.C = light_damping();
        m.C = sum(m.C, skew(uniform(0.3, 3.0)));
        break;
      case FamilyKind::circulatory:
        m.K = stiffness();
        m.K = sum(m.K, skew(uniform(0.1, 2.0)));
        m.C = light_damping();
        break;
      case FamilyKind::mixed:
        mixed(m);
        break;
      case FamilyKind::weakly_coupled:
        weakly_coupled(m);
        break;
    }
    for (MatrixSeries* series : {&m.M, &m.C, &m.K}) round(*series);
  }

 private:
  double uniform(double a, double b) { return a + (b - a) * static_cast<double>(engine_() >> 11) * 0x1p-53; }
  int integer(int a, int b) {
    return a + static_cast<int>(engine_() % static_cast<std::uint64_t>(b - a + 1));
  }
  double power_of_ten(double a, double b) { return std::pow(10.0, uniform(a, b)); }
  double normal() {
    const double size = std::sqrt(-2.0 * std::log(uniform(0x1p-53, 1.0)));
    return size * std::cos(2.0 * std::numbers::pi * uniform(0.0, 1.0));
  }

  Matrix gaussian() {
    Matrix result(n_, n_);
    for (Eigen::Index i = 0; i < n_; ++i) {
      for (Eigen::Index j = 0; j < n_; ++j) result(i, j) = normal();
    }
    return result;
  }
  /// Of norm about one, whatever the size.
  Matrix symmetric_part() {
    const Matrix X = gaussian();
    return (X + X.transpose()) / std::sqrt(8.0 * static_cast<double>(n_));
  }
  Matrix skew_part() {
    const Matrix X = gaussian();
    return (X - X.transpose()) / std::sqrt(8.0 * static_cast<double>(n_));
  }
  Matrix turned(const Vector& eigenvalues) {
    const Matrix Q = Eigen::HouseholderQR<Matrix>(gaussian()).householderQ();
    return Q * eigenvalues.asDiagonal() * Q.transpose();
  }
  /// Symmetric, eigenvalues in the interval.
  Matrix definite(double low, double high) {
    Vector values(n_);
    for (double& value : values) value = uniform(low, high);
    return turned(values);
  }

  Matrix varied(double size, const Matrix& part) { return size * uniform(0.3, 1.0) * part; }

  /// Symmetric polynomial without constant term, degree 1 to 4.
  MatrixSeries symmetric(double size) {
    MatrixSeries result{Matrix::Zero(n_, n_)};
    for (int degree = integer(1, 4); degree > 0; --degree) result.push_back(varied(size, symmetric_part()));
    return result;
  }
  /// Skew polynomial with or without a constant term.
  MatrixSeries skew(double size) {
    const int first = integer(0, 1);
    MatrixSeries result(static_cast<std::size_t>(first), Matrix::Zero(n_, n_));
    const int last = integer(1, 4);
    for (int power = first; power <= last; ++power) result.push_back(varied(size, skew_part()));
    return result;
  }

  static MatrixSeries sum(MatrixSeries a, const MatrixSeries& b) {
    while (a.size() < b.size()) a.push_back(Matrix::Zero(b[0].rows(), b[0].cols()));
    for (std::size_t i = 0; i < b.size(); ++i) a[i] += b[i];
    return a;
  }
  static MatrixSeries product(double a, MatrixSeries b) {
    for (Matrix& coefficient : b) coefficient *= a;
    return b;
  }
  static void round(MatrixSeries& series) {
    for (Matrix& coefficient : series) coefficient = (coefficient / quantum).array().round() * quantum;
    while (series.size() > 1 && series.back().isZero(0.0)) series.pop_back();
  }

  /// Positive at p = 0, less so or indefinite at the ends.
  MatrixSeries stiffness() {
    const double least = uniform(0.1, 1.5);
    const Matrix constant = definite(least, uniform(2.0, 9.0));
    return sum({constant}, symmetric(strength_ * uniform(0.3, 3.0)));
  }
  MatrixSeries light_damping() {
    const double size = power_of_ten(-5.0, -0.5);
    const Matrix constant = definite(0.2 * size, 2.0 * size);
    return sum({constant}, symmetric(size * uniform(0.0, 3.0)));
  }

  void proportional(Family& m) {
    m.K = stiffness();
    const double b = uniform(0.0, 0.6);
    m.C = product(b, m.K);
    const int degree = integer(0, 4);
    for (int power = 0; power <= degree; ++power) {
      const double a = power == 0 ? uniform(-0.3, 2.0) : uniform(-1.0, 1.0);
      m.C = sum(m.C, MatrixSeries(static_cast<std::size_t>(power) + 1, Matrix::Zero(n_, n_)));
      m.C[static_cast<std::size_t>(power)] += a * m.M[0];
    }
  }

  void mixed(Family& m) {
    m.K = stiffness();
    m.K = sum(m.K, skew(uniform(0.0, 1.0)));
    Vector damping(n_);
    for (double& d : damping) d = uniform(0.0, 1.0) < 0.5 ? uniform(0.01, 0.2) : uniform(2.0, 8.0);
    const Matrix constant = turned(damping);
    m.C = sum({constant}, symmetric(uniform(0.0, 1.0)));
    m.C = sum(m.C, skew(uniform(0.0, 1.0)));
  }

  void weakly_coupled(Family& m) {
    const double coupling = power_of_ten(-4.0, -1.0);
    m.M = {Matrix::Identity(n_, n_)};
    m.K = {coupling * gaussian()};
    m.C = {coupling * gaussian()};
    const double heavy = uniform(0.0, 0.6);
    for (Eigen::Index i = 0; i < n_; ++i) {
      const bool is_heavy = uniform(0.0, 1.0) < heavy;
      diagonal(m.K, i, {0.3, 6.0}, {0.2, 2.5 * strength_});
      if (is_heavy) {
        diagonal(m.C, i, {1.0, 5.0}, {0.0, 1.5});
      } else {
        diagonal(m.C, i, {0.02, 0.3}, {0.0, 0.3});
      }
    }
    const int degree = integer(0, 2);
    for (int power = 1; power <= degree; ++power) {
      if (m.K.size() <= static_cast<std::size_t>(power)) m.K.push_back(Matrix::Zero(n_, n_));
      m.K[static_cast<std::size_t>(power)] += coupling * gaussian();
    }
  }
  struct Interval {
    double low, high;
  };
  double draw(Interval interval) { return uniform(interval.low, interval.high); }
  /// A random polynomial at one place of the diagonal: its constant term and the size of the others.
  void diagonal(MatrixSeries& series, Eigen::Index i, Interval constants, Interval sizes) {
    const int degree = integer(1, 4);
    const double constant = draw(constants);
    const double size = draw(sizes);
    for (int power = 0; power <= degree; ++power) {
      if (series.size() <= static_cast<std::size_t>(power)) series.push_back(Matrix::Zero(n_, n_));
      series[static_cast<std::size_t>(power)](i, i) += power == 0 ? constant : size * uniform(-1.0, 1.0);
    }
  }

  std::mt19937_64 engine_;
  Eigen::Index n_ = 0;
  double strength_ = 1.0;  ///< of the changes of K with p
};

}  // namespace

const char* name_of(FamilyKind kind) {
  constexpr const char* names[] = {"light",       "proportional", "heavy",         "gyroscopic",
                                   "circulatory", "mixed",        "weakly coupled"};
  return names[static_cast<int>(kind)];
}

std::string RandomFamily::scene() const {
  return family_scene(matrices, from, to);
}

RandomFamily random_family(std::uint64_t seed) {
  RandomFamily family;
  family.seed = seed;
  Generator(seed).fill(family);
  return family;
}

}  // namespace eigentrail::test
