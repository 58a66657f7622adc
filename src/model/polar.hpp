// Lift, drag and moment coefficients of an airfoil over the angle of attack, from a table.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <vector>

#include "model/sample_interpolation.hpp"

namespace eigentrail {

template <class Scalar>
struct PolarPoint {
  Scalar lift, drag, moment;
};

/// Smooth functions through the rows of a table. The basis of their interpolant is evaluated once for all.
class Polar {
 public:
  /// `values`: of lift, drag and moment at the nodes; empty: zero.
  Polar(std::shared_ptr<const SamplePiece> piece, std::array<std::vector<double>, 3> values)
      : piece_(std::move(piece)), values_(std::move(values)) {}

  /// The coefficients at an angle, rad; not numbers outside the table.
  template <class Scalar>
  PolarPoint<Scalar> at(const Scalar& angle) const {
    const std::vector<double>& nodes = piece_->interpolant.nodes();
    const double where = leading_value(angle);
    if (!(where >= nodes.front() && where <= nodes.back())) {
      const Scalar outside(std::numeric_limits<double>::quiet_NaN());
      return {outside, outside, outside};
    }
    const std::vector<Scalar> basis = piece_->interpolant.basis(angle);
    std::array<Scalar, 3> sums{};
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t i = 0; i < values_[k].size(); ++i) sums[k] += values_[k][i] * basis[i];
    }
    return {sums[0], sums[1], sums[2]};
  }

 private:
  std::shared_ptr<const SamplePiece> piece_;
  std::array<std::vector<double>, 3> values_;
};

}  // namespace eigentrail
