#include "import/text_lines.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/texts.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/plain_file.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/limits.hpp"

namespace eigentrail {
std::string read_text_file(const std::string& path) {
  require_plain_file(path);
  if (std::filesystem::file_size(path) > limits::text_file_bytes)
    throw InputError(path + ": is larger than " + std::to_string(limits::text_file_bytes >> 20U) + " MiB");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path + ": cannot be opened");
  return {std::istreambuf_iterator<char>(file), {}};
}

std::optional<std::string_view> TextLines::next() {
  if (rest_.empty()) return std::nullopt;
  const std::size_t end = rest_.find('\n');
  std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  ++line_;
  return line;
}

void TextLines::fail(const std::string& message) const {
  throw InputError(path_ + ":" + std::to_string(line_) + ": " + message);
}

double TextLines::number(std::string_view word, std::string_view expected) const {
  const auto value = number_of(word);
  if (!value || !std::isfinite(*value)) fail(std::string(expected) + ", found " + shown(word));
  return *value;
}

long TextLines::whole(std::string_view word, std::string_view expected, long least, long most) const {
  const auto value = whole_number_of(word);
  if (!value || *value < least || *value > most) fail(std::string(expected) + ", found " + shown(word));
  return *value;
}

std::string_view columns_of_line(std::string_view line, std::size_t begin, std::size_t width) {
  return begin < line.size() ? trimmed(line.substr(begin, width)) : std::string_view();
}

std::string shown(std::string_view word) {
  constexpr std::size_t most = 40;
  return "'" + printable(std::string(word.substr(0, most))) + "'";
}

std::vector<std::string_view> words_of(std::string_view line, std::string_view separators,
                                       std::string_view quotes) {
  std::vector<std::string_view> words;
  std::size_t end = 0;
  while (true) {
    const std::size_t begin = line.find_first_not_of(separators, end);
    if (begin == std::string_view::npos) return words;
    const bool quoted = quotes.find(line[begin]) != std::string_view::npos;
    end = quoted ? line.find(line[begin], begin + 1) : line.find_first_of(separators, begin);
    if (quoted && end != std::string_view::npos) ++end;
    words.push_back(line.substr(begin, end - begin));
    if (end == std::string_view::npos) return words;
  }
}

std::optional<double> number_of(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  std::string text(word);
  for (char& c : text) c = c == 'D' || c == 'd' ? 'e' : c;
  // Fortran leaves the letter out before exponents of three digits.
  const std::size_t sign = text.find_first_of("+-", 1);
  if (sign != std::string::npos && text.find_first_of("eE") == std::string::npos) text.insert(sign, "e");
  double value = 0.0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  if (parsed.ptr != text.data() + text.size() || text.empty()) return std::nullopt;
  if (parsed.ec == std::errc::result_out_of_range)
    return text.find("e-") != std::string::npos ? 0.0 : INFINITY;
  return parsed.ec == std::errc() ? std::optional(value) : std::nullopt;
}

std::optional<long> whole_number_of(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  return parsed_number<long>(word);
}

bool is_identifier(std::string_view name) {
  const auto word = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  return !name.empty() && std::isalpha(static_cast<unsigned char>(name[0])) != 0 &&
         std::ranges::all_of(name, word);
}

int printed_digits(std::string_view word) {
  int digits = 0;
  bool point = false, started = false;
  for (const char c : word) {
    if (std::isdigit(static_cast<unsigned char>(c)) != 0) {
      started = started || c != '0';
      digits += started ? 1 : 0;
    } else if (c == '.') {
      point = true;
    } else if (digits > 0 || (c != '+' && c != '-')) {
      break;
    }
  }
  return point ? digits : 0;
}

std::vector<std::string_view> InputLines::next() {
  while (const auto line = TextLines::next()) {
    const std::string_view content = trimmed(*line);
    const bool is_comment = content.find_first_of("!#%") == 0;
    if (!content.empty() && !is_comment) return words_of(content, " \t\r\f\v,", "\"'");
  }
  return {};
}

std::size_t InputLines::count(std::string_view word, const std::string& what, std::size_t most) const {
  const std::string expected = what + ": expected a whole number from 1 to " + std::to_string(most);
  return static_cast<std::size_t>(whole(word, expected, 1, static_cast<long>(most)));
}

std::vector<double> InputLines::row(const std::vector<std::string_view>& words, std::size_t count,
                                    const std::string& what) const {
  if (words.empty()) fail(what + ": the file ends before it; it was cut short");
  std::vector<double> values;
  for (const std::string_view word : words) {
    if (values.size() == count) {
      if (number_of(word)) fail(what + " has more than " + std::to_string(count) + " numbers");
      break;  // a comment
    }
    if (!number_of(word) && !values.empty())
      fail(what + " has " + std::to_string(values.size()) + " numbers before " + shown(word) + "; expected " +
           std::to_string(count));
    values.push_back(number(word, what + ": expected a number"));
  }
  if (values.size() < count)
    fail(what + " has " + std::to_string(values.size()) + " numbers; expected " + std::to_string(count));
  return values;
}

bool has_name(const std::vector<std::string_view>& words, std::string_view name) {
  return words.size() > 1 && equal_words(words[1], name);
}

std::string without_quotes(std::string_view word) {
  if (word.size() > 1 && (word.front() == '"' || word.front() == '\'') && word.back() == word.front())
    word = word.substr(1, word.size() - 2);
  return std::string(word);
}

}  // namespace eigentrail
