// Names of group members (local heaps), and data of variable length such as texts (global heaps).
#pragma once

#include <map>
#include <vector>

#include "core/hdf5_check/bytes.hpp"
#include "core/hdf5_check/types.hpp"

namespace eigentrail::hdf5_check {

/// The names of the members of a group.
class LocalHeap {
 public:
  LocalHeap(std::string_view file, std::uint64_t address);

  /// The name at an offset. Throws Hdf5Error if there is none or if it has more than 255 characters.
  std::string_view name(std::uint64_t offset) const;

 private:
  void check_free_list(std::uint64_t first) const;
  Cursor data_;
};

/// Data of variable length to which datasets and attributes refer. Each heap collection is read once.
class GlobalHeaps {
 public:
  explicit GlobalHeaps(std::string_view file) : file_(file) {}

  /// Checks all references in stored elements. Returns the total number of bytes that they refer to.
  std::uint64_t check(const Datatype& type, Cursor elements, std::uint64_t count);

 private:
  using Sizes = std::map<std::uint64_t, std::uint64_t>;  ///< sizes of the objects by their number
  const Sizes& collection(std::uint64_t address);
  Sizes read_collection(std::uint64_t address) const;
  std::uint64_t check_reference(Cursor reference, std::uint64_t unit);

  std::string_view file_;
  std::map<std::uint64_t, Sizes> collections_;
};

}  // namespace eigentrail::hdf5_check
