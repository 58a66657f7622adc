#include "core/hdf5_check/types.hpp"

#include <array>
#include <utility>

namespace eigentrail::hdf5_check {
namespace {

constexpr int deepest_type = 4;  ///< nesting of compounds; eigentrail writes one level
/// Members of a compound or enumeration; complex numbers have two.
constexpr std::uint64_t most_members = 64;
/// Bytes; texts of fixed length are the largest.
constexpr std::uint64_t largest_element = std::uint64_t{1} << 16U;
constexpr unsigned largest_rank = 8;  ///< eigentrail writes four dimensions
constexpr std::uint64_t most_bytes = std::uint64_t{1} << 48U;

enum Class : unsigned { integer, real, text = 3, compound = 6, reference, enumeration, variable };

struct Head {
  unsigned version = 0;
  std::uint64_t bits = 0;
  std::uint64_t size = 0;
  std::uint64_t at = 0;
};

/// Other offsets and precisions are legal, but make HDF5 convert the numbers bit by bit.
void read_integer(Cursor& data, const Head& head) {
  const unsigned offset = data.u16();
  const unsigned precision = data.u16();
  const bool usual = head.size == 1 || head.size == 2 || head.size == 4 || head.size == 8;
  if (!usual || offset != 0 || precision != 8 * head.size)
    refused(head.at, "an integer of unusual size; write it as 64-bit integer");
}

void read_real(Cursor& data, const Head& head) {
  struct Format {
    std::uint64_t size;
    unsigned exponent_at, exponent, fraction;
    std::uint64_t bias;
  };
  constexpr std::array<Format, 3> ieee{{{8, 52, 11, 52, 1023}, {4, 23, 8, 23, 127}, {2, 10, 5, 10, 15}}};
  const unsigned offset = data.u16();
  const unsigned precision = data.u16();
  const unsigned exponent_at = data.u8();
  const unsigned exponent = data.u8();
  const unsigned fraction_at = data.u8();
  const unsigned fraction = data.u8();
  const std::uint64_t bias = data.u32();
  for (const Format& f : ieee) {
    const bool same = f.size == head.size && offset == 0 && precision == 8 * f.size &&
                      exponent_at == f.exponent_at && exponent == f.exponent && fraction_at == 0 &&
                      fraction == f.fraction && bias == f.bias;
    const bool sign_first = (head.bits >> 8U & 0xffU) == 8 * f.size - 1;
    const bool one_before_point = (head.bits >> 4U & 3U) == 2 && (head.bits & 0x40U) == 0;
    if (same && sign_first && one_before_point) return;
  }
  refused(head.at, "a real number that is not of IEEE's 16, 32 or 64 bits; write it as 64-bit number");
}

/// First byte of a member, and the byte after its last one.
using Range = std::pair<std::uint64_t, std::uint64_t>;

void check_member(const std::vector<Range>& others, const Range& member, const Head& head) {
  bool fits = member.second <= head.size;
  for (const Range& other : others)
    fits = fits && (member.first >= other.second || other.first >= member.second);
  if (!fits) damaged(head.at, "members of a compound lie outside of it, or in each other");
}

Datatype read_compound(Cursor& data, const Head& head, int depth) {
  Datatype type{head.size, {}};
  std::vector<Range> ranges;
  const std::uint64_t members = head.bits & 0xffffU;
  if (members == 0 || members > most_members) refused(head.at, "a compound of too many members");
  for (std::uint64_t i = 0; i < members; ++i) {
    (void)(head.version < 3 ? data.padded_name() : data.name());
    std::uint64_t width = 1;
    while (head.version >= 3 && head.size >> 8U * width != 0) ++width;
    const std::uint64_t offset = head.version < 3 ? data.u32() : data.number(width);
    if (head.version == 1) {
      if (data.u8() != 0) refused(data.offset(), "an array in a compound");
      data.skip(27);
    }
    const Datatype member = read_datatype(data, depth + 1);
    if (offset > head.size) damaged(head.at, "a member lies outside of its compound");
    ranges.emplace_back(offset, offset + member.size);
    check_member({ranges.begin(), ranges.end() - 1}, ranges.back(), head);
    for (const HeapPart& part : member.heap_parts)
      type.heap_parts.push_back({offset + part.offset, part.unit});
  }
  return type;
}

void read_enumeration(Cursor& data, const Head& head, int depth) {
  const std::uint64_t base_at = data.offset();
  const bool of_integers = !data.rest().empty() && (data.rest()[0] & 0x0f) == integer;
  const Datatype base = read_datatype(data, depth + 1);
  if (!of_integers || base.size != head.size) damaged(base_at, "an enumeration that is not of integers");
  const std::uint64_t members = head.bits & 0xffffU;
  if (members > most_members) refused(head.at, "an enumeration of too many members");
  for (std::uint64_t i = 0; i < members; ++i) (void)(head.version < 3 ? data.padded_name() : data.name());
  data.skip(members * base.size);
}

/// Texts of variable length, and the lists of references that HDF5 writes for dimension scales.
Datatype read_variable(Cursor& data, const Head& head, int depth) {
  const bool is_text = (head.bits & 0x0fU) == 1;
  const unsigned base_class = data.rest().empty() ? 0 : static_cast<unsigned>(data.rest()[0]) & 0x0fU;
  const Datatype base = read_datatype(data, depth + 1);
  if (head.size != 16) damaged(head.at, "a text of variable length is not 16 bytes in place");
  const bool usual_text = is_text && base.size == 1 && (base_class == text || base_class == integer);
  const bool usual_list = !is_text && base_class == reference;
  if (!usual_text && !usual_list) refused(head.at, "lists of variable length; only texts are read");
  return {head.size, {{0, base.size}}};
}

}  // namespace

Datatype read_datatype(Cursor& data, int depth) {
  if (depth > deepest_type) refused(data.offset(), "a type nested too deeply");
  Head head;
  head.at = data.offset();
  const unsigned first = data.u8();
  head.version = first >> 4U;
  head.bits = data.number(3);
  head.size = data.u32();
  if (head.version < 1 || head.version > 3) damaged(head.at, "unknown version of a type");
  if (head.size == 0 || head.size > largest_element) damaged(head.at, "an element of impossible size");
  switch (first & 0x0fU) {
    case integer:
      read_integer(data, head);
      return {head.size, {}};
    case real:
      read_real(data, head);
      return {head.size, {}};
    case text:
      return {head.size, {}};
    case compound:
      return read_compound(data, head, depth);
    case reference:
      if ((head.bits & 0x0fU) != 0 || head.size != 8) refused(head.at, "references to regions");
      return {head.size, {}};
    case enumeration:
      read_enumeration(data, head, depth);
      return {head.size, {}};
    case variable:
      return read_variable(data, head, depth);
    default:
      refused(head.at, "a type that is no number and no text");
  }
}

std::uint64_t product(const std::vector<std::uint64_t>& sizes, std::uint64_t at) {
  std::uint64_t result = 1;
  for (const std::uint64_t size : sizes) {
    if (size != 0 && result > most_bytes / size) damaged(at, "sizes beyond any memory");
    result *= size;
  }
  return result;
}

Dataspace read_dataspace(Cursor& data) {
  const std::uint64_t at = data.offset();
  const unsigned version = data.u8();
  const unsigned rank = data.u8();
  const unsigned flags = data.u8();
  const unsigned kind = data.u8();  // reserved in version 1
  if (version != 1 && version != 2) damaged(at, "unknown version of a shape");
  if (rank > largest_rank) refused(at, "more than " + std::to_string(largest_rank) + " dimensions");
  if (flags > 1) refused(at, "permuted dimensions");
  if (version == 1) data.skip(4);
  if (version == 2 && (kind > 2 || (kind != 1 && rank != 0))) damaged(at, "a shape of unknown kind");
  Dataspace space;
  for (unsigned i = 0; i < rank; ++i) space.shape.push_back(data.u64());
  for (unsigned i = 0; i < rank && flags == 1; ++i) {
    const std::uint64_t most = data.u64();
    if (most < space.shape[i]) damaged(at, "a dimension is longer than it may become");
  }
  space.count = version == 2 && kind == 2 ? 0 : product(space.shape, at);
  return space;
}

}  // namespace eigentrail::hdf5_check
