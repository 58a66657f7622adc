// A scalar that writes down what is computed with it. A force that is a template over its scalar becomes a
// list of operations (record.hpp) when it is called once with this scalar.
//
// Recorded values have no number, so they cannot be compared: what depends on numbers is an operation (`abs`,
// `min`, `max`, `step`), which chooses for every element in every evaluation.
#pragma once

#include <Eigen/Core>

#include "eigentrail/core/series.hpp"
#include "model/record/record.hpp"

namespace eigentrail {

class Recorder;

/// A literal of the source, or the result of an operation of a recorder.
class Recorded {
 public:
  Recorded(double literal = 0.0) : literal_(literal) {}  // NOLINT: numbers of the source are scalars
  Recorded(Recorder& recorder, int node) : recorder_(&recorder), node_(node) {}

  Recorder* recorder() const { return recorder_; }  ///< null: a literal
  int node() const { return node_; }
  double literal() const { return literal_; }
  bool is_literal(double value) const { return recorder_ == nullptr && literal_ == value; }

  Recorded& operator+=(const Recorded& b) { return *this = *this + b; }
  Recorded& operator-=(const Recorded& b) { return *this = *this - b; }
  Recorded& operator*=(const Recorded& b) { return *this = *this * b; }
  Recorded& operator/=(const Recorded& b) { return *this = *this / b; }

  /// An operation on values of which one at least is recorded; else throws std::logic_error.
  static Recorded of(Operator op, const Recorded& x);
  static Recorded of(Operator op, const Recorded& a, const Recorded& b);

  // Literals are computed at once. Sums with zero and products with zero or one are no operations.
  friend Recorded operator+(const Recorded& a, const Recorded& b) {
    if (a.is_literal(0.0)) return b;
    if (b.is_literal(0.0)) return a;
    return recorder_of(a, b) == nullptr ? a.literal() + b.literal() : of(Operator::add, a, b);
  }
  friend Recorded operator-(const Recorded& a, const Recorded& b) {
    if (a.is_literal(0.0)) return -b;
    if (b.is_literal(0.0)) return a;
    return recorder_of(a, b) == nullptr ? a.literal() - b.literal() : of(Operator::subtract, a, b);
  }
  friend Recorded operator*(const Recorded& a, const Recorded& b) {
    if (a.is_literal(0.0) || b.is_literal(0.0)) return 0.0;
    if (a.is_literal(1.0)) return b;
    if (b.is_literal(1.0)) return a;
    if (a.is_literal(-1.0)) return -b;
    if (b.is_literal(-1.0)) return -a;
    return recorder_of(a, b) == nullptr ? a.literal() * b.literal() : of(Operator::multiply, a, b);
  }
  friend Recorded operator/(const Recorded& a, const Recorded& b) {
    if (a.is_literal(0.0) && b.recorder() != nullptr) return 0.0;
    if (b.is_literal(1.0)) return a;
    return recorder_of(a, b) == nullptr ? a.literal() / b.literal() : of(Operator::divide, a, b);
  }
  friend Recorded operator-(const Recorded& a) {
    return a.recorder() == nullptr ? Recorded(-a.literal()) : of(Operator::negate, a);
  }

  friend Recorded sqrt(const Recorded& x) { return of(Operator::sqrt, x); }
  friend Recorded exp(const Recorded& x) { return of(Operator::exp, x); }
  friend Recorded log(const Recorded& x) { return of(Operator::log, x); }
  friend Recorded sin(const Recorded& x) { return of(Operator::sin, x); }
  friend Recorded cos(const Recorded& x) { return of(Operator::cos, x); }
  friend Recorded tan(const Recorded& x) { return sin(x) / cos(x); }
  friend Recorded sinh(const Recorded& x) { return of(Operator::sinh, x); }
  friend Recorded cosh(const Recorded& x) { return of(Operator::cosh, x); }
  friend Recorded tanh(const Recorded& x) { return of(Operator::tanh, x); }
  friend Recorded asin(const Recorded& x) { return of(Operator::asin, x); }
  friend Recorded acos(const Recorded& x) { return of(Operator::acos, x); }
  friend Recorded atan(const Recorded& x) { return of(Operator::atan, x); }

  /// x^y for x > 0. If y is constant along the path and an integer with |y| <= 64, for every x.
  friend Recorded pow(const Recorded& x, const Recorded& y) { return of(Operator::power, x, y); }

  friend Recorded min(const Recorded& a, const Recorded& b) { return of(Operator::min, a, b); }
  friend Recorded max(const Recorded& a, const Recorded& b) { return of(Operator::max, a, b); }
  /// 1 for x >= 0, else 0. Constant on either side.
  friend Recorded step(const Recorded& x) { return of(Operator::step, x); }
  friend Recorded abs(const Recorded& x) { return (2.0 * step(x) - 1.0) * x; }

 private:
  static Recorder* recorder_of(const Recorded& a, const Recorded& b) {
    return a.recorder_ != nullptr ? a.recorder_ : b.recorder_;
  }

  Recorder* recorder_ = nullptr;
  int node_ = -1;
  double literal_ = 0.0;
};

/// Angle (rad) of the vector (cosine, sine), as the function of series of this name.
Recorded angle_of(const Recorded& sine, const Recorded& cosine);

/// f(x) for a function that is known by its Taylor coefficients. It must outlive all evaluations.
Recorded apply(const SmoothFunction& f, const Recorded& x);

}  // namespace eigentrail

template <>
struct Eigen::NumTraits<eigentrail::Recorded> : Eigen::GenericNumTraits<double> {
  using Real = eigentrail::Recorded;
  using NonInteger = eigentrail::Recorded;
  using Nested = eigentrail::Recorded;
  using Literal = double;
  enum { RequireInitialization = 1, ReadCost = 1, AddCost = 1, MulCost = 1 };
};
template <class Operation>
struct Eigen::ScalarBinaryOpTraits<eigentrail::Recorded, double, Operation> {
  using ReturnType = eigentrail::Recorded;
};
template <class Operation>
struct Eigen::ScalarBinaryOpTraits<double, eigentrail::Recorded, Operation> {
  using ReturnType = eigentrail::Recorded;
};
