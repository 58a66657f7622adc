// Texts: their parts and letters, and lists and numbers in them.
#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace eigentrail {

/// The items of a list, one after the other. `text`, a member or a function, makes a text of an item.
template <class List, class Text = std::identity>
std::string joined(const List& list, std::string_view separator = ", ", Text text = {}) {
  std::string all;
  bool first = true;
  for (const auto& item : list) {
    if (!first) all += separator;
    all += std::invoke(text, item);
    first = false;
  }
  return all;
}

/// The first items of a list, `most` at most.
template <class Item>
std::span<const Item> first_items(const std::vector<Item>& list, std::size_t most) {
  return std::span(list).first(std::min(most, list.size()));
}

/// A part of `text`: without the characters `blanks` at its ends.
inline std::string_view trimmed(std::string_view text, std::string_view blanks = " \t\r\f\v") {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// Adds a code point in UTF-8.
inline void append_utf8(std::string& text, std::uint32_t c) {
  const unsigned tails = c < 0x80U ? 0 : c < 0x800U ? 1 : c < 0x10000U ? 2 : 3;  // of six bits each
  constexpr std::array heads{0U, 0xC0U, 0xE0U, 0xF0U};
  const std::uint32_t first = c >> (6U * tails);
  text += static_cast<char>(heads[tails] | (tails == 3 ? first & 7U : first));
  for (unsigned i = tails; i-- > 0;) text += static_cast<char>(0x80U | ((c >> (6U * i)) & 0x3FU));
}

/// The parts of a text between separators.
inline std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text + separator);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

/// "a, b and c", with `last` before the last one.
inline std::string enumerated(const std::vector<std::string>& items, std::string_view last = " and ") {
  std::string all;
  for (std::size_t i = 0; i < items.size(); ++i)
    all.append(i == 0 ? "" : i + 1 == items.size() ? last : ", ").append(items[i]);
  return all;
}

/// "1 file", "3 files".
inline std::string count_of(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

/// The number that a text is; nothing for other texts.
template <class Number>
std::optional<Number> parsed_number(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

/// A number with so many significant digits, as people read it.
inline std::string short_text(double number, int digits) {
  std::ostringstream text;
  text.precision(digits);
  text << number;
  return text.str();
}

/// A text with `what` replaced wherever it stands.
inline std::string replaced_all(std::string text, std::string_view what, std::string_view with) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size())
    text.replace(at, what.size(), with);
  return text;
}

inline std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

inline std::string upper_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

/// Whether both are equal but for upper and lower case.
inline bool equal_words(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

}  // namespace eigentrail
