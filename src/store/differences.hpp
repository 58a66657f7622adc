// Messages on what differs between a run that is recorded in a file and another one.
#pragma once

#include <string>

#include "eigentrail/store/part_file.hpp"

namespace eigentrail {

/// "line 3 was 'a' and is 'b'": the first line in which two texts differ. Where one text has ended, its line
/// counts as empty.
std::string first_difference(const std::string& before, const std::string& now);

/// Throws InputError, which says that `path` cannot be resumed, unless an interrupted run had the settings
/// that this one has: "version", "scene", "files of the scene" and options.
void require_same_run(const std::string& path, const Settings& before, const Settings& now);

/// The bytes of a file. Throws InputError if it cannot be read.
std::string bytes_of_file(const std::string& path);

}  // namespace eigentrail
