// What a file of samples holds, for `info`.
#pragma once

#include <string>

#include "eigentrail/model/sampled_data.hpp"

namespace eigentrail::app {

/// Reads a file of samples. Throws InputError with its name if it cannot be used.
SampledData samples_in(const std::string& path);

/// Prints the parameter, the matrices, and what is known of the states and the digits. Throws InputError if
/// the file cannot be used.
void print_samples(const std::string& path, bool json);

}  // namespace eigentrail::app
