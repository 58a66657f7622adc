#include "eigentrail/core/text.hpp"

#include <array>
#include <charconv>
#include <map>

namespace eigentrail {

std::string exact_text(double value) {
  std::array<char, 32> buffer{};
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
}

std::string printable(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  return text;
}

std::optional<std::pair<std::size_t, std::size_t>> first_repetition(const std::vector<std::string>& texts) {
  std::map<std::string, std::size_t> places;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const auto [known, is_new] = places.emplace(texts[i], i);
    if (!is_new) return std::pair(known->second, i);
  }
  return std::nullopt;
}

}  // namespace eigentrail
