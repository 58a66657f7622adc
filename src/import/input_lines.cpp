#include "import/input_lines.hpp"

#include <cmath>

#include "core/texts.hpp"

namespace eigentrail {
namespace {

bool is_comment(std::string_view line) {
  return line.front() == '!' || line.front() == '#' || line.front() == '%';
}

/// Words between blanks or commas; a text in quotes is one word.
std::vector<std::string_view> words_and_texts(std::string_view line) {
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t begin = line.find_first_not_of(" \t\r\f\v,");
    if (begin == std::string_view::npos) return words;
    line.remove_prefix(begin);
    const bool quoted = line.front() == '"' || line.front() == '\'';
    std::size_t end = quoted ? line.find(line.front(), 1) : line.find_first_of(" \t\r\f\v,");
    if (quoted && end != std::string_view::npos) ++end;
    words.push_back(line.substr(0, end));
    if (end == std::string_view::npos) return words;
    line.remove_prefix(end);
  }
}

}  // namespace

std::vector<std::string_view> InputLines::next() {
  while (const auto line = lines_.next()) {
    const std::string_view content = trimmed(*line);
    if (!content.empty() && !is_comment(content)) return words_and_texts(content);
  }
  return {};
}

double InputLines::number(std::string_view word, const std::string& what) const {
  const auto value = number_of(word);
  if (!value || !std::isfinite(*value)) fail(what + ": expected a number, found " + shown(word));
  return *value;
}

std::size_t InputLines::count(std::string_view word, const std::string& what, std::size_t most) const {
  const auto value = whole_number_of(word);
  if (!value || *value < 1 || *value > static_cast<long>(most))
    fail(what + ": expected a whole number from 1 to " + std::to_string(most) + ", found " + shown(word));
  return static_cast<std::size_t>(*value);
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
    values.push_back(number(word, what));
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
