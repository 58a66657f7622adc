#include "report/encode.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace eigentrail {
namespace {

static_assert(std::endian::native == std::endian::little, "pages hold numbers lowest byte first");

std::string encode(const unsigned char* bytes, std::size_t size) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((size + 2) / 3 * 4);
  for (std::size_t i = 0; i < size; i += 3) {
    const std::size_t n = std::min<std::size_t>(3, size - i);
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8u | (k < n ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= n ? digits[group >> (18 - 6 * k) & 63u] : '=';
  }
  return text;
}

template <class Element>
std::string encode(const std::vector<Element>& values) {
  std::vector<unsigned char> bytes(values.size() * sizeof(Element));
  if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return encode(bytes.data(), bytes.size());
}

}  // namespace

std::string base64(const std::vector<double>& values) {
  return encode(values);
}
std::string base64(const std::vector<float>& values) {
  return encode(values);
}
std::string base64(const std::vector<std::int32_t>& values) {
  return encode(values);
}
std::string base64(const std::vector<std::int16_t>& values) {
  return encode(values);
}

std::string page_json(const Json& json) {
  const std::string plain = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string text;
  text.reserve(plain.size());
  for (const char c : plain) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

}  // namespace eigentrail
