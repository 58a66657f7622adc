#pragma once

#include <string>

namespace eigentrail {

/// Version of the library, "major.minor.patch".
std::string version();

}  // namespace eigentrail
