// Reads the table [parameters] of a scene.
#pragma once

#include <optional>

#include "eigentrail/scene/scene.hpp"

namespace eigentrail {

/// Whether expressions can use a text as a name: letters, digits and '_', no digit first.
bool is_parameter_name(std::string_view text);

/// The parameters of a table, their units and dimensions, and `implied` if the table does not declare it.
/// Throws InputError.
Parameters read_parameters(const Scene& scene, const Table& table, const std::optional<Parameter>& implied);

}  // namespace eigentrail
