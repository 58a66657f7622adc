#include "core/hdf5_check/heaps.hpp"

namespace eigentrail::hdf5_check {
namespace {

/// Characters of a dataset's name; eigentrail's own names have fewer than 30.
constexpr std::uint64_t longest_name = 255;
constexpr std::uint64_t no_free_block = 1;
constexpr std::uint64_t object_head = 16;

}  // namespace

LocalHeap::LocalHeap(std::string_view file, std::uint64_t address) : data_({}, 0) {
  Cursor head = piece(file, address, 32);
  head.expect("HEAP");
  head.expect_version(0);
  head.skip(3);
  const std::uint64_t size = head.u64();
  const std::uint64_t free = head.u64();
  data_ = piece(file, head.u64(), size);
  check_free_list(free);
}

/// Free blocks form a linked list through the heap; a list with a cycle would never end.
void LocalHeap::check_free_list(std::uint64_t first) const {
  std::uint64_t patience = data_.left() / 16 + 1;
  for (std::uint64_t at = first; at != no_free_block && at != undefined;) {
    if (patience-- == 0) damaged(data_.offset(), "free blocks of names go in a circle");
    Cursor block = piece(data_.rest(), at, 16);
    at = block.u64();
    const std::uint64_t size = block.u64();
    if (size < 16 || size - 16 > data_.left() - (block.offset()))
      damaged(data_.offset(), "a free block too long");
  }
}

std::string_view LocalHeap::name(std::uint64_t offset) const {
  if (offset >= data_.left()) damaged(data_.offset(), "a name lies outside of its heap");
  Cursor at(data_.rest().substr(offset), data_.offset() + offset);
  const std::string_view name = at.name();
  if (name.size() > longest_name) refused(data_.offset() + offset, "a name of more than 255 characters");
  return name;
}

std::uint64_t GlobalHeaps::check(const Datatype& type, Cursor elements, std::uint64_t count) {
  std::uint64_t bytes = 0;
  for (std::uint64_t i = 0; i < count && !type.heap_parts.empty(); ++i) {
    const Cursor element = elements.part(type.size);
    for (const HeapPart& part : type.heap_parts) {
      Cursor reference = element;
      reference.skip(part.offset);
      bytes += check_reference(reference, part.unit);
    }
  }
  return bytes;
}

std::uint64_t GlobalHeaps::check_reference(Cursor reference, std::uint64_t unit) {
  const std::uint64_t at = reference.offset();
  const std::uint64_t length = reference.u32();
  const std::uint64_t address = reference.u64();
  const std::uint64_t number = reference.u32();
  if (address == 0) return 0;  // never written; HDF5 stores an address even for an empty text
  const Sizes& objects = collection(address);
  const auto object = objects.find(number);
  if (object == objects.end() || object->second != length * unit)
    damaged(at, "a text is not where it should be");
  return object->second;
}

const GlobalHeaps::Sizes& GlobalHeaps::collection(std::uint64_t address) {
  const auto known = collections_.find(address);
  if (known != collections_.end()) return known->second;
  return collections_[address] = read_collection(address);
}

GlobalHeaps::Sizes GlobalHeaps::read_collection(std::uint64_t address) const {
  Cursor head = piece(file_, address, 16);
  head.expect("GCOL");
  head.expect_version(1);
  head.skip(3);
  const std::uint64_t size = head.u64();
  if (size < object_head) damaged(address, "a collection of texts that is too small");
  Cursor objects = piece(file_, address, size);
  objects.skip(16);
  Sizes sizes;
  while (objects.left() >= object_head) {
    const std::uint64_t at = objects.offset();
    const unsigned number = objects.u16();
    objects.skip(6);
    const std::uint64_t bytes = objects.u64();
    if (bytes > size) damaged(at, "a text is longer than its collection");
    if (number == 0) {  // free space; its size includes its header
      if (bytes < object_head) damaged(at, "free space of no size");
      objects.skip(bytes - object_head);
    } else {
      if (!sizes.emplace(number, bytes).second) damaged(at, "two texts of the same number");
      objects.skip((bytes + 7) / 8 * 8);
    }
  }
  return sizes;
}

}  // namespace eigentrail::hdf5_check
