#include "model/piecewise_chebyshev.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

namespace eigentrail {

double chebyshev_point(int j, int degree) {
  return std::cos(M_PI * j / degree);
}

namespace {

constexpr int first_degree = 4;
constexpr int last_degree = 32;
/// On the way to the first polynomial that is accepted the range has been looked at in at least this many
/// intervals. With fewer points, a function could look simpler than it is.
constexpr int least_degree = 8;
/// A shorter piece, relative to the range, has a jump or a kink in it.
constexpr double shortest = 1e-10;
/// Factors between the tolerance and an error that is estimated from coefficients, or measured at the new
/// points.
constexpr double beyond_safety = 3.0;
constexpr double measured_safety = 10.0;
/// The error of a degree is less than this power of that of half the degree, except at kinks.
constexpr double faster = 1.25;
/// Factor by which the square of the error of half the degree, or the error that is predicted for the last
/// degree, may exceed the tolerance: both are too large where functions oscillate.
constexpr double far_too_large = 1e3;

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
    Outcome outcome = interpolate(piece);
    if (outcome == Outcome::accepted) outcome = look_between(piece);
    if (outcome == Outcome::accepted) {
      result_.pieces.push_back(std::move(piece));
      return true;
    }
    if (outcome == Outcome::no_calls)
      return give_up(error_ > 0.0 ? around : Unresolved{from, to, worst_, 0.0});
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
    for (int degree = first_degree; degree <= last_degree; degree *= 2) {
      if (!sample(piece, degree, values)) return Outcome::no_calls;
      const Matrix half = std::exchange(piece.coefficients, values * transform(degree));
      if (degree < least_degree) continue;
      const double missed = error_at_new_points(half, values, degree);
      if (is_resolved(piece.coefficients, missed)) {
        drop_rounding(piece.coefficients);
        return Outcome::accepted;
      }
      // With fewer coefficients, those of functions that oscillate do not decrease yet.
      if (degree > least_degree && is_hopeless(piece.coefficients)) return Outcome::halve;
    }
    return Outcome::halve;
  }

  /// Compares an accepted piece with values at places between its points.
  Outcome look_between(const ChebyshevPiece& piece) {
    const double widest = options_.resolution * (options_.ends.back() - options_.ends.front());
    std::vector<double> places;
    const auto end = known_.upper_bound(piece.to);
    for (auto left = known_.lower_bound(piece.from), right = std::next(left); right != end; ++left, ++right) {
      const double gap = right->first - left->first;
      const int parts = static_cast<int>(std::ceil(gap / widest));
      for (int i = 1; i < parts; ++i) places.push_back(left->first + gap * i / parts);
    }
    error_ = 0.0;
    for (const double p : places) {
      const Vector* value = at(p);
      if (value == nullptr) return Outcome::no_calls;
      const double x = (2.0 * p - piece.from - piece.to) / (piece.to - piece.from);
      error_ = relative(*value - value_at(piece.coefficients, x), &worst_);
      if (error_ > options_.tolerance) return Outcome::halve;
    }
    return Outcome::accepted;
  }

  /// Values at all points of a degree. False if it takes too many calls.
  bool sample(const ChebyshevPiece& piece, int degree, Matrix& values) {
    for (int j = 0; j <= degree; ++j) {
      const double x = chebyshev_point(j, degree);
      // The ends exactly: neighbouring pieces share them.
      const double p = j == 0        ? piece.to
                       : j == degree ? piece.from
                                     : 0.5 * (piece.from + piece.to) + 0.5 * (piece.to - piece.from) * x;
      const Vector* value = at(p);
      if (value == nullptr) return false;
      values.resize(value->size(), degree + 1);
      values.col(j) = *value;
    }
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

  /// Error of the polynomial of half the degree at the points that are new in this one. Notes the function
  /// with the largest one.
  double error_at_new_points(const Matrix& half, const Matrix& values, int degree) {
    error_ = 0.0;
    for (int j = 1; j < degree; j += 2) {
      Eigen::Index worst = 0;
      const double error = relative(values.col(j) - value_at(half, chebyshev_point(j, degree)), &worst);
      if (error > error_) {
        error_ = error;
        worst_ = worst;
      }
    }
    return error_;
  }

  /// The largest of the errors, relative to the largest magnitudes of the functions. Errors that are rounding
  /// do not count.
  double relative(const Vector& errors, Eigen::Index* worst = nullptr) const {
    const Vector allowed = rounding_(largest_);
    double largest = 0.0;
    for (Eigen::Index i = 0; i < errors.size(); ++i) {
      const double error = std::abs(errors[i]) <= allowed[i] ? 0.0 : std::abs(errors[i]) / largest_[i];
      if (!(error > largest)) continue;
      largest = error;
      if (worst != nullptr) *worst = i;
    }
    return largest;
  }

  /// The largest of `count` columns of the coefficients.
  double largest_of(const Matrix& coefficients, Eigen::Index first, Eigen::Index count) const {
    double largest = 0.0;
    for (Eigen::Index j = first; j < first + count; ++j)
      largest = std::max(largest, relative(coefficients.col(j)));
    return largest;
  }

  /// The error of a polynomial is the sum of the coefficients beyond it, which decrease about as its last
  /// ones do, and about the square of that of half its degree. The first alone says nothing where
  /// coefficients vanish by symmetry; the second alone is too large by far for functions that oscillate. At a
  /// kink neither is true, and only what is measured counts.
  bool is_resolved(const Matrix& coefficients, double missed) const {
    if (measured_safety * missed <= options_.tolerance) return true;
    if (missed * missed > far_too_large * options_.tolerance) return false;
    const Eigen::Index count = std::max<Eigen::Index>(4, coefficients.cols() / 4);
    const double last = largest_of(coefficients, coefficients.cols() - count, count);
    if (last == 0.0) return true;
    const double factor = last / largest_of(coefficients, coefficients.cols() - 2 * count, count);
    const double beyond = static_cast<double>(count) * last * factor / (1.0 - factor);
    if (!(factor < 1.0) || beyond > std::pow(missed, faster)) return false;
    return beyond_safety * beyond <= options_.tolerance;
  }

  /// Whether the last degree will not do if the coefficients go on decreasing as the last quarter of them
  /// does.
  bool is_hopeless(const Matrix& coefficients) const {
    const Eigen::Index degree = coefficients.cols() - 1;
    const Eigen::Index quarter = degree / 4;
    const double last = largest_of(coefficients, degree + 1 - quarter, quarter);
    const double before = largest_of(coefficients, degree + 1 - 2 * quarter, quarter);
    if (last == 0.0) return false;
    const double predicted = last * std::pow(last / before, 4.0 * (last_degree - degree) / degree);
    return predicted > far_too_large * options_.tolerance;
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
