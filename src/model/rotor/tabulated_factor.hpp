// A function of one number that is known at single places and interpolated between them.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "model/sample_interpolation.hpp"

namespace eigentrail {

class TabulatedFactor {
 public:
  /// `values`: at the nodes of the interpolant, which all columns of a table share. `exact`: the interpolant
  /// is the function itself.
  TabulatedFactor(std::shared_ptr<const SamplePiece> piece, std::vector<double> values, bool exact)
      : piece_(std::move(piece)), values_(std::move(values)), is_exact_(exact) {}

  const std::shared_ptr<const SamplePiece>& piece() const { return piece_; }
  const std::vector<double>& values() const { return values_; }
  bool is_exact() const { return is_exact_; }

  /// The function at x, a number or a power series about one; not a number outside the table.
  template <class Scalar>
  Scalar operator()(const Scalar& x) const {
    const std::vector<double>& nodes = piece_->interpolant.nodes();
    const double at = leading_value(x);
    const double slack = 1e-12 * (nodes.back() - nodes.front());
    if (!(at >= nodes.front() - slack && at <= nodes.back() + slack))
      return Scalar(std::numeric_limits<double>::quiet_NaN());
    const std::vector<Scalar> basis = piece_->interpolant.basis(x);
    Scalar sum(0.0);
    for (std::size_t i = 0; i < basis.size(); ++i) sum += basis[i] * Scalar(values_[i]);
    return sum;
  }

 private:
  std::shared_ptr<const SamplePiece> piece_;
  std::vector<double> values_;
  bool is_exact_;
};

}  // namespace eigentrail
