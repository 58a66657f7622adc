// Encodes numbers and JSON for the page.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace eigentrail {

using Json = nlohmann::ordered_json;

/// Base64 of the bytes of the elements, little-endian.
std::string base64(const std::vector<double>& values);
std::string base64(const std::vector<float>& values);
std::string base64(const std::vector<std::int32_t>& values);
std::string base64(const std::vector<std::int16_t>& values);

/// JSON text for a script element of a page. It contains no '<', so it cannot end the element. Bytes that are
/// not UTF-8 are replaced. Numbers that are not finite become null.
std::string page_json(const Json& json);

}  // namespace eigentrail
