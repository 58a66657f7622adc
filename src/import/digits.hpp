// Significant digits that the entries of samples show.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>

#include "eigentrail/model/sampled_data.hpp"

namespace eigentrail {

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

}  // namespace eigentrail
