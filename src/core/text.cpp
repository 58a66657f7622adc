#include "eigentrail/core/text.hpp"

#include <array>
#include <charconv>
#include <map>
#include <string_view>

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

std::string csv_cell(const std::string& text) {
  double number = 0.0;
  const std::size_t sign = text.starts_with('+') ? 1 : 0;
  const char* end = text.data() + text.size();
  const bool is_number = !text.empty() && std::from_chars(text.data() + sign, end, number).ptr == end;
  const bool is_formula = !text.empty() &&
                          std::string_view("=+-@\t\r").find(text.front()) != std::string_view::npos &&
                          !is_number;
  if (!is_formula && text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = is_formula ? "\"'" : "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
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
