// A file that is mapped into memory, so that only the pages that are accessed are read.
#pragma once

#include <string>
#include <string_view>

namespace eigentrail::hdf5_check {

class MappedFile {
 public:
  /// Throws Hdf5Error if the file cannot be read or is not a regular file.
  explicit MappedFile(const std::string& path);
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  ~MappedFile();

  std::string_view bytes() const { return {static_cast<const char*>(data_), size_}; }

 private:
  void* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace eigentrail::hdf5_check
