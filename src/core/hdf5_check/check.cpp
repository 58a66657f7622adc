#include "core/hdf5_check/check.hpp"

#include <algorithm>
#include <array>

#include "core/hdf5_check/dataset.hpp"
#include "core/hdf5_check/mapped_file.hpp"

namespace eigentrail {
namespace hdf5_check {
namespace {

constexpr std::string_view signature = "\x89HDF\r\n\x1a\n";
constexpr int deepest_group = 8;  ///< depth of nested groups; eigentrail writes one level
/// Largest accepted half-size of a B-tree node; HDF5's defaults are at most 32.
constexpr unsigned most_entries = 1024;

class FileCheck {
 public:
  explicit FileCheck(std::string_view file) : parts_{file, {}, {}, GlobalHeaps(file)} {}

  void run() {
    Cursor data = piece(parts_.file, 0, parts_.file.size());
    if (!data.rest().starts_with(signature)) throw Hdf5Error("is no HDF5 file");
    data.skip(signature.size());
    const unsigned version = data.u8();
    if (version > 3) refused(8, "the file is of a newer HDF5");
    if (version < 2) {
      begin_0(data, version);
    } else {
      begin_2(data);
    }
  }

 private:
  void begin_0(Cursor data, unsigned version) {
    data.skip(4);
    check_widths(data);
    data.skip(1);
    parts_.sizes.symbols = entries(data);
    parts_.sizes.group = entries(data);
    data.skip(4);
    if (version == 1) {
      parts_.sizes.chunks = entries(data);
      data.skip(2);
    }
    check_base(data.u64());
    data.skip(8);  // address of the free-space information, which HDF5 does not use
    check_end(data.u64());
    if (data.u64() != undefined) refused(data.offset(), "the file is one of a family of files");
    member(read_symbol(data), 0);
  }

  void begin_2(Cursor data) {
    check_widths(data);
    if (data.u8() != 0) refused(11, "the file is still being written, or was never closed");
    check_base(data.u64());
    if (data.u64() != undefined) refused(data.offset(), "the file has an extension that is not read");
    check_end(data.u64());
    const std::uint64_t root = data.u64();
    expect_checksum(parts_.file, 0, data.offset());
    object(root, 0);
  }

  static void check_widths(Cursor& data) {
    const std::uint64_t at = data.offset();
    if (data.u8() != 8 || data.u8() != 8) refused(at, "addresses that are not of 64 bits");
  }
  static unsigned entries(Cursor& data) {
    const std::uint64_t at = data.offset();
    const unsigned count = data.u16();
    if (count == 0 || count > most_entries) damaged(at, "trees of impossible size");
    return count;
  }
  static void check_base(std::uint64_t base) {
    if (base != 0) refused(0, "the file begins within another one");
  }
  /// Bytes beyond the stated end of the file are ignored.
  void check_end(std::uint64_t end) {
    const std::string found = std::to_string(parts_.file.size());
    if (end > parts_.file.size())
      throw Hdf5Error("is cut off: " + found + " bytes of " + std::to_string(end));
    parts_.file = parts_.file.substr(0, end);
    parts_.heaps = GlobalHeaps(parts_.file);
  }

  void member(const SymbolEntry& entry, int depth) { object(entry.object, depth, &entry); }

  void object(std::uint64_t address, int depth, const SymbolEntry* entry = nullptr) {
    const auto cached = [&](const Message& group) {
      Cursor data = group.data;
      return data.u64() == entry->cached_tree && data.u64() == entry->cached_heap;
    };
    const auto known = objects_.find(address);
    if (known == objects_.end()) {
      const std::vector<Message>& messages = objects_[address] =
          read_messages(parts_.file, address, parts_.blocks);
      check_messages(messages);
      if (is_group(messages)) {
        group(messages, address, depth);
      } else if (is_named_type(messages)) {
        Cursor type = single(messages, datatype)->data;
        (void)read_datatype(type);
      } else {
        check_dataset(parts_, messages, address);
      }
    }
    if (entry == nullptr || entry->cache == 0) return;
    const Message* table = single(objects_[address], symbol_table);
    if (table == nullptr || !cached(*table)) damaged(address, "a group that is said to be elsewhere");
  }

  void check_messages(const std::vector<Message>& messages) {
    constexpr std::array known{
        nothing,    dataspace,      link_info,    datatype,          old_fill_value, link,
        fill_value, external_files, layout,       group_info,        filters,        attribute,
        comment,    continuation,   symbol_table, modification_time, attribute_info, reference_count};
    for (const Message& message : messages) {
      if (std::find(known.begin(), known.end(), message.type) == known.end())
        refused(message.data.offset(), "an object of unknown kind");
      Cursor data = message.data;
      if (message.type == attribute) check_attribute(parts_, data);
      if (message.type == comment) (void)data.name();
      if (message.type == modification_time) data.skip(8);
      if (message.type == reference_count) data.skip(5);
      if (message.type == link_info) check_info(data, 8);
      if (message.type == attribute_info) check_info(data, 2);
      if (message.type == group_info) check_group_info(data);
    }
    for (const MessageType type :
         {link_info, group_info, comment, modification_time, attribute_info, reference_count})
      (void)single(messages, type);
  }

  /// Few links or attributes are stored as messages, many in a separate heap ("dense" storage), which is
  /// refused.
  static void check_info(Cursor data, std::uint64_t index_size) {
    const std::uint64_t at = data.offset();
    data.expect_version(0);
    const unsigned flags = data.u8();
    if ((flags & 1U) != 0) data.skip(index_size);
    const bool dense = data.u64() != undefined;
    data.skip((flags & 2U) != 0 ? 16 : 8);
    if (dense) refused(at, "many members in HDF5's newest format; write them with libver = \"earliest\"");
  }

  static void check_group_info(Cursor data) {
    data.expect_version(0);
    const unsigned flags = data.u8();
    data.skip((flags & 1U) != 0 ? 4 : 0);
    data.skip((flags & 2U) != 0 ? 4 : 0);
  }

  static bool is_group(const std::vector<Message>& messages) {
    return std::any_of(messages.begin(), messages.end(), [](const Message& message) {
      return message.type == symbol_table || message.type == link_info || message.type == link;
    });
  }

  static bool is_named_type(const std::vector<Message>& messages) {
    return single(messages, datatype) != nullptr && single(messages, dataspace) == nullptr &&
           single(messages, layout) == nullptr;
  }

  void group(const std::vector<Message>& messages, std::uint64_t at, int depth) {
    if (depth > deepest_group) refused(at, "groups nested too deeply");
    const bool mixed = std::any_of(messages.begin(), messages.end(), [](const Message& message) {
      return message.type == layout || message.type == dataspace || message.type == datatype;
    });
    if (mixed) damaged(at, "an object that is a group and a dataset");
    for (const Message& message : messages) {
      if (message.type == link) object(linked(message.data), depth + 1);
    }
    const Message* table = single(messages, symbol_table);
    if (table == nullptr) return;
    Cursor data = table->data;
    const std::uint64_t tree = data.u64();
    const std::uint64_t heap_at = data.u64();
    use(parts_.blocks, heap_at);
    const LocalHeap heap(parts_.file, heap_at);
    for_each_symbol(parts_.file, parts_.sizes, tree, heap, parts_.blocks,
                    [&](const SymbolEntry& entry) { member(entry, depth + 1); });
  }

  /// Address of the object to which a link points.
  static std::uint64_t linked(Cursor data) {
    const std::uint64_t at = data.offset();
    data.expect_version(1);
    const unsigned flags = data.u8();
    if ((flags & 0xe0U) != 0) damaged(at, "unknown flags of a link");
    if ((flags & 8U) != 0 && data.u8() != 0)
      refused(at, "a link to another place or file; copy what it leads to");
    if ((flags & 4U) != 0) data.skip(8);
    if ((flags & 16U) != 0) data.skip(1);
    const std::string_view name = data.text(data.number(std::uint64_t{1} << (flags & 3U)));
    const bool usable = !name.empty() && name.size() <= 255 &&
                        name.find_first_of(std::string_view("/\0", 2)) == std::string_view::npos;
    if (!usable) damaged(at, "a member without a name");
    return data.u64();
  }

  FileParts parts_;
  std::map<std::uint64_t, std::vector<Message>> objects_;
};

}  // namespace
}  // namespace hdf5_check

void check_hdf5_bytes(std::string_view file) {
  hdf5_check::FileCheck(file).run();
}

void check_hdf5_file(const std::string& path) {
  const hdf5_check::MappedFile file(path);
  check_hdf5_bytes(file.bytes());
}

}  // namespace eigentrail
