// Types and shapes of datasets and attributes.
#pragma once

#include <vector>

#include "core/hdf5_check/bytes.hpp"

namespace eigentrail::hdf5_check {

/// A part of an element that is stored elsewhere, in a global heap: a text of any length, or a list of
/// references.
struct HeapPart {
  std::uint64_t offset = 0;  ///< in the element
  std::uint64_t unit = 1;    ///< bytes per item
};

struct Datatype {
  std::uint64_t size = 0;  ///< of an element, at least 1
  std::vector<HeapPart> heap_parts;
};

/// Accepts standard integers and IEEE numbers, texts, compounds and enumerations of them, and references.
Datatype read_datatype(Cursor& data, int depth = 0);

/// Number of elements; `rank` is that of its shape.
struct Dataspace {
  std::uint64_t count = 0;
  std::vector<std::uint64_t> shape;
};

Dataspace read_dataspace(Cursor& data);

/// Product of sizes; throws where it is beyond any memory.
std::uint64_t product(const std::vector<std::uint64_t>& sizes, std::uint64_t at);

}  // namespace eigentrail::hdf5_check
