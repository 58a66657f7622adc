// Whether a command may write to the file that it was given.
#pragma once

#include <string>

namespace eigentrail::app {

/// What a command writes.
struct OutputFormat {
  std::string attribute;  ///< the HDF5 attribute "format"
  std::string name;       ///< for messages: "loci file"
};

/// Refuses folders, names in folders that do not exist, and existing files unless `force` is given and they
/// are of the format that replaces them. Throws InputError.
void check_output(const std::string& path, bool force, const OutputFormat& format);

}  // namespace eigentrail::app
