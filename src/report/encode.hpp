// Encodes numbers and JSON for the page.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "core/texts.hpp"

namespace eigentrail {

static_assert(std::endian::native == std::endian::little, "pages hold numbers lowest byte first");

using Json = nlohmann::ordered_json;

/// Base64 of bytes.
inline std::string base64_of(std::span<const std::byte> bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8u | (k < n ? std::to_integer<unsigned>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= n ? digits[group >> (18 - 6 * k) & 63u] : '=';
  }
  return text;
}

/// Base64 of the bytes of the elements, little-endian, as numbers of another type if one is named.
template <class Stored = void, class Element>
std::string base64(const std::vector<Element>& values) {
  if constexpr (std::is_void_v<Stored> || std::is_same_v<Stored, Element>) {
    return base64_of(std::as_bytes(std::span(values)));
  } else {
    return base64(std::vector<Stored>(values.begin(), values.end()));
  }
}

/// JSON text for a script element of a page. It contains no '<', so it cannot end the element. Bytes that are
/// not UTF-8 are replaced. Numbers that are not finite become null.
inline std::string page_json(const Json& json) {
  return replaced_all(json.dump(-1, ' ', false, Json::error_handler_t::replace), "<", "\\u003c");
}

}  // namespace eigentrail
