// One process at a time writes a file.
#pragma once

#include <string>

namespace eigentrail {

/// Holds `path`.lock while it lives. A process that is killed leaves the name, which nobody holds then.
class OutputLock {
 public:
  /// Throws InputError when another process writes the same file, and when the name cannot be created.
  explicit OutputLock(const std::string& path);
  ~OutputLock();
  OutputLock(const OutputLock&) = delete;
  OutputLock& operator=(const OutputLock&) = delete;

 private:
  std::string name_;
  int descriptor_ = -1;
};

}  // namespace eigentrail
