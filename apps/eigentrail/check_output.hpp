// Checks whether a command may write its output file.
#pragma once

#include <functional>
#include <string>

#include "eigentrail/store/output_file.hpp"

namespace eigentrail::app {

/// The format of an HDF5 output file.
struct OutputFormat {
  std::string attribute;  ///< the HDF5 attribute "format"
  std::string name;       ///< for messages: "loci file"
};

/// The format of an output file that is not HDF5.
struct OtherOutput {
  std::function<bool(const std::string& path)> replaces;  ///< whether it may replace an existing file
  std::string name;                                       ///< for messages: "report"
};

/// Throws InputError if `path` is empty, is a folder, lies in a folder that does not exist, or is an existing
/// file that may not be replaced. An existing file may be replaced only with `force`, and only if it has the
/// same format.
void check_output(const std::string& path, bool force, const OutputFormat& format);
void check_output(const std::string& path, bool force, const OtherOutput& output);

/// What writing does to a file that is there.
inline Existing existing(bool force) {
  return force ? Existing::replace : Existing::keep;
}

}  // namespace eigentrail::app
