#include "eigentrail/store/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "core/hdf5_file.hpp"
#include "eigentrail/core/errors.hpp"
#include "store/output_lock.hpp"

namespace eigentrail {
namespace {

[[noreturn]] void fail(const std::string& path) {
  throw std::system_error(errno, std::generic_category(), path);
}

/// Flushes a file or a folder to the disk. Does nothing on file systems that do not support this.
void sync(int descriptor, const std::string& path) {
  if (fsync(descriptor) != 0 && errno != EINVAL && errno != ENOTSUP) fail(path);
}

/// Makes a rename in the folder of `path` last.
void sync_folder(const std::string& path) {
  const std::filesystem::path parent = std::filesystem::path(path).parent_path();
  const std::string folder = parent.empty() ? "." : parent.string();
  struct Descriptor {
    int number;
    ~Descriptor() { close(number); }
  };
  const Descriptor opened{open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
  if (opened.number < 0) fail(folder);
  sync(opened.number, folder);
}

/// Renames without replacing. NFS cannot do that, but refuses a second name that is there.
bool rename_to_new(const std::string& from, const std::string& to) {
  if (renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return true;
  if (errno != EINVAL && errno != ENOSYS) return false;
  return link(from.c_str(), to.c_str()) == 0 && unlink(from.c_str()) == 0;
}

/// The file that a symbolic link leads to.
std::string target_of(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_symlink(path, error)) return path;
  const std::filesystem::path target = std::filesystem::canonical(path, error);
  return error ? path : target.string();
}

std::string partial_name(const std::string& path) {
  return path + ".partial";
}

/// The new version of a file, under another name until it takes its place.
class PartialFile {
 public:
  explicit PartialFile(const std::string& path)
      : path_(path), target_(target_of(path)), name_(partial_name(target_)), file_(name_, path) {}
  ~PartialFile() {
    if (is_there_) std::remove(name_.c_str());
  }
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  void write(const std::vector<std::string_view>& parts) {
    if (ftruncate(file_.descriptor(), 0) != 0) fail(path_);
    for (const std::string_view part : parts) {
      if (!file_.write(part)) fail(path_);
    }
    sync(file_.descriptor(), path_);
  }

  void take_place(Existing existing) {
    file_.unlock();
    if (existing == Existing::replace) {
      keep_permissions();
      if (rename(name_.c_str(), target_.c_str()) != 0) fail(path_);
    } else if (!rename_to_new(name_, target_)) {
      if (errno != EEXIST) fail(path_);
      is_there_ = false;
      throw std::runtime_error(
          path_ + ": a file that has appeared here since the run began is kept; what was computed is in " +
          name_ + "; rename one of them");
    }
    is_there_ = false;
    sync_folder(target_);
  }

 private:
  /// Owner and group as far as this process may give them.
  void keep_permissions() {
    struct stat old {};
    if (stat(target_.c_str(), &old) != 0) return;
    [[maybe_unused]] const int owned = fchown(file_.descriptor(), old.st_uid, old.st_gid);
    constexpr mode_t permissions = 0777;
    if (fchmod(file_.descriptor(), old.st_mode & permissions) != 0) fail(path_);
  }

  std::string path_, target_, name_;
  LockedFile file_;
  bool is_there_ = true;  ///< under this name, to be removed
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
  try {
    PartialFile{path};
  } catch (const std::system_error& error) {
    throw InputError(path + ": cannot be created: " + error.code().message());
  }
}

Existing existing_pair(const std::string& first, const std::string& second, bool force,
                       const std::string& advice) {
  const auto exists = [](const std::string& path) {
    std::error_code error;
    return std::filesystem::exists(std::filesystem::symlink_status(path, error));
  };
  const bool half =
      exists(first) && !exists(partial_name(first)) && !exists(second) && exists(partial_name(second));
  if (force || half) return Existing::replace;
  for (const std::string& path : {second, first}) {
    if (exists(path)) throw InputError(path + ": exists already; " + advice);
  }
  return Existing::keep;
}

void write_durably(const std::vector<NewFile>& files, Existing existing) {
  std::deque<PartialFile> partials;
  for (const NewFile& file : files) partials.emplace_back(file.path).write(file.parts);
  for (PartialFile& partial : partials) partial.take_place(existing);
}

void write_durably(const std::string& path, std::vector<std::string_view> parts, Existing existing) {
  write_durably({{path, std::move(parts)}}, existing);
}

}  // namespace eigentrail
