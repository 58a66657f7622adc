// The choice of modes as a table of a scene: modes = { count = 12, band = ["0.05 Hz", "3 Hz"] }.
#pragma once

#include "eigentrail/modes/mode_choice.hpp"
#include "eigentrail/scene/scene.hpp"

namespace eigentrail {

/// Reads the table. Frequencies are texts with a unit, or numbers in rad/s. Throws InputError with the place
/// of a fault.
ModeChoice read_mode_choice(TableReader table);

}  // namespace eigentrail
