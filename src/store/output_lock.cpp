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
  return fstat(descriptor, &open_file) == 0 && stat(name.c_str(), &named) == 0 &&
         open_file.st_ino == named.st_ino && open_file.st_dev == named.st_dev;
}

}  // namespace

OutputLock::OutputLock(const std::string& path) : name_(path + ".lock") {
  // The holder of the lock removes the lock file when it ends. If that happens after this process opened the
  // file and before it locked it, the locked file has no name any more: then try again.
  while (descriptor_ < 0) {
    descriptor_ = open(name_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor_ < 0)
      throw InputError(path + ": cannot be created: " + std::generic_category().message(errno));
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      close(descriptor_);
      throw InputError(path + ": another process writes it (" + name_ +
                       " is locked); wait for it, or give another name");
    }
    if (!is_at(descriptor_, name_)) close(std::exchange(descriptor_, -1));
  }
}

OutputLock::~OutputLock() {
  std::remove(name_.c_str());
  close(descriptor_);
}

}  // namespace eigentrail
