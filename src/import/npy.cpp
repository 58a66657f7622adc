#include "import/npy.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>

#include "core/texts.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/limits.hpp"

namespace eigentrail {
namespace {

/// Letter and size of the elements, as in "<f8".
struct ElementCode {
  bool swapped = false;
  char kind = 'f';
  std::size_t bytes = 8;
};

class NpyReader {
 public:
  NpyReader(std::string_view bytes, const std::string& where) : bytes_(bytes), where_(where) {}

  std::size_t announced_bytes() {
    read_header();
    const ElementCode code = element_code();
    const std::size_t in_front = bytes_.size() - data_.size();
    return in_front + announced_count(shape()) * code.bytes;
  }

  NamedArray read() {
    read_header();
    NamedArray array;
    const ElementCode code = element_code();
    const bool fortran = value_of("fortran_order").substr(0, 4) == "True";
    array.shape = shape();
    array.set_order(!fortran);
    array.is_text = code.kind == 'U' || code.kind == 'S';
    const std::size_t count = checked_count(array.shape, code.bytes);
    if (!array.is_text) array.numbers.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::string_view element = data_.substr(i * code.bytes, code.bytes);
      if (array.is_text) {
        array.texts.push_back(text(std::string(element), code));
      } else {
        array.numbers.push_back(number(element, code));
      }
    }
    return array;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw InputError(where_ + ": " + message); }

  void read_header() {
    constexpr std::string_view magic = "\x93NUMPY";
    constexpr std::size_t prefix = 8;  // magic and version
    if (bytes_.size() < prefix + 4 || bytes_.substr(0, magic.size()) != magic)
      fail("is no array of NumPy: it does not begin with \\x93NUMPY");
    const auto byte = [this](std::size_t i) {
      return static_cast<std::size_t>(static_cast<unsigned char>(bytes_[i]));
    };
    const std::size_t version = byte(6);
    if (version < 1 || version > 3)
      fail("version " + std::to_string(version) + " of NumPy's format; known: 1 to 3");
    const std::size_t length_bytes = version == 1 ? 2 : 4;
    std::size_t length = 0;
    for (std::size_t i = 0; i < length_bytes; ++i) length |= byte(prefix + i) << (8 * i);
    const std::size_t begin = prefix + length_bytes;
    if (length > bytes_.size() - begin) fail("ends within its header");
    header_ = bytes_.substr(begin, length);
    data_ = bytes_.substr(begin + length);
  }

  /// What follows 'key': in the header.
  std::string_view value_of(const std::string& key) const {
    const std::size_t at = header_.find("'" + key + "'");
    const std::size_t colon = at == std::string_view::npos ? at : header_.find(':', at);
    if (colon == std::string_view::npos) fail("its header has no '" + key + "'");
    std::string_view rest = header_.substr(colon + 1);
    rest.remove_prefix(std::min(rest.size(), rest.find_first_not_of(' ')));
    return rest;
  }

  ElementCode element_code() const {
    const std::string_view rest = value_of("descr");
    const std::size_t end = rest.size() > 1 ? rest.find('\'', 1) : std::string_view::npos;
    const std::string text(rest.substr(0, end == std::string_view::npos ? 0 : end + 1));
    const std::string shown = printable(std::string(rest.substr(0, 20)));
    if (text.size() < 4 || text[0] != '\'')
      fail("elements of several fields (" + shown + "); expected plain numbers or texts");
    ElementCode code;
    code.swapped = text[1] == '>' && std::endian::native == std::endian::little;
    code.kind = text[2];
    const auto bytes = parsed_number<std::size_t>(std::string_view(text).substr(3, text.size() - 4));
    if (code.kind == 'O')
      fail(
          "holds Python objects; save the array with a plain type, such as np.asarray(x, dtype=float) or "
          "dtype=str");
    if (code.kind == 'c') fail("is complex; expected real numbers");
    if (!bytes) fail("unknown type " + shown);
    code.bytes = code.kind == 'U' ? 4 * *bytes : *bytes;
    const bool known =
        (code.kind == 'f' && (code.bytes == 4 || code.bytes == 8)) ||
        ((code.kind == 'i' || code.kind == 'u') && std::has_single_bit(code.bytes) && code.bytes <= 8) ||
        (code.kind == 'b' && code.bytes == 1) ||
        ((code.kind == 'U' || code.kind == 'S') && code.bytes <= limits::text_length);
    if (!known) fail("type " + shown + "; known: f4, f8, i1 to i8, u1 to u8, b1, U and S");
    return code;
  }

  std::vector<std::size_t> shape() const {
    std::string_view rest = value_of("shape");
    if (rest.empty() || rest[0] != '(') fail("its shape cannot be read");
    rest = rest.substr(1, rest.find(')') - 1);
    std::vector<std::size_t> result;
    while (true) {
      const std::size_t begin = rest.find_first_of("0123456789");
      if (begin == std::string_view::npos) return result;
      rest.remove_prefix(begin);
      std::size_t extent = 0;
      const auto parsed = std::from_chars(rest.data(), rest.data() + rest.size(), extent);
      if (parsed.ec != std::errc() || result.size() == 8) fail("its shape cannot be read");
      result.push_back(extent);
      rest.remove_prefix(static_cast<std::size_t>(parsed.ptr - rest.data()));
    }
  }

  std::size_t announced_count(const std::vector<std::size_t>& extents) const {
    std::size_t count = 1;
    for (const std::size_t extent : extents) {
      if (extent != 0 && count > limits::matrix_numbers / extent)
        fail("has more than " + std::to_string(limits::matrix_numbers) + " elements");
      count *= extent;
    }
    return count;
  }

  std::size_t checked_count(const std::vector<std::size_t>& extents, std::size_t element) const {
    const std::size_t count = announced_count(extents);
    if (element == 0 ? count > limits::matrix_rows
                     : count > data_.size() / element || count * element < data_.size())
      fail("has " + std::to_string(data_.size()) + " bytes of data; its header announces " +
           std::to_string(count * element));
    return count;
  }

  static double number(std::string_view stored, const ElementCode& code) {
    std::array<char, 8> element{};
    std::copy(stored.begin(), stored.end(), element.begin());
    if (code.swapped)
      std::reverse(element.begin(), element.begin() + static_cast<std::ptrdiff_t>(code.bytes));
    return stored_number(std::bit_cast<std::uint64_t>(element), code.bytes, code.kind);
  }

  /// Texts are filled up with zeros; U has four bytes per character.
  static std::string text(const std::string& element, const ElementCode& code) {
    std::string result;
    for (std::size_t i = 0; i < element.size(); i += code.kind == 'U' ? 4 : 1) {
      std::uint32_t character = static_cast<unsigned char>(element[i]);
      if (code.kind == 'U') {
        std::string four = element.substr(i, 4);
        if (code.swapped) std::reverse(four.begin(), four.end());
        std::memcpy(&character, four.data(), 4);
      }
      if (character == 0) break;
      append_utf8(result, character);
    }
    return result;
  }

  std::string_view bytes_;
  const std::string& where_;
  std::string_view header_, data_;
};

}  // namespace

std::size_t announced_npy_bytes(std::string_view beginning, const std::string& where) {
  return NpyReader(beginning, where).announced_bytes();
}

NamedArray read_npy(std::string_view bytes, const std::string& where) {
  return NpyReader(bytes, where).read();
}

}  // namespace eigentrail
