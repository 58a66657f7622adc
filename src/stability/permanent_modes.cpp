#include "eigentrail/stability/permanent_modes.hpp"

#include <algorithm>
#include <cmath>

#include "stability/zero_level.hpp"

namespace eigentrail {
namespace {

constexpr std::size_t enough_points = 3;

const DenseBlock* block_of(const PathStep& step, int mode) {
  for (const DenseBlock& block : step.blocks) {
    if (std::find(block.modes.begin(), block.modes.end(), mode) != block.modes.end()) return &block;
  }
  return nullptr;
}

Permanence permanence(const RecordedPath& path, int mode, const EigenvalueAccuracy& accuracy) {
  bool exists = false;
  bool is_zero = true;
  bool is_constant = true;
  Complex first = 0.0;
  for (std::size_t node = 0; node < path.n_nodes(); ++node) {
    const auto row = static_cast<Eigen::Index>(node);
    const Complex s = path.eigenvalues(row, mode);
    if (std::isnan(s.real())) continue;
    if (!exists) first = s;
    exists = true;
    const DenseBlock* block = block_of(path.steps[std::min(node, path.steps.size() - 1)], mode);
    const bool in_block = block != nullptr && block->size() > 1;
    const double level = in_block ? zero_of_blocks(path.eigenvalues.row(row).transpose(), accuracy.reference)
                                  : vanishing_damping * accuracy.reference;
    is_zero = is_zero && std::abs(s) <= level;
    is_constant = is_constant &&
                  std::abs(s - first) <= accuracy.tolerance * std::max(std::abs(first), accuracy.reference);
  }
  if (!exists) return Permanence::none;
  return is_zero ? Permanence::zero : is_constant ? Permanence::constant : Permanence::none;
}

}  // namespace

std::vector<Permanence> permanence_of_modes(const RecordedPath& path, const EigenvalueAccuracy& accuracy) {
  std::vector<Permanence> all(static_cast<std::size_t>(path.eigenvalues.cols()), Permanence::none);
  if (path.n_nodes() < enough_points || path.steps.empty()) return all;
  for (std::size_t mode = 0; mode < all.size(); ++mode)
    all[mode] = permanence(path, static_cast<int>(mode), accuracy);
  return all;
}

}  // namespace eigentrail
