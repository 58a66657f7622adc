#include "import/file_table.hpp"

#include <algorithm>
#include <filesystem>

#include "core/texts.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/limits.hpp"
#include "import/text_lines.hpp"

namespace eigentrail {
namespace {

constexpr std::size_t most_columns = 20;

class TableOfFiles {
 public:
  TableOfFiles(std::string_view text, const std::string& path) : lines_(text, path) { table_.path = path; }

  FileTable read() {
    while (const auto line = lines_.next()) {
      const std::string_view row = trimmed(*line);
      if (row.empty() || row.front() == '#') continue;
      const std::vector<std::string> cells = cells_of(row);
      if (table_.columns.empty()) {
        read_titles(cells);
      } else {
        read_row(cells);
      }
    }
    if (table_.columns.empty())
      lines_.fail("no table: expected titles such as 'parameter, M, K' and a row of files for each value");
    if (table_.values.empty()) lines_.fail("the table has no rows");
    return std::move(table_);
  }

 private:
  std::vector<std::string> cells_of(std::string_view row) {
    std::vector<std::string> cells;
    for (const std::string& part : split(std::string(row), ',')) {
      std::string_view cell = trimmed(part);
      if (cell.size() > 1 && cell.front() == '"' && cell.back() == '"')
        cell = cell.substr(1, cell.size() - 2);
      if (cells.size() > most_columns) lines_.fail("more than " + std::to_string(most_columns) + " columns");
      cells.emplace_back(cell);
    }
    return cells;
  }

  void read_titles(const std::vector<std::string>& cells) {
    if (cells.size() < 2)
      lines_.fail("expected titles separated by commas, such as 'parameter, M, K'; found " + shown(cells[0]));
    std::string_view first = cells[0];
    const std::size_t bracket = first.find('[');
    if (bracket != std::string_view::npos && first.back() == ']') {
      table_.unit = trimmed(first.substr(bracket + 1, first.size() - bracket - 2));
      first = trimmed(first.substr(0, bracket));
    }
    if (!is_identifier(first) || first.size() > limits::key_length)
      lines_.fail("'" + printable(std::string(first.substr(0, 40))) +
                  "': expected the name of the parameter: a letter, then letters, digits and underscores");
    table_.parameter = first;
    table_.columns.assign(cells.begin() + 1, cells.end());
  }

  void read_row(const std::vector<std::string>& cells) {
    if (cells.size() != table_.columns.size() + 1)
      lines_.fail("the row has " + std::to_string(cells.size()) + " cells; expected " +
                  std::to_string(table_.columns.size() + 1));
    const double value = lines_.number(cells[0], "expected a value of " + table_.parameter);
    if (std::find(table_.values.begin(), table_.values.end(), value) != table_.values.end())
      lines_.fail("the value " + exact_text(value) + " of " + table_.parameter + " is there already");
    if (table_.values.size() == limits::samples)
      lines_.fail("more than " + std::to_string(limits::samples) + " rows");
    std::vector<std::string> files;
    for (std::size_t i = 1; i < cells.size(); ++i) {
      if (cells[i].empty()) lines_.fail("no file for " + printable(table_.columns[i - 1]));
      files.push_back((std::filesystem::path(table_.path).parent_path() / cells[i]).string());
    }
    table_.values.push_back(value);
    table_.files.push_back(std::move(files));
  }

  TextLines lines_;
  FileTable table_;
};

}  // namespace

FileTable parse_file_table(std::string_view text, const std::string& path) {
  return TableOfFiles(text, path).read();
}

bool is_file_table(const std::string& path) {
  return equal_words(std::filesystem::path(path).extension().string(), ".csv");
}

}  // namespace eigentrail
