// Names of groups (local heaps), and texts of any length (global heaps).
#pragma once

#include <map>
#include <vector>

#include "core/hdf5_check/bytes.hpp"
#include "core/hdf5_check/types.hpp"

namespace eigentrail::hdf5_check {

/// The names of a group.
class LocalHeap {
 public:
  LocalHeap(std::string_view file, std::uint64_t address);

  /// The name at an offset; throws where there is none, or none that a path can be made of.
  std::string_view name(std::uint64_t offset) const;

 private:
  void check_free_list(std::uint64_t first) const;
  Cursor data_;
};

/// Texts that datasets and attributes point at. Collections are read once.
class GlobalHeaps {
 public:
  explicit GlobalHeaps(std::string_view file) : file_(file) {}

  /// Checks every reference in stored elements. Returns the bytes that reading them takes.
  std::uint64_t check(const Datatype& type, Cursor elements, std::uint64_t count);

 private:
  using Sizes = std::map<std::uint64_t, std::uint64_t>;  ///< of objects, by number
  const Sizes& collection(std::uint64_t address);
  Sizes read_collection(std::uint64_t address) const;
  std::uint64_t check_reference(Cursor reference, std::uint64_t unit);

  std::string_view file_;
  std::map<std::uint64_t, Sizes> collections_;
};

}  // namespace eigentrail::hdf5_check
