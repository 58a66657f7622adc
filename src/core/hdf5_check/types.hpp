// Types and shapes of datasets and attributes.
#pragma once

#include <vector>

#include "core/hdf5_check/bytes.hpp"

namespace eigentrail::hdf5_check {

/// A part of an element that is stored in a global heap: a text of variable length or a list of references.
struct HeapPart {
  std::uint64_t offset = 0;  ///< bytes from the beginning of the element
  std::uint64_t unit = 1;    ///< bytes per item
};

struct Datatype {
  std::uint64_t size = 0;  ///< bytes of an element, at least 1
  std::vector<HeapPart> heap_parts;
};

/// Accepts integers of standard size, IEEE real numbers, texts, compounds and enumerations of them, and
/// references; refuses all other types. `depth` is the nesting depth.
Datatype read_datatype(Cursor& data, int depth = 0);

/// Shape and number of elements of a dataset or attribute; `count` is 0 for a null dataspace.
struct Dataspace {
  std::uint64_t count = 0;
  std::vector<std::uint64_t> shape;
};

Dataspace read_dataspace(Cursor& data);

/// Product of sizes. Throws Hdf5Error if it exceeds 2^48.
std::uint64_t product(const std::vector<std::uint64_t>& sizes, std::uint64_t at);

}  // namespace eigentrail::hdf5_check
