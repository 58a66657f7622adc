// What importers have in common.
#pragma once

#include <optional>
#include <string>

#include "eigentrail/import/importer.hpp"

namespace eigentrail {

/// The name of the parameter: that of the option, else `otherwise`. Throws InputError if it cannot be one.
std::string parameter_option(const ImportRequest& request, const std::string& otherwise);

/// The option as a number, which may be `negative` or not; `otherwise` if it is not given. Throws InputError.
double number_option(const ImportRequest& request, const std::string& name, double otherwise, bool negative);

/// The matrices of which there are samples: "A" or "M, C, K".
std::string matrices_in(const SampledData& data);

/// Notes digits, of which some may be known, and source of the samples. Throws InputError that begins with
/// `file` if the samples do not fit each other.
void finish_samples(Imported& imported, const ImportRequest& request, const std::string& file,
                    std::optional<int> known_digits = std::nullopt);

/// Throws InputError that begins with `file` if the samples do not fit each other.
void require_fit(const SampledData& data, const std::string& file);

}  // namespace eigentrail
