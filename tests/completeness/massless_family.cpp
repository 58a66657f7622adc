#include "completeness/massless_family.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <sstream>
#include <utility>

#include "completeness/reference_events.hpp"
#include "support/scenes.hpp"
#include "support/spectra.hpp"

namespace eigentrail::test {
namespace {

constexpr double massless_quantum = 0x1p-24;  ///< of all coefficients: congruences with integers are exact

class MasslessGenerator {
 public:
  // Where several numbers are drawn, each has a statement of its own: the order of evaluation within one is
  // not specified.
  explicit MasslessGenerator(std::uint64_t seed) : engine_(seed * 7919 + 29) {}

  MasslessFamily family(std::uint64_t seed) {
    MasslessFamily family;
    family.seed = seed;
    const Eigen::Index n = integer(2, 6);
    const Eigen::Index m = family.massless = integer(1, static_cast<int>(std::min<Eigen::Index>(n - 1, 3)));
    Family& of = family.unmixed;
    of.M = {Matrix::Zero(n, n)};
    of.M[0].topLeftCorner(n - m, n - m) = definite(n - m, 0.5, 2.0);
    of.K = {definite(n, 0.5, 6.0), uniform(0.2, 1.5) * symmetric(n)};
    soften(m, of.K);
    of.C = {Matrix::Zero(n, n)};
    const auto damped = of.C[0].topLeftCorner(n - m, n - m);
    if (uniform(0.0, 1.0) < 0.6) {
      const double size = std::pow(10.0, uniform(-3.0, 0.3));
      of.C[0].topLeftCorner(n - m, n - m) = size * definite(n - m, 0.3, 1.0);
    }
    if (uniform(0.0, 1.0) < 0.4) {
      const double size = uniform(0.1, 1.0);
      of.C[0].topLeftCorner(n - m, n - m) = damped + size * skew(n - m);
    }
    for (MatrixSeries* series : {&of.M, &of.C, &of.K}) {
      for (Matrix& coefficient : *series)
        coefficient = (coefficient / massless_quantum).array().round() * massless_quantum;
    }
    family.matrices = uniform(0.0, 1.0) < 0.5 ? of : congruent(of, n);
    return family;
  }

 private:
  double uniform(double a, double b) { return a + (b - a) * static_cast<double>(engine_() >> 11) * 0x1p-53; }
  int integer(int a, int b) {
    return a + static_cast<int>(engine_() % static_cast<std::uint64_t>(b - a + 1));
  }
  Matrix square(Eigen::Index n) {
    Matrix result(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j < n; ++j) result(i, j) = uniform(-1.0, 1.0);
    }
    return result;
  }
  Matrix symmetric(Eigen::Index n) {
    const Matrix X = square(n);
    return 0.5 * (X + X.transpose());
  }
  Matrix skew(Eigen::Index n) {
    const Matrix X = square(n);
    return 0.5 * (X - X.transpose());
  }
  /// Symmetric, eigenvalues in the interval.
  Matrix definite(Eigen::Index n, double low, double high) {
    const Matrix Q = Eigen::HouseholderQR<Matrix>(square(n)).householderQ();
    Vector values(n);
    for (double& value : values) value = uniform(low, high);
    return Q * values.asDiagonal() * Q.transpose();
  }
  /// Replaces the stiffness of the massless freedoms by one whose determinant has its zeros at random places,
  /// the first of them well inside the range.
  void soften(Eigen::Index m, MatrixSeries& K) {
    const Matrix Q = Eigen::HouseholderQR<Matrix>(square(m)).householderQ();
    Vector slopes(m), constants(m);
    for (Eigen::Index i = 0; i < m; ++i) {
      const double zero = i == 0 ? uniform(-0.7, 0.7) : uniform(-1.5, 1.5);
      const double slope = uniform(0.5, 2.0);
      slopes[i] = uniform(0.0, 1.0) < 0.5 ? slope : -slope;
      constants[i] = -slopes[i] * zero;
    }
    K[0].bottomRightCorner(m, m) = Q * constants.asDiagonal() * Q.transpose();
    K[1].bottomRightCorner(m, m) = Q * slopes.asDiagonal() * Q.transpose();
  }
  /// T^T (.) T with a triangular T of small integers and a unit diagonal.
  Family congruent(const Family& of, Eigen::Index n) {
    Matrix T = Matrix::Identity(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j < i; ++j) T(i, j) = integer(-1, 1);
    }
    Family result = of;
    for (MatrixSeries* series : {&result.M, &result.C, &result.K}) {
      for (Matrix& coefficient : *series) coefficient = T.transpose() * coefficient * T;
    }
    return result;
  }

  std::mt19937_64 engine_;
};

/// A complex pair is one mode, listed with Im s >= 0.
std::vector<Complex> with_conjugates(const std::vector<Complex>& modes) {
  std::vector<Complex> all;
  for (const Complex s : modes) {
    all.push_back(s);
    if (s.imag() != 0.0) all.push_back(std::conj(s));
  }
  return all;
}

/// Takes the member of a list that is nearest to s, relative to `scale`; infinite if there is none.
double take_nearest(Complex s, double scale, std::vector<Complex>& from) {
  const auto nearer = [s](Complex a, Complex b) { return std::abs(a - s) < std::abs(b - s); };
  const auto nearest = std::min_element(from.begin(), from.end(), nearer);
  if (nearest == from.end()) return INFINITY;
  const double distance = std::abs(*nearest - s) / std::max(std::abs(s), scale);
  from.erase(nearest);
  return distance;
}

class Comparison {
 public:
  Comparison(const MasslessFamily& family, double start, std::vector<std::string>& problems)
      : family_(family), problems_(problems) {
    for (const Complex s : family.spectrum(start)) largest_ = std::max(largest_, std::abs(s));
  }

  /// Compares the modes that are listed at p with the spectrum there. What is larger than the limit counts as
  /// infinite, also if it is listed.
  void at(double p, const std::vector<Complex>& modes, double accuracy, const char* where) {
    const double limit = may_be_missing * largest_;
    const double scale = negligible * largest_;
    std::vector<Complex> listed = with_conjugates(modes);
    std::vector<Complex> expected = family_.spectrum(p);
    if (is_undecided(expected, scale)) return;
    const auto ascending = [](Complex a, Complex b) { return std::abs(a) < std::abs(b); };
    std::sort(expected.begin(), expected.end(), ascending);
    std::ostringstream text;
    text.precision(10);
    for (const Complex s : expected) {
      if (std::abs(s) > limit) {  // may be listed
        const auto is_it = [&](Complex other) { return std::abs(other - s) <= accuracy * std::abs(s); };
        const auto found = std::find_if(listed.begin(), listed.end(), is_it);
        if (found != listed.end()) listed.erase(found);
        continue;
      }
      std::vector<Complex> rest = listed;
      if (take_nearest(s, scale, rest) <= accuracy) {
        listed = std::move(rest);
      } else {
        text << " misses " << s;
      }
    }
    for (const Complex s : listed) text << " invents " << s;
    if (text.str().empty()) return;
    std::ostringstream line;
    line.precision(12);
    line << where << ' ' << p << text.str();
    problems_.push_back(line.str());
  }

 private:
  /// Of the largest magnitude at the start: from here on an eigenvalue may count as infinite.
  static constexpr double may_be_missing = 40.0;
  /// Of the same: magnitudes below this have absolute accuracy.
  static constexpr double negligible = 1e-3;

  /// Whether two eigenvalues are so close that rounding decides whether they are a pair: the points of a
  /// trace lie on collisions, where eigenvalues are known to the square root of rounding, 1e-8 of the largest
  /// one.
  static bool is_undecided(const std::vector<Complex>& all, double scale) {
    constexpr double close = 1e-3;
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (std::abs(all[i] - all[j]) <= close * std::max(std::abs(all[i]), scale)) return true;
      }
    }
    return false;
  }

  const MasslessFamily& family_;
  std::vector<std::string>& problems_;
  double largest_ = 0.0;
};

}  // namespace

std::string MasslessFamily::scene() const {
  return family_scene(matrices, from, to);
}

std::vector<Complex> MasslessFamily::spectrum(double p) const {
  const RealPencil at = real_pencil(unmixed, p);
  const Eigen::Index n = size() - massless;
  const Matrix coupling = at.K.topRightCorner(n, massless);
  const Matrix stiffness =
      at.K.topLeftCorner(n, n) - coupling * at.K.bottomRightCorner(massless, massless)
                                                .partialPivLu()
                                                .solve(Matrix(at.K.bottomLeftCorner(massless, n)));
  return quadratic_eigenvalues(at.M.topLeftCorner(n, n), at.C.topLeftCorner(n, n), stiffness);
}

std::vector<double> MasslessFamily::places_of_infinity() const {
  const auto corner = [this](const Matrix& K) { return Matrix(K.bottomRightCorner(massless, massless)); };
  std::vector<double> places;
  for (const Complex p : qz_eigenvalues(-corner(unmixed.K[0]), corner(unmixed.K[1]))) {
    if (p.imag() == 0.0) places.push_back(p.real());
  }
  std::sort(places.begin(), places.end());
  return places;
}

MasslessFamily massless_family(std::uint64_t seed) {
  return MasslessGenerator(seed).family(seed);
}

std::vector<std::string> check_massless(const MasslessFamily& family, bool reversed) {
  constexpr double of_points = 1e-6;  // relative: a hundred roundings of eigenvalues with condition 1e6
  constexpr double between = 1e-5;    // ten tolerances
  constexpr int places = 6;
  MasslessFamily traced = family;
  if (reversed) std::swap(traced.from, traced.to);
  const RecordedTrace trace = record_trace(make_setting(traced.scene(), {{"max_nodes", "400"}}));
  std::vector<std::string> problems;
  if (trace.result.status != TraceStatus::completed)
    problems.push_back("ended early: " + trace.result.message);
  Comparison compare(family, traced.from, problems);
  for (std::size_t i = 0; i < trace.nodes.size(); ++i) {
    std::vector<Complex> modes;
    for (const ModeState& mode : trace.modes[i]) modes.push_back(mode.s);
    compare.at(trace.nodes[i].p, modes, of_points, "at the point");
  }
  for (int i = 0; i < places; ++i) {
    const double p = traced.from + (traced.to - traced.from) * (i + 0.5 + 0.01 * std::numbers::pi) / places;
    if ((p - trace.result.reached) * (traced.to - traced.from) > 0.0) break;
    std::vector<Complex> modes;
    for (const Complex s : trace.eigenvalues_at(p)) {
      if (std::isfinite(s.real())) modes.push_back(s);
    }
    compare.at(p, modes, between, "between points");
  }
  return problems;
}

}  // namespace eigentrail::test
