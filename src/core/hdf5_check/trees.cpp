#include "core/hdf5_check/trees.hpp"

#include "core/hdf5_check/object_header.hpp"

namespace eigentrail::hdf5_check {
namespace {

constexpr unsigned most_levels = 16;  ///< depth of a tree; sufficient for any number of chunks
constexpr std::uint64_t tree_head = 24;
constexpr std::uint64_t symbol_size = 40;

struct TreeKind {
  unsigned type;
  std::uint64_t half;  ///< half of the largest number of entries of a node
  std::uint64_t key_size;
};

/// Visits the entries of all leaves; `leaf` gets the key before an entry and the address of the child. `key`
/// is called for every key of every node.
class TreeWalk {
 public:
  using Visit = std::function<void(Cursor key, std::uint64_t child)>;
  TreeWalk(std::string_view file, const TreeKind& kind, std::set<std::uint64_t>& blocks, Visit key,
           Visit leaf)
      : file_(file), kind_(kind), blocks_(blocks), key_(std::move(key)), leaf_(std::move(leaf)) {}

  void node(std::uint64_t address, unsigned level) {
    const std::uint64_t most = 2 * kind_.half;
    // HDF5 reads a whole node even if few of its entries are in use.
    Cursor data = piece(file_, address, tree_head + (most + 1) * kind_.key_size + most * 8);
    use(blocks_, address);
    data.expect("TREE");
    data.expect_version(kind_.type);
    const unsigned found = data.u8();
    const unsigned entries = data.u16();
    if (found > most_levels || (level <= most_levels && found != level))
      damaged(address, "a tree of impossible depth");
    if (entries > most || (entries == 0 && found > 0)) damaged(address, "a node of impossible size");
    data.skip(16);  // addresses of the neighbouring nodes
    for (unsigned i = 0; i < entries; ++i) {
      const Cursor key = data.part(kind_.key_size);
      key_(key, 0);
      const std::uint64_t child = data.u64();
      if (found > 0) {
        node(child, found - 1);
      } else {
        leaf_(key, child);
      }
    }
    if (entries > 0) key_(data.part(kind_.key_size), 0);
  }

  /// Visits the tree from its root, whose stated depth is accepted up to most_levels.
  void root(std::uint64_t address) { node(address, most_levels + 1); }

 private:
  std::string_view file_;
  TreeKind kind_;
  std::set<std::uint64_t>& blocks_;
  Visit key_, leaf_;
};

/// Visits the members in one leaf of a group.
void symbol_node(std::string_view file, const TreeSizes& sizes, std::uint64_t address, const LocalHeap& heap,
                 std::set<std::uint64_t>& blocks, const std::function<void(const SymbolEntry&)>& visit) {
  Cursor data = piece(file, address, 8 + 2 * symbol_size * sizes.symbols);
  use(blocks, address);
  data.expect("SNOD");
  data.expect_version(1);
  data.skip(1);
  const unsigned count = data.u16();
  if (count > 2 * sizes.symbols) damaged(address, "too many members in a node");
  for (unsigned i = 0; i < count; ++i) {
    const SymbolEntry entry = read_symbol(data);
    const std::string_view name = heap.name(entry.name);
    if (name.empty() || name.find('/') != std::string_view::npos) damaged(address, "a member without a name");
    visit(entry);
  }
}

}  // namespace

SymbolEntry read_symbol(Cursor& data) {
  const std::uint64_t at = data.offset();
  SymbolEntry entry;
  entry.name = data.u64();
  entry.object = data.u64();
  entry.cache = static_cast<unsigned>(data.u32());
  data.skip(4);
  entry.cached_tree = data.u64();
  entry.cached_heap = data.u64();
  if (entry.cache == 2) refused(at, "a link to another place or file; copy what it leads to");
  if (entry.cache > 2) damaged(at, "a link of unknown kind");
  return entry;
}

void for_each_symbol(std::string_view file, const TreeSizes& sizes, std::uint64_t tree, const LocalHeap& heap,
                     std::set<std::uint64_t>& blocks, const std::function<void(const SymbolEntry&)>& visit) {
  const auto key = [&heap](Cursor data, std::uint64_t) { (void)heap.name(data.u64()); };
  const auto leaf = [&](Cursor, std::uint64_t child) {
    symbol_node(file, sizes, child, heap, blocks, visit);
  };
  TreeWalk(file, {0, sizes.group, 8}, blocks, key, leaf).root(tree);
}

void for_each_chunk(std::string_view file, const TreeSizes& sizes, std::uint64_t tree,
                    const std::vector<std::uint64_t>& shape, std::set<std::uint64_t>& blocks,
                    const std::function<void(const StoredChunk&)>& visit) {
  const auto key = [&shape](Cursor data, std::uint64_t) {
    data.skip(8);
    for (std::size_t i = 0; i + 1 < shape.size(); ++i) {
      if (data.u64() % shape[i] != 0) damaged(data.offset(), "a chunk at an impossible place");
    }
  };
  const auto leaf = [&visit](Cursor data, std::uint64_t child) {
    StoredChunk chunk;
    chunk.size = data.u32();
    chunk.skipped_filters = data.u32();
    chunk.address = child;
    visit(chunk);
  };
  TreeWalk(file, {1, sizes.chunks, 8 + 8 * shape.size()}, blocks, key, leaf).root(tree);
}

}  // namespace eigentrail::hdf5_check
