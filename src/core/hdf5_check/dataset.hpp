// Datasets and attributes: compares what they declare with what the file holds.
#pragma once

#include <set>
#include <vector>

#include "core/hdf5_check/heaps.hpp"
#include "core/hdf5_check/object_header.hpp"
#include "core/hdf5_check/trees.hpp"

namespace eigentrail::hdf5_check {

/// Data that the checks of all objects share.
struct FileParts {
  std::string_view file;
  TreeSizes sizes;
  std::set<std::uint64_t> blocks;
  GlobalHeaps heaps;
};

/// The message of a type, null if there is none. Throws Hdf5Error if an object has it more than once.
const Message* single(const std::vector<Message>& messages, MessageType type);

void check_dataset(FileParts& parts, const std::vector<Message>& messages, std::uint64_t at);

void check_attribute(FileParts& parts, Cursor data);

}  // namespace eigentrail::hdf5_check
