// What a scene says of modes: which are followed, and what they are called.
#pragma once

#include <set>
#include <vector>

#include "eigentrail/modes/given_names.hpp"
#include "eigentrail/modes/mode_choice.hpp"
#include "eigentrail/scene/scene.hpp"

namespace eigentrail {

/// Reads the choice of modes as a table: modes = { count = 12, band = ["0.05 Hz", "3 Hz"] }. Frequencies are
/// texts with a unit, or numbers in rad/s. Throws InputError with the place of a fault.
ModeChoice read_mode_choice(TableReader table);

/// The names that the scene gives to modes in [modes]; none without that table. Throws InputError with the
/// place of a fault.
std::vector<GivenName> read_mode_names(const Scene& scene, std::set<int>& used);

}  // namespace eigentrail
