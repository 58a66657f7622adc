#include "eigentrail/stability/permanent_modes.hpp"

#include <algorithm>
#include <cmath>

namespace eigentrail {
namespace {

constexpr std::size_t enough_points = 3;

Permanence permanence(const RecordedPath& path, int mode, const EigenvalueAccuracy& accuracy) {
  std::size_t points = 0;
  bool is_zero = true;
  bool is_constant = true;
  Complex first = 0.0;
  for (std::size_t node = 0; node < path.n_nodes(); ++node) {
    const auto row = static_cast<Eigen::Index>(node);
    const Complex s = path.eigenvalues(row, mode);
    if (std::isnan(s.real())) continue;
    if (points == 0) first = s;
    ++points;
    is_zero = is_zero && std::abs(s) <= path.rounding_at(node, mode);
    is_constant = is_constant &&
                  std::abs(s - first) <= accuracy.tolerance * std::max(std::abs(first), accuracy.reference);
  }
  if (points < enough_points) return Permanence::none;
  return is_zero ? Permanence::zero : is_constant ? Permanence::constant : Permanence::none;
}

}  // namespace

std::vector<Permanence> permanence_of_modes(const RecordedPath& path, const EigenvalueAccuracy& accuracy) {
  std::vector<Permanence> all(static_cast<std::size_t>(path.eigenvalues.cols()), Permanence::none);
  if (path.steps.empty()) return all;
  for (std::size_t mode = 0; mode < all.size(); ++mode)
    all[mode] = permanence(path, static_cast<int>(mode), accuracy);
  return all;
}

}  // namespace eigentrail
