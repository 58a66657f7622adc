#include "core/hdf5_check/object_header.hpp"

#include <array>

namespace eigentrail::hdf5_check {
namespace {

constexpr std::size_t most_messages = 65536;  ///< messages of one object; the format counts them with 16 bits

/// Flags of messages. A shared message is stored in another object. The other flags forbid programs that do
/// not know the message to open the object.
constexpr unsigned shared = 0x02;
constexpr unsigned refused_flags = 0x08 | 0x10 | 0x80;

class HeaderReader {
 public:
  HeaderReader(std::string_view file, std::set<std::uint64_t>& blocks) : file_(file), blocks_(blocks) {}

  std::vector<Message> read(std::uint64_t address) {
    use(blocks_, address);
    Cursor begin = piece(file_, address, 16);
    version_ = begin.rest()[0] == 1 ? 1 : 2;
    Cursor block = version_ == 1 ? begin_1(begin) : begin_2(address);
    read_block(block);
    for (std::size_t i = 0; i < messages.size(); ++i) {
      if (messages[i].type == continuation) follow(messages[i].data);
    }
    if (version_ == 1 && messages.size() != expected_) damaged(address, "wrong number of messages");
    return std::move(messages);
  }

 private:
  Cursor begin_1(Cursor begin) {
    begin.skip(2);
    expected_ = begin.u16();
    begin.skip(4);
    const std::uint64_t size = begin.u32();
    return piece(file_, begin.offset() + 4, size);
  }

  Cursor begin_2(std::uint64_t address) {
    Cursor begin = piece(file_, address, file_.size() - address);
    begin.expect("OHDR");
    begin.expect_version(2);
    const unsigned flags = begin.u8();
    if ((flags & 0xc0U) != 0) damaged(address, "unknown flags of an object");
    order_ = (flags & 0x04U) != 0;
    if ((flags & 0x20U) != 0) begin.skip(16);
    if ((flags & 0x10U) != 0) begin.skip(4);
    const Cursor block = begin.part(begin.number(std::uint64_t{1} << (flags & 3U)));
    expect_checksum(file_, address, begin.offset() - address);
    return block;
  }

  void follow(Cursor where) {
    const std::uint64_t address = where.u64();
    const std::uint64_t size = where.u64();
    // HDF5 loses the messages read so far if a continuation block is too small for a message.
    if (size < message_head())
      damaged(where.offset(), "an object that goes on in a block too small for a message");
    use(blocks_, address);
    Cursor block = piece(file_, address, size);
    if (version_ == 2) {
      block.expect("OCHK");
      if (block.left() < 4) damaged(address, "what begins here ends too early");
      expect_checksum(file_, address, size - 4);
      block = block.part(block.left() - 4);
    }
    read_block(block);
  }

  /// Number of bytes before the data of a message.
  std::uint64_t message_head() const { return version_ == 1 ? 8 : order_ ? 6 : 4; }

  void read_block(Cursor block) {
    while (block.left() >= message_head()) read_message(block);
    if (version_ == 1 && block.left() != 0) damaged(block.offset(), "a message ends too early");
  }

  void read_message(Cursor& block) {
    const std::uint64_t at = block.offset();
    const unsigned type = version_ == 1 ? block.u16() : block.u8();
    const std::uint64_t size = block.u16();
    const unsigned flags = block.u8();
    if (version_ == 1) block.skip(3);
    if (version_ == 2 && order_) block.skip(2);
    if (version_ == 1 && size % 8 != 0) damaged(at, "a message is not aligned");
    if ((flags & refused_flags) != 0) refused(at, "an object of a newer HDF5");
    if (messages.size() == most_messages) damaged(at, "an object with too many messages");
    const Cursor data = block.part(size);
    messages.push_back({type, (flags & shared) != 0 ? named_type(type, data) : data});
  }

  /// Data of a type that is stored as an object of its own, with a name, and used by many datasets.
  Cursor named_type(unsigned type, Cursor where) const {
    const std::uint64_t at = where.offset();
    const unsigned version = where.u8();
    const unsigned place = where.u8();
    if (type != datatype || is_named_type_ || version < 1 || version > 3 || (version == 3 && place != 2))
      refused(at, "what objects share but for named types; write each with its own");
    if (version == 1) where.skip(6);
    // a set of its own: the object is also a member of a group and may be marked as used there
    std::set<std::uint64_t> own;
    HeaderReader reader(file_, own);
    reader.is_named_type_ = true;
    for (const Message& message : reader.read(where.u64())) {
      if (message.type == datatype) return message.data;
    }
    damaged(at, "a named type that is none");
  }

  std::vector<Message> messages;
  std::string_view file_;
  std::set<std::uint64_t>& blocks_;
  int version_ = 1;
  bool order_ = false;
  std::size_t expected_ = 0;
  bool is_named_type_ = false;  ///< the object that is read is a named type and must not refer to another one
};

}  // namespace

void use(std::set<std::uint64_t>& blocks, std::uint64_t address) {
  if (!blocks.insert(address).second) damaged(address, "belongs to two objects");
}

std::vector<Message> read_messages(std::string_view file, std::uint64_t address,
                                   std::set<std::uint64_t>& blocks) {
  return HeaderReader(file, blocks).read(address);
}

}  // namespace eigentrail::hdf5_check
