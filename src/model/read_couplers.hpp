// Linear relations of the motions of joints: [[coupler]] and [[gear]]. The joints are read before.
#pragma once

#include "model/draft.hpp"

namespace eigentrail {

std::vector<ConstraintRow> read_coupler(Draft& draft, TableReader& table, JointMotions& motions);
std::vector<ConstraintRow> read_gear(Draft& draft, TableReader& table, JointMotions& motions);

}  // namespace eigentrail
