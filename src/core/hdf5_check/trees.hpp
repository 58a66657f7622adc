// B-trees: members of groups, and chunks of datasets.
#pragma once

#include <functional>
#include <set>
#include <vector>

#include "core/hdf5_check/bytes.hpp"
#include "core/hdf5_check/heaps.hpp"

namespace eigentrail::hdf5_check {

/// Numbers of entries of a tree's node: half of what fits.
struct TreeSizes {
  unsigned symbols = 4;  ///< of a leaf of a group
  unsigned group = 16;   ///< of another node of a group
  unsigned chunks = 32;  ///< of a node of a dataset
};

/// A line of a group.
struct SymbolEntry {
  std::uint64_t name = 0;  ///< offset in the heap
  std::uint64_t object = 0;
  unsigned cache = 0;
  std::uint64_t cached_tree = 0, cached_heap = 0;  ///< where cache is 1
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

/// Visits every chunk of a dataset; `shape` is that of a chunk, with the size of an element at its end.
void for_each_chunk(std::string_view file, const TreeSizes& sizes, std::uint64_t tree,
                    const std::vector<std::uint64_t>& shape, std::set<std::uint64_t>& blocks,
                    const std::function<void(const StoredChunk&)>& visit);

}  // namespace eigentrail::hdf5_check
