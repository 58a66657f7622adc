#include "model/piecewise_chebyshev.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace eigentrail {
namespace {

constexpr int first_degree = 4;
constexpr int last_degree = 32;
/// On the way to the first polynomial that is accepted the range has been looked at in at least this many
/// intervals. With fewer points, a function could look simpler than it is.
constexpr int least_degree = 8;
/// A shorter piece, relative to the range, has a jump or a kink in it.
constexpr double shortest = 1e-10;
/// Factor between the estimate of the error and the tolerance.
constexpr double safety = 10.0;

double chebyshev_point(int j, int degree) {
  return std::cos(M_PI * j / degree);
}

/// Factors of the values at the points 0 ... degree in the coefficients: coefficients = values * result.
Matrix transform(int degree) {
  Matrix D(degree + 1, degree + 1);
  for (int j = 0; j <= degree; ++j) {
    for (int k = 0; k <= degree; ++k) {
      const double ends = (j % degree == 0 ? 0.5 : 1.0) * (k % degree == 0 ? 0.5 : 1.0);
      // j k modulo the period 2 degree: the cosine of a small argument is exact where it should be
      D(j, k) = 2.0 / degree * ends * std::cos(M_PI * ((j * k) % (2 * degree)) / degree);
    }
  }
  return D;
}

/// Values at x from Chebyshev coefficients (Clenshaw).
Vector value_at(const Matrix& coefficients, double x) {
  Vector b1 = Vector::Zero(coefficients.rows()), b2 = b1;
  for (Eigen::Index j = coefficients.cols() - 1; j > 0; --j) {
    Vector b = coefficients.col(j) + 2.0 * x * b1 - b2;
    b2 = std::move(b1);
    b1 = std::move(b);
  }
  return coefficients.col(0) + x * b1 - b2;
}

class Interpolation {
 public:
  Interpolation(const std::function<Vector(double)>& f, const PiecewiseOptions& options,
                const std::function<Vector(const Vector&)>& rounding)
      : f_(f), options_(options), rounding_(rounding) {}

  PiecewiseResult run() {
    for (std::size_t i = 0; i + 1 < options_.ends.size(); ++i) {
      if (!resolve(options_.ends[i], options_.ends[i + 1])) break;
    }
    result_.calls = calls_;
    return std::move(result_);
  }

 private:
  enum class Outcome { accepted, halve, no_calls };

  /// Adds the pieces of an interval; false if it was given up.
  bool resolve(double from, double to) {
    ChebyshevPiece piece{from, to, {}};
    switch (interpolate(piece)) {
      case Outcome::accepted:
        result_.pieces.push_back(std::move(piece));
        return true;
      case Outcome::no_calls:
        return give_up(from, to);
      case Outcome::halve:
        break;
    }
    const double middle = 0.5 * (from + to);
    const double range = options_.ends.back() - options_.ends.front();
    if (!(to - from > shortest * range) || middle <= from || middle >= to) return give_up(from, to);
    return resolve(from, middle) && resolve(middle, to);
  }

  bool give_up(double from, double to) {
    result_.unresolved.push_back({from, to, worst_, error_});
    return false;
  }

  Outcome interpolate(ChebyshevPiece& piece) {
    Matrix values;
    for (int degree = first_degree; degree <= last_degree; degree *= 2) {
      if (!sample(piece, degree, values)) return Outcome::no_calls;
      const Matrix coefficients = values * transform(degree);
      const double missed = error_at_new_points(piece.coefficients, values, degree);
      piece.coefficients = coefficients;
      if (degree >= least_degree && is_resolved(coefficients, missed)) {
        drop_rounding(piece.coefficients);
        return Outcome::accepted;
      }
      // Each doubling squares the error, at best: do not go on where that is not enough.
      const double at_last = std::pow(missed, 2.0 * last_degree / degree);
      if (degree >= least_degree && at_last > options_.tolerance) return Outcome::halve;
    }
    return Outcome::halve;
  }

  /// Values at all points of a degree; those of half the degree are known. False if it takes too many calls.
  bool sample(const ChebyshevPiece& piece, int degree, Matrix& values) {
    const Matrix known = std::move(values);
    for (int j = 0; j <= degree; ++j) {
      if (known.size() > 0 && j % 2 == 0) continue;
      const double x = chebyshev_point(j, degree);
      // The ends exactly: neighbouring pieces share them.
      const double p = j == 0        ? piece.to
                       : j == degree ? piece.from
                                     : 0.5 * (piece.from + piece.to) + 0.5 * (piece.to - piece.from) * x;
      const Vector* value = at(p);
      if (value == nullptr) return false;
      if (values.size() == 0) values.resize(value->size(), degree + 1);
      values.col(j) = *value;
    }
    for (Eigen::Index j = 0; j < known.cols(); ++j) values.col(2 * j) = known.col(j);
    return true;
  }

  /// The value at p, from a call or an earlier one; null if no calls are left.
  const Vector* at(double p) {
    if (const auto known = known_.find(p); known != known_.end()) return &known->second;
    if (calls_ >= options_.max_calls) return nullptr;
    ++calls_;
    Vector value = f_(p);
    if (largest_.size() == 0) largest_ = Vector::Zero(value.size());
    largest_ = largest_.cwiseMax(value.cwiseAbs());
    return &known_.emplace(p, std::move(value)).first->second;
  }

  /// Error of the polynomial of half the degree at the points that are new in this one.
  double error_at_new_points(const Matrix& half, const Matrix& values, int degree) {
    if (half.size() == 0) return 1.0;
    double largest = 0.0;
    for (int j = 1; j < degree; j += 2)
      largest = std::max(largest, relative(values.col(j) - value_at(half, chebyshev_point(j, degree))));
    return largest;
  }

  /// The largest of the errors, relative to the largest magnitudes of the functions. Errors that are rounding
  /// do not count.
  double relative(const Vector& errors) {
    const Vector allowed = rounding_(largest_);
    double largest = 0.0;
    for (Eigen::Index i = 0; i < errors.size(); ++i) {
      if (std::abs(errors[i]) <= allowed[i]) continue;
      const double error = std::abs(errors[i]) / largest_[i];
      if (error > largest) {
        largest = error;
        worst_ = i;
      }
    }
    error_ = largest;
    return largest;
  }

  /// The error of a polynomial is about the square of that of half its degree, and of the size of its last
  /// coefficients. For functions with a kink the first is not true, for symmetric ones one coefficient alone
  /// says nothing.
  bool is_resolved(const Matrix& coefficients, double missed) {
    if (missed <= options_.tolerance) return true;
    if (safety * missed * missed > options_.tolerance) return false;
    const Eigen::Index last = coefficients.cols() - 1;
    const double tail = std::max(relative(coefficients.col(last)), relative(coefficients.col(last - 1)));
    return safety * tail <= options_.tolerance;
  }

  /// Removes the last coefficients as far as they are rounding in all functions, so that constants are
  /// constant and polynomials have their degree.
  void drop_rounding(Matrix& coefficients) const {
    const Vector allowed = 0.1 * rounding_(largest_);
    Eigen::Index count = coefficients.cols();
    while (count > 1 && (coefficients.col(count - 1).cwiseAbs().array() <= allowed.array()).all()) --count;
    coefficients.conservativeResize(Eigen::NoChange, count);
    for (Eigen::Index i = 0; i < coefficients.rows(); ++i) {
      for (Eigen::Index j = count - 1; j > 0 && std::abs(coefficients(i, j)) <= allowed[i]; --j)
        coefficients(i, j) = 0.0;
    }
  }

  const std::function<Vector(double)>& f_;
  const PiecewiseOptions& options_;
  const std::function<Vector(const Vector&)>& rounding_;
  PiecewiseResult result_;
  std::map<double, Vector> known_;  ///< values by p
  Vector largest_;                  ///< largest magnitudes so far
  Eigen::Index worst_ = 0;          ///< function with the last error that was measured
  double error_ = 0.0;
  int calls_ = 0;
};

}  // namespace

PiecewiseResult interpolate_in_pieces(const std::function<Vector(double)>& f, const PiecewiseOptions& options,
                                      const std::function<Vector(const Vector&)>& rounding) {
  return Interpolation(f, options, rounding).run();
}

}  // namespace eigentrail
