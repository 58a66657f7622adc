#include "map_picture.hpp"

#include <algorithm>

#include "output.hpp"

namespace eigentrail::app {
namespace {

constexpr std::size_t most_columns = 60;
constexpr std::size_t most_rows = 24;

char symbol(int unstable) {
  if (unstable == MapLine::unknown) return '?';
  if (unstable == 0) return '.';
  return unstable <= 9 ? static_cast<char>('0' + unstable) : '+';
}

/// The cells to show of n, at most `most` and including both ends, in ascending order of their values.
/// `ascending`: whether the values of the cells ascend.
std::vector<std::size_t> shown(std::size_t n, std::size_t most, bool ascending) {
  const std::size_t count = std::min(n, most);
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < count; ++i) cells.push_back((i * (n - 1) + (count - 1) / 2) / (count - 1));
  if (!ascending) std::reverse(cells.begin(), cells.end());
  return cells;
}

std::string padded(const std::string& text, std::size_t width) {
  return std::string(width - std::min(width, text.size()), ' ') + text;
}

}  // namespace

std::vector<std::string> map_picture(const StabilityMap& map, const std::string& first,
                                     const std::string& second) {
  const auto columns = shown(map.first.size(), most_columns, map.first.front() < map.first.back());
  auto rows = shown(map.lines.size(), most_rows, map.lines.front().second < map.lines.back().second);
  std::reverse(rows.begin(), rows.end());
  const auto value_of = [&](std::size_t row) { return rounded(map.lines[row].second, 5); };
  const std::size_t width =
      std::max({second.size(), value_of(rows.front()).size(), value_of(rows.back()).size()});
  std::vector<std::string> text{"  " + padded(second, width)};
  for (const std::size_t row : rows) {
    const bool end = row == rows.front() || row == rows.back();
    std::string line = "  " + padded(end ? value_of(row) : "", width) + " |";
    for (const std::size_t column : columns) line += symbol(map.lines[row].unstable[column]);
    text.push_back(line);
  }
  const std::string left = rounded(map.first[columns.front()], 5);
  const std::string right = rounded(map.first[columns.back()], 5);
  text.push_back("  " + padded("", width) + " +" + std::string(columns.size(), '-'));
  const std::size_t used = left.size() + right.size();
  const std::size_t gap = columns.size() > used + 2 ? columns.size() - used : 2;
  text.push_back("  " + padded("", width) + "  " + left + std::string(gap, ' ') + right + "  " + first);
  return text;
}

}  // namespace eigentrail::app
