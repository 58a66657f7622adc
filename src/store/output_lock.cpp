#include "store/output_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include "eigentrail/core/errors.hpp"

namespace eigentrail {
namespace {

/// Whether the file of this name is still the one that the descriptor refers to.
bool is_at(int descriptor, const std::string& name) {
  struct stat open_file {
  }, named{};
  return fstat(descriptor, &open_file) == 0 && lstat(name.c_str(), &named) == 0 &&
         open_file.st_ino == named.st_ino && open_file.st_dev == named.st_dev;
}

std::string reason(int error) {
  return std::generic_category().message(error);
}

}  // namespace

LockedFile::LockedFile(const std::string& name, const std::string& path) {
  // Who has the file renames or removes it in the end. If that happens after this process opened it and
  // before it locked it, the locked file has this name no more: then try again.
  while (descriptor_ < 0) {
    descriptor_ = open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (descriptor_ < 0) throw std::system_error(errno, std::generic_category(), name);
    lock_error_ = flock(descriptor_, LOCK_EX | LOCK_NB) == 0 ? 0 : errno;
    if (lock_error_ == EWOULDBLOCK) {
      close(descriptor_);
      throw InputError(path + ": another process writes it (" + name +
                       " is locked); wait for it, or give another name");
    }
    if (!is_at(descriptor_, name)) close(std::exchange(descriptor_, -1));
  }
}

bool LockedFile::write(std::string_view bytes) const {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

void LockedFile::unlock() const {
  flock(descriptor_, LOCK_UN);
}

LockedFile::~LockedFile() {
  close(descriptor_);
}

OutputLock::OutputLock(const std::string& path) try : name_(path + ".lock"), file_(name_, path) {
  if (file_.lock_error() == 0) return;
  std::remove(name_.c_str());
  throw InputError(path + ": cannot be locked against other processes, the file system offers no locks (" +
                   reason(file_.lock_error()) + "); if no other process writes it, --no-lock goes without");
} catch (const std::system_error& error) {
  throw InputError(path + ": cannot be created: " + reason(error.code().value()));
}

OutputLock::~OutputLock() {
  std::remove(name_.c_str());
}

}  // namespace eigentrail
