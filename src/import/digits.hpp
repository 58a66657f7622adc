// Significant digits that the entries of samples show.
#pragma once

#include <optional>

#include "eigentrail/model/sampled_data.hpp"

namespace eigentrail {

/// The number of digits, 3 to 7, to which all entries of all samples were rounded; empty if there is none, or
/// too few entries to tell. Decimal numbers with that many digits do not come up by chance.
std::optional<int> digits_of(const SampledData& data);

}  // namespace eigentrail
