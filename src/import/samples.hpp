// What importers of samples have in common.
#pragma once

#include <optional>
#include <string>

#include "eigentrail/import/importer.hpp"

namespace eigentrail {

/// The name of the parameter: that of the option, else `otherwise`. Throws InputError if it cannot be one.
std::string parameter_option(const ImportRequest& request, const std::string& otherwise);

/// Notes digits, of which some may be known, and source of the samples. Throws InputError that begins with
/// `file` if the samples do not fit each other.
void finish_samples(Imported& imported, const ImportRequest& request, const std::string& file,
                    std::optional<int> known_digits = std::nullopt);

/// Throws InputError that begins with `file` if the samples do not fit each other.
void require_fit(const SampledData& data, const std::string& file);

}  // namespace eigentrail
