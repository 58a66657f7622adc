#include "check_output.hpp"

#include <filesystem>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/store/output_file.hpp"

namespace eigentrail::app {

void check_output(const std::string& path, bool force, const OutputFormat& format) {
  const auto replaces = [&](const std::string& existing) {
    return may_be_replaced(existing, format.attribute);
  };
  check_output(path, force, OtherOutput{replaces, format.name});
}

void check_output(const std::string& path, bool force, const OtherOutput& output) {
  if (path.empty()) throw InputError("--output: expected the name of a file");
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw InputError(path + ": is a folder; give the name of a file");
  if (std::filesystem::exists(std::filesystem::symlink_status(path, error))) {
    if (!force) throw InputError(path + ": exists already; give another name, or --force to replace it");
    if (!output.replaces(path))
      throw InputError(path + ": is no readable " + output.name + "; --force replaces nothing else");
  }
  const auto folder = std::filesystem::path(path).parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder, error))
    throw InputError(path + ": the folder " + folder.string() + " does not exist");
}

}  // namespace eigentrail::app
