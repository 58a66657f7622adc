#include "core/hdf5_check/filters.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>

namespace eigentrail::hdf5_check {
namespace {

constexpr unsigned deflate_filter = 1;  // filter 2 is shuffle, which does not change the size
constexpr unsigned fletcher32_filter = 3;
constexpr std::uint64_t checksum_size = 4;

/// Size in bytes of a compressed text after decompression; stops once it exceeds `most`.
std::uint64_t inflated_size(Cursor stored, std::uint64_t size, std::uint64_t most) {
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) throw Hdf5Error("no memory to look at a compressed chunk");
  std::array<unsigned char, 16384> buffer{};
  const std::string_view bytes = stored.text(size);
  // zlib does not modify its input, although next_in is not const.
  stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(bytes.data()));  // NOLINT
  stream.avail_in = static_cast<uInt>(bytes.size());
  int status = Z_OK;
  while (status == Z_OK && stream.total_out <= most) {
    stream.next_out = buffer.data();
    stream.avail_out = buffer.size();
    status = inflate(&stream, Z_SYNC_FLUSH);
  }
  const std::uint64_t result = stream.total_out;
  inflateEnd(&stream);
  if (status != Z_STREAM_END) damaged(stored.offset() - size, "a compressed chunk cannot be read");
  return result;
}

}  // namespace

Filters read_filters(Cursor data) {
  const std::uint64_t at = data.offset();
  const unsigned version = data.u8();
  const unsigned count = data.u8();
  if (version != 1 && version != 2) damaged(at, "unknown version of a list of filters");
  if (version == 1) data.skip(6);
  Filters filters;
  for (unsigned i = 0; i < count; ++i) {
    const unsigned filter = data.u16();
    const bool known = filter >= deflate_filter && filter <= fletcher32_filter;
    if (!known || std::find(filters.begin(), filters.end(), filter) != filters.end())
      refused(at, "compression other than deflate; write the dataset without it");
    const unsigned name = version == 1 ? data.u16() : 0;
    data.skip(2);  // flags
    const unsigned values = data.u16();
    if (name % 8 != 0) damaged(at, "a filter's name is not aligned");
    if (name > 0) (void)data.part(name).name();
    data.skip(4 * std::uint64_t{values});
    if (version == 1 && values % 2 != 0) data.skip(4);
    filters.push_back(filter);
  }
  return filters;
}

void check_chunk(const Filters& filters, std::uint64_t skipped, Cursor stored, std::uint64_t size) {
  const std::uint64_t at = stored.offset();
  std::uint64_t bytes = stored.left();
  for (std::size_t i = filters.size(); i > 0; --i) {
    if ((skipped >> (i - 1) & 1U) != 0) continue;
    if (filters[i - 1] == fletcher32_filter) {
      if (bytes < checksum_size) damaged(at, "a chunk without its checksum");
      bytes -= checksum_size;
    } else if (filters[i - 1] == deflate_filter) {
      bytes = inflated_size(stored, bytes, size + checksum_size);
    }
  }
  if (bytes != size || skipped >> filters.size() != 0) damaged(at, "a chunk of the wrong size");
}

}  // namespace eigentrail::hdf5_check
