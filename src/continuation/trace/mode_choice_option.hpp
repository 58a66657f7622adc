// The choice of modes as a table of a scene: modes = { count = 12, band = ["0.05 Hz", "3 Hz"] }.
#pragma once

#include <string>

#include "eigentrail/modes/mode_choice.hpp"
#include "eigentrail/scene/scene.hpp"

namespace eigentrail {

/// The number of a key of a table, which may not depend on parameters. Throws InputError if it does.
double constant_number(TableReader& table, const std::string& key);

/// Reads the table. Frequencies are texts with a unit, or numbers in rad/s. Throws InputError with the place
/// of a fault.
ModeChoice read_mode_choice(TableReader table);

}  // namespace eigentrail
