// A measured figure beside its target, and the suite's table.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace eigentrail::test {

struct Target {
  enum class Sense { at_most, at_least } sense = Sense::at_most;
  double limit = 0.0;
};
inline Target at_most(double limit) {
  return {Target::Sense::at_most, limit};
}
inline Target at_least(double limit) {
  return {Target::Sense::at_least, limit};
}

struct Figure {
  std::string quantity;               ///< what was measured, in words
  double value = 0.0;                 ///< a ratio, an exponent or a count
  std::optional<Target> target = {};  ///< none: measured for the record
  std::string detail = {};            ///< what the value was computed from

  bool reached() const;  ///< true without a target
};

/// Markdown: the head of the table, and one line per figure.
void write_table_head(std::ostream& out);
void write_table_lines(const std::string& benchmark, const std::vector<Figure>& figures, std::ostream& out);

}  // namespace eigentrail::test
