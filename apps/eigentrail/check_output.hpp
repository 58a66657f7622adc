// Whether a command may write to the file that it was given.
#pragma once

#include <functional>
#include <string>

namespace eigentrail::app {

/// What a command writes.
struct OutputFormat {
  std::string attribute;  ///< the HDF5 attribute "format"
  std::string name;       ///< for messages: "loci file"
};

/// What a command writes when it is no HDF5 file.
struct OtherOutput {
  std::function<bool(const std::string& path)> replaces;  ///< whether it may replace an existing file
  std::string name;                                       ///< for messages: "report"
};

/// Refuses folders, names in folders that do not exist, and existing files unless `force` is given and they
/// are of the format that replaces them. Throws InputError.
void check_output(const std::string& path, bool force, const OutputFormat& format);
void check_output(const std::string& path, bool force, const OtherOutput& output);

}  // namespace eigentrail::app
