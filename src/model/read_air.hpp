// Reads the tables of wings and blades in moving air: [[strips]], [[lift_lag]], [[apparent_mass]].
#pragma once

#include <optional>

#include "model/read_inflow.hpp"

namespace eigentrail {

/// Adds the inflows of rotors, and everything on strips; beams and bodies must have been read. `rotation` is
/// the angular velocity of the frame.
void read_air(Draft& draft, const std::optional<ExpressionVector>& rotation,
              std::vector<InflowDraft>& inflows);

/// Keys of these tables.
std::vector<FieldHelp> strips_fields();
std::vector<FieldHelp> lift_lag_fields();
std::vector<FieldHelp> apparent_mass_fields();

}  // namespace eigentrail
