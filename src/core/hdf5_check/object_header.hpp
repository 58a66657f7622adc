// Messages in the header of an object, which describe a group or dataset.
#pragma once

#include <set>
#include <vector>

#include "core/hdf5_check/bytes.hpp"

namespace eigentrail::hdf5_check {

enum MessageType : unsigned {
  nothing = 0x0,
  dataspace = 0x1,
  link_info = 0x2,
  datatype = 0x3,
  old_fill_value = 0x4,
  fill_value = 0x5,
  link = 0x6,
  external_files = 0x7,
  layout = 0x8,
  group_info = 0xa,
  filters = 0xb,
  attribute = 0xc,
  comment = 0xd,
  continuation = 0x10,
  symbol_table = 0x11,
  modification_time = 0x12,
  attribute_info = 0x15,
  reference_count = 0x16
};

struct Message {
  unsigned type = nothing;
  Cursor data;
};

/// Reads all messages of the object at an address. Adds the pieces of the file that they occupy to `blocks`;
/// a piece must not belong to two objects.
std::vector<Message> read_messages(std::string_view file, std::uint64_t address,
                                   std::set<std::uint64_t>& blocks);

/// Marks a piece as used. Throws Hdf5Error if it is in use already, as in trees that contain themselves.
void use(std::set<std::uint64_t>& blocks, std::uint64_t address);

}  // namespace eigentrail::hdf5_check
