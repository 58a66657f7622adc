// Answers requests about an HDF5 file. A file that comes from anywhere may lead to any fault in the HDF5
// library, so this runs in a process of its own.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/hdf5_handle.hpp"
#include "core/hdf5_types.hpp"

namespace eigentrail::reader {

/// An HDF5 file. All functions throw Hdf5Error; core/reader_requests.hpp says what they answer.
class Hdf5Source {
 public:
  /// Opens a file by its path, or takes the bytes of one.
  Hdf5Source(const std::string& path_or_bytes, bool is_image);

  bool has(const std::string& path) const;
  std::vector<std::string> members(const std::string& group) const;
  std::optional<StoredArray> read(const std::string& dataset, std::uint64_t first, std::uint64_t rows);
  std::map<std::string, StoredArray> attributes(const std::string& object) const;

 private:
  /// The dataset that was asked for last stays open: its parts are read one after the other.
  struct Dataset {
    std::string name;
    Handle set, stored, space;
    ElementType type;
    Shape shape;
  };
  const Dataset* dataset(const std::string& name);

  Handle file_;
  std::optional<Dataset> last_;
};

}  // namespace eigentrail::reader
