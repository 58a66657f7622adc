// Messages on what differs between a run that is recorded in a file and another one.
#pragma once

#include <string>

#include "eigentrail/store/part_file.hpp"

namespace eigentrail {

/// What has changed from one run's settings to another's, in words: "scene: line 3 was 'a' and is 'b'; to:
/// was '5' and is '6'".
std::string changes(const Settings& before, const Settings& now);

/// Throws InputError with the changes, unless there are none: the file of an interrupted run cannot be
/// resumed.
void require_same_run(const std::string& path, const Settings& before, const Settings& now);

}  // namespace eigentrail
