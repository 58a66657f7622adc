// Members of a block: indices of its eigenvalues, ascending, and the modes that they are.
#pragma once

#include <vector>

#include "eigentrail/continuation/path_point.hpp"

namespace eigentrail {

/// The modes among members of a block, ascending, each once; members that are no modes are left out.
std::vector<int> sorted_modes(const std::vector<int>& modes);

/// Elements of either list, ascending; both are ascending.
std::vector<int> united(const std::vector<int>& a, const std::vector<int>& b);

/// The eigenvalues of a track with these indices.
std::vector<Complex> roots_of(const Track& track, const std::vector<int>& members);

}  // namespace eigentrail
