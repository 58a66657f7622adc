// Numbers and JSON as they stand in the page.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace eigentrail {

using Json = nlohmann::ordered_json;

/// Base64 of the elements' bytes, lowest byte first.
std::string base64(const std::vector<double>& values);
std::string base64(const std::vector<float>& values);
std::string base64(const std::vector<std::int32_t>& values);
std::string base64(const std::vector<std::int16_t>& values);

/// JSON for a script element of a page: nothing in it can end the element, and bytes that are no UTF-8 are
/// replaced. Numbers that are not finite become null.
std::string page_json(const Json& json);

}  // namespace eigentrail
