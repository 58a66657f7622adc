// Messages on what differs between a run that is recorded in a file and another one.
#pragma once

#include <string>

namespace eigentrail {

/// "line 3 was 'a' and is 'b'": the first line in which two texts differ. Where one text has ended, its line
/// counts as empty.
std::string first_difference(const std::string& before, const std::string& now);

/// The bytes of a file. Throws InputError if it cannot be read.
std::string bytes_of_file(const std::string& path);

}  // namespace eigentrail
