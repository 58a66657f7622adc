// Reads [[trim]]: conditions at the equilibrium, and the parameters that they determine.
#pragma once

#include "model/read_inflow.hpp"

namespace eigentrail {

/// All [[trim]] tables, into draft.data.trims. Everything else must have been read: conditions refer to
/// points, joints, strips, springs and inflows by their names.
void read_trims(Draft& draft, const std::vector<InflowDraft>& inflows);

std::vector<FieldHelp> trim_fields();

/// The error for a scene whose model cannot be trimmed; `reason` completes "...: not in ".
InputError trim_error(const Scene& scene, const std::string& reason);

}  // namespace eigentrail
