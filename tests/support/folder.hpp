// A temporary folder that is removed with the object.
#pragma once

#include <filesystem>
#include <random>
#include <string>

namespace eigentrail::test {

class Folder {
 public:
  Folder() {
    std::random_device random;
    folder_ = std::filesystem::temp_directory_path() / ("eigentrail_" + std::to_string(random()));
    std::filesystem::create_directories(folder_);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string path() const { return folder_.string(); }

 private:
  std::filesystem::path folder_;
};

}  // namespace eigentrail::test
