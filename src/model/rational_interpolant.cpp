#include "model/rational_interpolant.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace eigentrail {
namespace {

/// Weight of node k (Eq. 18 of the source), in units of the mean distance of the nodes. The products would
/// over- or underflow in other units.
double weight(const std::vector<double>& nodes, int degree, int k) {
  const int last = static_cast<int>(nodes.size()) - 1;
  const double unit = (nodes.back() - nodes.front()) / std::max(last, 1);
  double sum = 0.0;
  for (int i = std::max(0, k - degree); i <= std::min(last - degree, k); ++i) {
    double product = 1.0;
    for (int j = i; j <= i + degree; ++j) {
      const auto at = [&nodes](int index) { return nodes[static_cast<std::size_t>(index)]; };
      if (j != k) product *= unit / std::abs(at(k) - at(j));
    }
    sum += product;
  }
  return k % 2 == 0 ? sum : -sum;
}

}  // namespace

RationalInterpolant::RationalInterpolant(std::vector<double> nodes, int degree, Denominator denominator)
    : nodes_(std::move(nodes)), degree_(degree), denominator_(std::move(denominator)) {
  const int count = static_cast<int>(nodes_.size());
  if (degree < denominator_.degree() || degree >= count)
    throw std::invalid_argument("RationalInterpolant: degree " + std::to_string(degree) + " with " +
                                std::to_string(count) + " nodes and " +
                                std::to_string(denominator_.degree()) + " poles");
  double largest = 0.0;
  for (const double node : nodes_) largest = std::max(largest, denominator_(node));
  for (int k = 0; k < count; ++k)
    weights_.push_back(weight(nodes_, degree, k) * denominator_(nodes_[static_cast<std::size_t>(k)]) /
                       largest);
}

Vector RationalInterpolant::values(double x) const {
  const std::vector<double> all = basis(x);
  return Eigen::Map<const Vector>(all.data(), static_cast<Eigen::Index>(all.size()));
}

double RationalInterpolant::error_factor(double x) const {
  double sum = 0.0;
  for (std::size_t j = 0; j < nodes_.size(); ++j) sum += weights_[j] / (x - nodes_[j]);
  return 1.0 / std::abs(sum);
}

std::size_t RationalInterpolant::nearest(double x) const {
  const auto above = std::lower_bound(nodes_.begin(), nodes_.end(), x);
  if (above == nodes_.begin()) return 0;
  if (above == nodes_.end()) return nodes_.size() - 1;
  const auto at = static_cast<std::size_t>(above - nodes_.begin());
  return x - nodes_[at - 1] < nodes_[at] - x ? at - 1 : at;
}

}  // namespace eigentrail
