// Reads the scene's [modes] table.
#pragma once

#include <set>
#include <vector>

#include "eigentrail/modes/given_names.hpp"
#include "eigentrail/scene/scene.hpp"

namespace eigentrail {

/// The names that the scene gives to modes; none without [modes]. Throws InputError with the place of a
/// fault.
std::vector<GivenName> read_mode_names(const Scene& scene, std::set<int>& used);

}  // namespace eigentrail
