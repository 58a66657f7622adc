#include "core/hdf5_check/dataset.hpp"

#include <algorithm>

#include "core/hdf5_check/filters.hpp"

namespace eigentrail::hdf5_check {
namespace {

/// Parts of a dataset that were never written read as fill values. Up to 64 KiB (small empty datasets) or
/// sixteen times the stored data (modes that were added late in a trace) may be missing. A larger declared
/// size counts as damage, because a few bytes could otherwise make a reader allocate all memory.
constexpr std::uint64_t unwritten_bytes = std::uint64_t{1} << 16U;
constexpr std::uint64_t unwritten_multiple = 16;

/// Limit of the chunk size (64 MiB, or the size of the file): HDF5 keeps a whole chunk in memory.
constexpr std::uint64_t largest_chunk = std::uint64_t{1} << 26U;

class DatasetCheck {
 public:
  DatasetCheck(FileParts& parts, const std::vector<Message>& messages, std::uint64_t at)
      : parts_(parts), messages_(messages), at_(at) {}

  void run() {
    if (single(messages_, external_files) != nullptr)
      refused(at_, "a dataset whose data are in another file; copy them into this one");
    Cursor type = require(datatype);
    type_ = read_datatype(type);
    Cursor space = require(dataspace);
    space_ = read_dataspace(space);
    std::vector<std::uint64_t> sizes = space_.shape;
    sizes.push_back(type_.size);
    bytes_ = space_.count == 0 ? 0 : product(sizes, at_);
    if (const Message* filter = single(messages_, filters)) filters_ = read_filters(filter->data);
    if (const Message* fill = single(messages_, fill_value)) check_fill(fill->data);
    if (const Message* fill = single(messages_, old_fill_value)) check_fill_size(fill->data);
    check_layout(require(layout));
    if (text_bytes_ > parts_.file.size()) damaged(at_, "its texts are longer than the file");
    if (bytes_ / unwritten_multiple > stored_ + unwritten_bytes / unwritten_multiple) {
      damaged(at_, "a dataset of " + std::to_string(bytes_) + " bytes, of which the file holds " +
                       std::to_string(stored_));
    }
  }

 private:
  Cursor require(MessageType message) const {
    const Message* found = single(messages_, message);
    if (found == nullptr) damaged(at_, "an object that is neither a group nor a dataset");
    return found->data;
  }

  void check_fill(Cursor data) const {
    const std::uint64_t at = data.offset();
    const unsigned version = data.u8();
    if (version < 1 || version > 3) damaged(at, "unknown version of a fill value");
    bool has_value = false;
    if (version == 3) {
      has_value = (data.u8() & 0x20U) != 0;
    } else {
      data.skip(2);
      has_value = data.u8() != 0 || version == 1;
    }
    if (has_value) check_fill_size(data);
  }

  void check_fill_size(Cursor data) const {
    const std::uint64_t at = data.offset();
    const std::uint64_t size = data.u32();
    const bool none = size == 0 || size > 0x7fffffffU;
    if (!none && (size != type_.size || size > data.left() || !type_.heap_parts.empty()))
      damaged(at, "a fill value of another type");
  }

  void check_layout(Cursor data) {
    const std::uint64_t at = data.offset();
    const unsigned version = data.u8();
    if (version != 3 && version != 4) refused(at, "a dataset of an old HDF5; copy the file with h5repack");
    switch (data.u8()) {
      case 0:
        return check_compact(data);
      case 1:
        return check_contiguous(data);
      case 2:
        return version == 3 ? check_chunked(data) : check_single_chunk(data);
      default:
        refused(at, "a dataset whose data are those of others (virtual); copy them");
    }
  }

  void check_compact(Cursor data) {
    const std::uint64_t at = data.offset();
    const std::uint64_t size = data.u16();
    if (size != bytes_) damaged(at, "a dataset of the wrong size");
    check_elements(data.part(size));
  }

  void check_contiguous(Cursor data) {
    const std::uint64_t at = data.offset();
    const std::uint64_t address = data.u64();
    const std::uint64_t size = data.u64();
    if (!filters_.empty()) damaged(at, "a compressed dataset without chunks");
    if (address == undefined) return;
    if (size != bytes_) damaged(at, "a dataset of the wrong size");
    check_elements(piece(parts_.file, address, size));
  }

  void check_elements(Cursor elements) {
    stored_ += elements.left();
    text_bytes_ += parts_.heaps.check(type_, elements, elements.left() / type_.size);
  }

  /// Shape of a chunk; the last entry is the size of an element in bytes.
  std::vector<std::uint64_t> read_chunk_shape(Cursor& data, unsigned rank, std::uint64_t width) {
    const std::uint64_t at = data.offset();
    if (rank != space_.shape.size() + 1) damaged(at, "chunks of another dimension than the dataset");
    std::vector<std::uint64_t> shape;
    for (unsigned i = 0; i < rank; ++i) shape.push_back(data.number(width));
    const bool zero = std::find(shape.begin(), shape.end(), std::uint64_t{0}) != shape.end();
    if (zero || shape.back() != type_.size) damaged(at, "chunks of impossible shape");
    chunk_bytes_ = product(shape, at);
    if (chunk_bytes_ > std::max<std::uint64_t>(largest_chunk, parts_.file.size()))
      refused(at, "chunks of more than 64 MiB; write the dataset with smaller ones");
    if (!filters_.empty() && !type_.heap_parts.empty()) refused(at, "compressed texts of variable length");
    return shape;
  }

  void check_chunked(Cursor data) {
    const unsigned rank = data.u8();
    const std::uint64_t tree = data.u64();
    const std::vector<std::uint64_t> shape = read_chunk_shape(data, rank, 4);
    if (tree == undefined) return;
    for_each_chunk(parts_.file, parts_.sizes, tree, shape, parts_.blocks,
                   [this](const StoredChunk& chunk) { check_chunk_at(chunk); });
  }

  /// A dataset that consists of a single chunk: the only chunk index of newer HDF5 that needs no further
  /// structure.
  void check_single_chunk(Cursor data) {
    const std::uint64_t at = data.offset();
    const unsigned flags = data.u8();
    const unsigned rank = data.u8();
    const unsigned width = data.u8();
    if (width == 0 || width > 8) damaged(at, "chunks of impossible shape");
    (void)read_chunk_shape(data, rank, width);
    if (data.u8() != 1)
      refused(at, "a dataset in the newest format of HDF5; write it with libver = \"earliest\"");
    StoredChunk chunk{0, chunk_bytes_, 0};
    if ((flags & 2U) != 0) {
      chunk.size = data.u64();
      chunk.skipped_filters = data.u32();
    }
    chunk.address = data.u64();
    if (chunk.address != undefined) check_chunk_at(chunk);
  }

  void check_chunk_at(const StoredChunk& chunk) {
    Cursor data = piece(parts_.file, chunk.address, chunk.size);
    if (filters_.empty() && chunk.size != chunk_bytes_) damaged(chunk.address, "a chunk of the wrong size");
    if (!filters_.empty()) {
      check_chunk(filters_, chunk.skipped_filters, data, chunk_bytes_);
      stored_ += chunk_bytes_;
    } else {
      check_elements(data);
    }
    if (filters_.empty() && stored_ > parts_.file.size()) damaged(at_, "chunks that lie in each other");
  }

  FileParts& parts_;
  const std::vector<Message>& messages_;
  std::uint64_t at_;
  Datatype type_;
  Dataspace space_;
  Filters filters_;
  std::uint64_t bytes_ = 0;        ///< size as declared, bytes
  std::uint64_t stored_ = 0;       ///< size of the data in the file before compression, bytes
  std::uint64_t text_bytes_ = 0;   ///< total size of its texts of variable length
  std::uint64_t chunk_bytes_ = 0;  ///< size of a chunk before compression
};

}  // namespace

const Message* single(const std::vector<Message>& messages, MessageType type) {
  const Message* found = nullptr;
  for (const Message& message : messages) {
    if (message.type != type) continue;
    if (found != nullptr) damaged(message.data.offset(), "an object that says the same twice");
    found = &message;
  }
  return found;
}

void check_dataset(FileParts& parts, const std::vector<Message>& messages, std::uint64_t at) {
  DatasetCheck(parts, messages, at).run();
}

void check_attribute(FileParts& parts, Cursor data) {
  const std::uint64_t at = data.offset();
  const unsigned version = data.u8();
  const unsigned flags = data.u8();
  if (version < 1 || version > 3) damaged(at, "unknown version of an attribute");
  if (version > 1 && flags != 0) refused(at, "types that attributes share");
  const std::uint64_t name_size = data.u16();
  const std::uint64_t type_size = data.u16();
  const std::uint64_t space_size = data.u16();
  if (version == 3) data.skip(1);
  const auto field = [&](std::uint64_t size) {
    const Cursor part = data.part(size);
    if (version == 1) data.skip((8 - size % 8) % 8);
    return part;
  };
  Cursor name = field(name_size);
  Cursor type_part = field(type_size);
  Cursor space_part = field(space_size);
  (void)name.name();
  // HDF5 rejects such an attribute in the middle of a list and, while it frees the list, accesses memory
  // beyond its end.
  if (name.left() != 0) damaged(at, "an attribute's name of the wrong length");
  const Datatype type = read_datatype(type_part);
  const Dataspace space = read_dataspace(space_part);
  const std::uint64_t bytes = space.count == 0 ? 0 : product({space.count, type.size}, at);
  (void)parts.heaps.check(type, data.part(bytes), space.count);
}

}  // namespace eigentrail::hdf5_check
