// Motions that no force holds or damps: freedoms with mass only, such as those of a body in space.
#pragma once

#include <vector>

#include "eigentrail/reduction/independent_parts.hpp"

namespace eigentrail {

/// Replaces the coordinates of the free motions among the parts, which are arbitrary where there are several,
/// by simple ones: each moves as few coordinates of the system as possible, and they stay independent in
/// mass. Nothing is changed where that is impossible. `masses`: all M of the system, n x n.
void simplify_free_motions(const std::vector<Matrix>& masses, IndependentParts& parts);

}  // namespace eigentrail
