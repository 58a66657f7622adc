// Reads [rotor]: N equal blades, of which the scene describes one, on a hub that is a body of a support.
#pragma once

#include "model/draft.hpp"

namespace eigentrail {

/// Reads [rotor], after all points and bodies; nothing if the scene has none. Throws InputError for fewer
/// than three blades and for a hub that is not on the z axis with its own z axis along it.
std::optional<BladedRotorDraft> read_bladed_rotor(Draft& draft);

/// Speed of the rotor, about +z, from the angular velocity of [frame], which must be along z.
Expression rotor_speed(const Draft& draft, const std::optional<ExpressionVector>& rotation);

/// Keys of [rotor], for the reference.
std::vector<FieldHelp> bladed_rotor_fields();

}  // namespace eigentrail
