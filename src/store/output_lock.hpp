// Locks that keep two processes from writing the same file.
#pragma once

#include <string>
#include <string_view>

namespace eigentrail {

/// A file that one process at a time has open: it is made if it is not there, and locked (flock). If a
/// process is killed, the file remains but the system releases the lock, so the next process can take it.
class LockedFile {
 public:
  /// The file `name` beside the output `path`. Throws InputError if another process has it, and
  /// std::system_error if it cannot be made.
  LockedFile(const std::string& name, const std::string& path);
  ~LockedFile();
  LockedFile(const LockedFile&) = delete;
  LockedFile& operator=(const LockedFile&) = delete;

  int descriptor() const { return descriptor_; }
  /// Writes all bytes; false, with errno, if that fails.
  bool write(std::string_view bytes) const;
  /// For readers that lock what they read, as HDF5 does.
  void unlock() const;
  /// Why the file system offers no locks, as an error number; 0: the file is locked.
  int lock_error() const { return lock_error_; }

 private:
  int descriptor_ = -1;
  int lock_error_ = 0;
};

/// Holds the file `path`.lock during its lifetime.
class OutputLock {
 public:
  /// Throws InputError if another process holds it, if it cannot be made, or cannot be locked.
  explicit OutputLock(const std::string& path);
  ~OutputLock();
  OutputLock(const OutputLock&) = delete;
  OutputLock& operator=(const OutputLock&) = delete;

 private:
  std::string name_;
  LockedFile file_;
};

}  // namespace eigentrail
