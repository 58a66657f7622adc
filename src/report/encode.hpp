// Encodes numbers and JSON for the page.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace eigentrail {

using Json = nlohmann::ordered_json;

/// Base64 of bytes.
std::string base64_of(std::span<const std::byte> bytes);

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
std::string page_json(const Json& json);

}  // namespace eigentrail
