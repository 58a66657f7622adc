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

/// What the option --digits says: a number from 1 to 17, or all (empty).
struct DigitsOption {
  bool given = false;
  std::optional<int> digits = {};
};
/// Throws InputError.
DigitsOption digits_option(const std::map<std::string, std::string>& options);
/// Name and help of the option.
std::pair<const std::string, std::string> digits_help();
/// A sentence for the user. `given`: by the option.
std::string digits_text(int digits, bool given);

}  // namespace eigentrail
