// Sums of constant matrices with factors that are power series along the path: what the matrices of families
// are.
#pragma once

#include <cmath>
#include <iterator>
#include <vector>

#include "eigentrail/model/model.hpp"

namespace eigentrail {

/// The parameters along a path, in SI units.
template <class Real, int Q>
std::vector<Series<Real, Q>> si_series(const Parameters& parameters, const BasicPath<Real>& path) {
  std::vector<Series<Real, Q>> si(parameters.size());
  for (std::size_t i = 0; i < si.size(); ++i) {
    for (int k = 0; k <= Q; ++k) si[i][k] = coefficient(path.parameters, static_cast<Eigen::Index>(i), k);
  }
  parameters.to_si(std::span<Series<Real, Q>>(si));
  return si;
}

/// A sum up to h^order. Its coefficients are of the dense or sparse type `Coefficient`.
template <class Coefficient, int Q>
class SeriesSum {
 public:
  using Real = typename Coefficient::Scalar;
  using Factor = Series<Real, Q>;
  using Coefficients = typename BasicLinearization<Real>::Coefficients;

  SeriesSum(Eigen::Index rows, Eigen::Index columns, int order) : order_(order), zero_(rows, columns) {
    zero_.setZero();
    coefficients_.push_back(zero_);
  }

  /// Adds `factor` times a matrix of doubles. Coefficients that no factor has are not made: zero matrices
  /// would cost as much as others.
  void add(const Factor& factor, const auto& matrix) {
    using std::isfinite;
    for (int k = 0; k <= order_; ++k) {
      finite_ = finite_ && isfinite(factor[k]);
      if (factor[k] == Real(0.0)) continue;
      const auto at = static_cast<std::size_t>(k);
      if (coefficients_.size() <= at) coefficients_.resize(at + 1, zero_);
      coefficients_[at] += factor[k] * matrix.template cast<Real>();
    }
  }

  /// Whether all factors are finite.
  bool is_finite() const { return finite_; }

  /// The coefficients without trailing ones that are zero, so a constant has one. May be called once.
  Coefficients take() {
    Coefficients result(std::make_move_iterator(coefficients_.begin()),
                        std::make_move_iterator(coefficients_.end()));
    while (result.size() > 1 && result.back().is_zero()) result.pop_back();
    return result;
  }

 private:
  int order_;
  Coefficient zero_;
  std::vector<Coefficient> coefficients_;
  bool finite_ = true;
};

/// A sum of dense matrices.
template <class Real, int Q>
using DenseSum = SeriesSum<Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>, Q>;

}  // namespace eigentrail
