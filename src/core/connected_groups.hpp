// Connected components of a graph whose edges a function tells.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// Groups of indices, each in ascending order.
using Groups = std::vector<std::vector<Eigen::Index>>;

/// Groups of the indices 0 ... count - 1 that are connected, directly or by others. `connected(i, j)` is
/// called for j < i that are not known to be in one group. Cost: O(count^2) calls.
template <class Connected>
Groups connected_groups(Eigen::Index count, const Connected& connected) {
  std::vector<Eigen::Index> labels(static_cast<std::size_t>(count));
  std::iota(labels.begin(), labels.end(), Eigen::Index{0});
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      const Eigen::Index a = labels[static_cast<std::size_t>(i)];
      const Eigen::Index b = labels[static_cast<std::size_t>(j)];
      if (a != b && connected(i, j)) std::replace(labels.begin(), labels.end(), a, b);
    }
  }
  Groups groups(labels.size());
  for (Eigen::Index i = 0; i < count; ++i)
    groups[static_cast<std::size_t>(labels[static_cast<std::size_t>(i)])].push_back(i);
  std::erase_if(groups, [](const auto& members) { return members.empty(); });
  return groups;
}

}  // namespace eigentrail
