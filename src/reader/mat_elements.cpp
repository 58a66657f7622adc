#include "reader/mat_elements.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/limits.hpp"

namespace eigentrail::reader {
namespace {

constexpr std::size_t tag_bytes = 8;
/// Enough for what stands in front of the numbers of a variable.
constexpr std::size_t beginning_bytes = 1U << 14U;
constexpr std::uint32_t compressed_type = 15, matrix_type = 14;

/// Type, length and content of an element within a variable.
struct Element {
  std::uint32_t type = 0;
  std::size_t length = 0;
  std::string_view content;  ///< as far as it is there
};

/// Goes through the first elements of a variable.
class Elements {
 public:
  Elements(std::string_view bytes, bool swapped) : rest_(bytes), swapped_(swapped) {}

  std::uint32_t word(std::string_view bytes, std::size_t at) const {
    std::uint32_t result = 0;
    for (std::size_t i = 0; i < 4; ++i)
      result = 256 * result + static_cast<unsigned char>(bytes[at + (big_endian() ? i : 3 - i)]);
    return result;
  }

  /// The next element, or nothing where the bytes end. Contents of at most four bytes may stand in the tag.
  std::optional<Element> next() {
    if (rest_.size() < tag_bytes) return std::nullopt;
    const std::uint32_t first = word(rest_, 0);
    const bool in_tag = first >> 16U != 0;
    const Element element{first & 0xFFFFU, in_tag ? first >> 16U : word(rest_, 4),
                          rest_.substr(in_tag ? 4 : tag_bytes)};
    const std::size_t size = in_tag ? tag_bytes : tag_bytes + (element.length + 7) / 8 * 8;
    rest_.remove_prefix(std::min(rest_.size(), size));
    return Element{element.type, element.length, element.content.substr(0, element.length)};
  }

  void skip(std::size_t bytes) { rest_.remove_prefix(std::min(rest_.size(), bytes)); }

 private:
  bool big_endian() const { return swapped_ == (std::endian::native == std::endian::little); }

  std::string_view rest_;
  bool swapped_;
};

/// Bytes of a number of a type; 0 for types that hold no numbers.
std::size_t bytes_of_number(std::uint32_t type) {
  constexpr std::array<std::size_t, 14> sizes{0, 1, 1, 2, 2, 4, 4, 4, 0, 8, 0, 0, 8, 8};
  return type < sizes.size() ? sizes[type] : 0;
}

/// Checks a variable of numbers by its first bytes.
void check_variable(std::string_view bytes, bool swapped) {
  Elements elements(bytes, swapped);
  if (bytes.size() < tag_bytes || elements.word(bytes, 0) != matrix_type) return;
  elements.skip(tag_bytes);
  const auto flags = elements.next(), dimensions = elements.next(), name = elements.next(),
             data = elements.next();
  if (!data || flags->content.size() < 4) return;
  constexpr std::uint32_t first_class = 6, last_class = 15;  // double to uint64
  const std::uint32_t kind = elements.word(flags->content, 0) & 0xFFU;
  const std::size_t size = bytes_of_number(data->type);
  if (kind < first_class || kind > last_class || size == 0) return;
  std::size_t count = 1;
  for (std::size_t at = 0; at + 4 <= dimensions->content.size(); at += 4) {
    const std::size_t extent = elements.word(dimensions->content, at);
    if (extent != 0 && count > limits::matrix_numbers / extent) return;  // refused elsewhere
    count *= extent;
  }
  if (data->length / size >= count) return;
  std::string shown(name->content);
  for (char& c : shown) c = static_cast<unsigned char>(c) < 128 ? c : '?';
  throw std::runtime_error("variable " + printable(shown) + " has " + std::to_string(data->length / size) +
                           " numbers; its dimensions announce " + std::to_string(count));
}

/// The first bytes of what was compressed; fewer if they are damaged.
std::string unpacked(const std::string& bytes) {
  std::string result(beginning_bytes, '\0');
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) return "";
  std::string input = bytes;
  stream.next_in = reinterpret_cast<Bytef*>(input.data());
  stream.avail_in = static_cast<uInt>(input.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  inflate(&stream, Z_SYNC_FLUSH);
  result.resize(result.size() - stream.avail_out);
  inflateEnd(&stream);
  return result;
}

}  // namespace

void check_mat_elements(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 128> header{};
  if (!file.read(header.data(), header.size())) return;
  const std::string_view order(header.data() + 126, 2);
  if (order != "IM" && order != "MI") return;  // another version
  const bool swapped = (order == "MI") == (std::endian::native == std::endian::little);
  if (header[swapped ? 124 : 125] != 1) return;
  const std::uintmax_t size = std::filesystem::file_size(path);
  std::uintmax_t at = header.size();
  while (at < size) {
    std::string beginning(static_cast<std::size_t>(std::min<std::uintmax_t>(size - at, beginning_bytes)),
                          '\0');
    file.seekg(static_cast<std::streamoff>(at));
    if (!file.read(beginning.data(), static_cast<std::streamsize>(beginning.size())) ||
        beginning.size() < tag_bytes)
      break;
    const Elements top(beginning, swapped);
    const bool compressed = top.word(beginning, 0) == compressed_type;
    at += tag_bytes + top.word(beginning, 4);
    check_variable(compressed ? unpacked(beginning.substr(tag_bytes)) : beginning, swapped);
  }
  if (at != size) throw std::runtime_error("ends within a variable; it was cut short");
}

}  // namespace eigentrail::reader
