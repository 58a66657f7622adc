// Lift, drag and moment coefficients of an airfoil over the angle of attack, from a table.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "model/record/recorded.hpp"
#include "model/record/smooth_function.hpp"
#include "model/sample_interpolation.hpp"

namespace eigentrail {

/// The smooth function through the values of a column; not a number outside the table.
class PolarCurve final : public SmoothFunction {
 public:
  PolarCurve(std::shared_ptr<const SamplePiece> piece, std::vector<double> values)
      : piece_(std::move(piece)), values_(std::move(values)) {}

  void taylor(double x, std::span<double> coefficients) const override {
    piece_->interpolant.taylor<double>(x, values_, coefficients);
  }
  void taylor(const Extended& x, std::span<Extended> coefficients) const override {
    piece_->interpolant.taylor<Extended>(x, values_, coefficients);
  }

  bool is_empty() const { return values_.empty(); }

 private:
  std::shared_ptr<const SamplePiece> piece_;
  std::vector<double> values_;
};

/// Curves without values are zero.
struct Polar {
  PolarCurve lift, drag, moment;

  /// The value of one of them at an angle, rad.
  template <class Scalar>
  static Scalar value(const PolarCurve& curve, const Scalar& angle) {
    return curve.is_empty() ? Scalar(0.0) : apply(curve, angle);
  }
};

}  // namespace eigentrail
