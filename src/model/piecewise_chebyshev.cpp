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
/// Factor between the last coefficients and the tolerance: the sum of all those after them, even at a kink.
constexpr double safety = 30.0;
/// Errors that decrease by less than this from one degree to its double are those at a kink.
constexpr double slow = 0.35;
/// Factor between the largest error and that at the new points.
constexpr double between_points = 3.0;
/// Number of last coefficients that must be small. At a kink some of them may be so by chance.
constexpr Eigen::Index looked_at = 4;
/// Factor by which the square of the error of half the degree may exceed the tolerance.
constexpr double far_too_large = 1e3;

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
      const double from = options_.ends[i], to = options_.ends[i + 1];
      if (!resolve(from, to, {from, to, 0, 1.0})) break;
    }
    result_.calls = calls_;
    return std::move(result_);
  }

 private:
  enum class Outcome { accepted, halve, no_calls };

  /// Adds the pieces of an interval, a half of `around`, which is not resolved; false if it was given up.
  bool resolve(double from, double to, const Unresolved& around) {
    ChebyshevPiece piece{from, to, {}};
    const Outcome outcome = interpolate(piece);
    if (outcome == Outcome::accepted) {
      result_.pieces.push_back(std::move(piece));
      return true;
    }
    if (outcome == Outcome::no_calls) return give_up(around);
    const Unresolved whole{from, to, worst_, error_};
    const double middle = 0.5 * (from + to);
    const double range = options_.ends.back() - options_.ends.front();
    if (!(to - from > shortest * range) || middle <= from || middle >= to) return give_up(whole);
    return resolve(from, middle, whole) && resolve(middle, to, whole);
  }

  bool give_up(const Unresolved& at) {
    result_.unresolved.push_back(at);
    return false;
  }

  Outcome interpolate(ChebyshevPiece& piece) {
    Matrix values;
    double before = 1.0;
    for (int degree = first_degree; degree <= last_degree; degree *= 2) {
      if (!sample(piece, degree, values)) return Outcome::no_calls;
      const Matrix coefficients = values * transform(degree);
      const double missed = error_at_new_points(piece.coefficients, values, degree);
      piece.coefficients = coefficients;
      if (degree >= least_degree && is_resolved(coefficients, missed)) {
        drop_rounding(piece.coefficients);
        return Outcome::accepted;
      }
      if (degree >= least_degree && is_hopeless(degree, missed, before)) return Outcome::halve;
      before = missed;
    }
    return Outcome::halve;
  }

  /// Whether the last degree will not do. `missed` and `before` are the errors of half and of a quarter of
  /// this degree. If errors go on decreasing by the same factor per coefficient, `predicted` is that of the
  /// last degree. Functions that oscillate do better, so it need only reach the cube root of the tolerance.
  bool is_hopeless(int degree, double missed, double before) const {
    const double factor = missed / before;
    if (degree > least_degree && factor > slow) return true;
    const double predicted = missed * std::pow(factor, 4.0 * last_degree / degree - 2.0);
    return predicted > std::cbrt(options_.tolerance);
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

  /// The error of a polynomial is about that of its last coefficients, and the square of that of half its
  /// degree. The first alone says nothing where coefficients vanish by symmetry; the second alone is too
  /// large by far for functions that oscillate.
  bool is_resolved(const Matrix& coefficients, double missed) {
    if (between_points * missed <= options_.tolerance) return true;
    if (missed * missed > far_too_large * options_.tolerance) return false;
    double tail = 0.0;
    for (Eigen::Index j = coefficients.cols() - looked_at; j < coefficients.cols(); ++j)
      tail = std::max(tail, relative(coefficients.col(j)));
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
