// What importers have in common.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "eigentrail/import/importer.hpp"

namespace eigentrail {

/// The name of the parameter: that of the option, else `otherwise`. Throws InputError if it cannot be one.
std::string parameter_option(const ImportRequest& request, const std::string& otherwise);

/// The option as a number, which may be `negative` or not; `otherwise` if it is not given. Throws InputError.
double number_option(const ImportRequest& request, const std::string& name, double otherwise, bool negative);

/// The matrices of which there are samples: "A" or "M, C, K".
std::string matrices_in(const SampledData& data);

/// The number of digits, 3 to 7, to which all entries of all samples were rounded; empty if there is none, or
/// too few entries to tell. Decimal numbers with that many digits do not come up by chance.
std::optional<int> digits_of(const SampledData& data);

/// Notes in samples the digits that the option --digits says, a number from 1 to 17 or all; without it
/// `known` ones, or else as many as the entries show. Returns a sentence for the user; empty if the entries
/// count as exact. Throws InputError.
std::string note_digits(SampledData& data, const std::map<std::string, std::string>& options,
                        std::optional<int> known = std::nullopt);
/// Name and help of the option.
std::pair<const std::string, std::string> digits_help();

/// Notes digits, of which some may be known, and source of the samples. Throws InputError that begins with
/// `file` if the samples do not fit each other.
void finish_samples(Imported& imported, const ImportRequest& request, const std::string& file,
                    std::optional<int> known_digits = std::nullopt);

/// Throws InputError that begins with `file` if the samples do not fit each other.
void require_fit(const SampledData& data, const std::string& file);

}  // namespace eigentrail
