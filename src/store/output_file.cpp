#include "eigentrail/store/output_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "core/hdf5_file.hpp"
#include "eigentrail/core/errors.hpp"

namespace eigentrail {
namespace {

/// A name for the temporary file that no other process uses.
std::string partial_name(const std::string& path) {
  return path + ".partial." + std::to_string(getpid());
}

[[noreturn]] void fail(const std::string& path) {
  throw std::system_error(errno, std::generic_category(), path);
}

/// A file descriptor that the destructor closes.
class Descriptor {
 public:
  Descriptor(std::string path, int flags)
      : path_(std::move(path)), number_(open(path_.c_str(), flags, 0666)) {
    if (number_ < 0) fail(path_);
  }
  ~Descriptor() { close(number_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  void write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t written = ::write(number_, bytes.data(), bytes.size());
      if (written < 0 && errno != EINTR) fail(path_);
      if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  /// Flushes the file to the disk. Does nothing on file systems that do not support this.
  void sync() {
    if (fsync(number_) != 0 && errno != EINVAL && errno != ENOTSUP) fail(path_);
  }

 private:
  std::string path_;
  int number_;
};

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
    Descriptor(partial, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC);
  } catch (const std::system_error& error) {
    throw InputError(path + ": cannot be created: " + error.code().message());
  }
  std::remove(partial.c_str());
}

void write_durably(const std::string& path, std::initializer_list<std::string_view> parts) {
  const std::string partial = partial_name(path);
  try {
    {
      Descriptor file(partial, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC);
      for (const std::string_view part : parts) file.write(part);
      file.sync();
    }
    std::filesystem::rename(partial, path);
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    Descriptor(folder.empty() ? "." : folder.string(), O_RDONLY | O_DIRECTORY | O_CLOEXEC).sync();
  } catch (...) {
    std::remove(partial.c_str());
    throw;
  }
}

}  // namespace eigentrail
