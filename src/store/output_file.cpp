#include "eigentrail/store/output_file.hpp"

#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "core/hdf5_file.hpp"
#include "eigentrail/core/errors.hpp"

namespace eigentrail {
namespace {

/// A name of this process alone: nothing that stands there is touched.
std::string partial_name(const std::string& path) {
  return path + ".partial." + std::to_string(getpid());
}

}  // namespace

bool may_be_replaced(const std::string& path, const std::string& format) {
  try {
    const Hdf5File file = Hdf5File::open(path);
    return file.has_attribute("format") && file.text_attribute("format") == format;
  } catch (const Hdf5Error&) {
    return false;
  }
}

void check_can_create(const std::string& path) {
  const std::string partial = partial_name(path);
  try {
    Hdf5File::create(partial).flush();
  } catch (const Hdf5Error& error) {
    throw InputError(path + ": cannot be created: " + error.what());
  }
  std::remove(partial.c_str());
}

void write_complete(const std::string& path, const std::function<void(const std::string& partial)>& write) {
  const std::string partial = partial_name(path);
  try {
    write(partial);
    std::filesystem::rename(partial, path);
  } catch (...) {
    std::remove(partial.c_str());
    throw;
  }
}

}  // namespace eigentrail
