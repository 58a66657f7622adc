// What a file of samples holds, for `info`.
#pragma once

#include <string>

namespace eigentrail::app {

/// Prints the parameter, the matrices, and what is known of the states and the digits. Throws InputError if
/// the file cannot be used.
void print_samples(const std::string& path, bool json);

}  // namespace eigentrail::app
