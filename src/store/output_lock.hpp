// A lock that keeps two processes from writing the same file.
#pragma once

#include <string>

namespace eigentrail {

/// Holds an exclusive lock (flock) on the file `path`.lock during its lifetime. If a process is killed, the
/// lock file remains but the system releases the lock, so the next process can take it.
class OutputLock {
 public:
  /// Throws InputError if another process holds the lock, or if the lock file cannot be created.
  explicit OutputLock(const std::string& path);
  ~OutputLock();
  OutputLock(const OutputLock&) = delete;
  OutputLock& operator=(const OutputLock&) = delete;

 private:
  std::string name_;
  int descriptor_ = -1;
};

}  // namespace eigentrail
