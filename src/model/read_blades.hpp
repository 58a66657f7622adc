// Reads [[blade]]: a beam on a hub, placed by hub radius, azimuth, precone and pitch, with damping ratios.
#pragma once

#include "model/draft.hpp"

namespace eigentrail {

/// Adds the blades to the beams. Bodies must have been read.
void read_blades(Draft& draft);

std::vector<FieldHelp> blade_fields();

}  // namespace eigentrail
