// B-trees, which index the members of groups and the chunks of datasets.
#pragma once

#include <functional>
#include <set>
#include <vector>

#include "core/hdf5_check/bytes.hpp"
#include "core/hdf5_check/heaps.hpp"

namespace eigentrail::hdf5_check {

/// Sizes of tree nodes: half of the largest number of entries. The defaults are those of HDF5.
struct TreeSizes {
  unsigned symbols = 4;  ///< leaf of a group
  unsigned group = 16;   ///< inner node of a group
  unsigned chunks = 32;  ///< node of a chunk index
};

/// A member of a group.
struct SymbolEntry {
  std::uint64_t name = 0;  ///< offset of the name in the local heap
  std::uint64_t object = 0;
  unsigned cache = 0;
  std::uint64_t cached_tree = 0, cached_heap = 0;  ///< of the member, used if cache is 1
};

SymbolEntry read_symbol(Cursor& data);

/// Visits every member of a group.
void for_each_symbol(std::string_view file, const TreeSizes& sizes, std::uint64_t tree, const LocalHeap& heap,
                     std::set<std::uint64_t>& blocks, const std::function<void(const SymbolEntry&)>& visit);

struct StoredChunk {
  std::uint64_t address = 0;
  std::uint64_t size = 0;
  std::uint64_t skipped_filters = 0;
};

/// Visits every chunk of a dataset; `shape` is that of a chunk, with the size of an element as last entry.
void for_each_chunk(std::string_view file, const TreeSizes& sizes, std::uint64_t tree,
                    const std::vector<std::uint64_t>& shape, std::set<std::uint64_t>& blocks,
                    const std::function<void(const StoredChunk&)>& visit);

}  // namespace eigentrail::hdf5_check
