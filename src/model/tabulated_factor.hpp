// A function of one number that is known at single places and interpolated between them.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "model/record/smooth_function.hpp"
#include "model/sample_interpolation.hpp"

namespace eigentrail {

/// The function is not a number outside the table.
class TabulatedFactor final : public SmoothFunction {
 public:
  /// `values`: at the nodes of the interpolant, which all columns of a table share. `exact`: the interpolant
  /// is the function itself.
  TabulatedFactor(std::shared_ptr<const SamplePiece> piece, std::vector<double> values, bool exact)
      : piece_(std::move(piece)), values_(std::move(values)), is_exact_(exact) {}

  const std::shared_ptr<const SamplePiece>& piece() const { return piece_; }
  const std::vector<double>& values() const { return values_; }
  bool is_exact() const { return is_exact_; }

  void taylor(double x, std::span<double> coefficients) const override {
    piece_->interpolant.taylor<double>(x, values_, coefficients);
  }
  void taylor(const Extended& x, std::span<Extended> coefficients) const override {
    piece_->interpolant.taylor<Extended>(x, values_, coefficients);
  }

 private:
  std::shared_ptr<const SamplePiece> piece_;
  std::vector<double> values_;
  bool is_exact_;
};

}  // namespace eigentrail
