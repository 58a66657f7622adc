#include "store/differences.hpp"

#include <array>
#include <map>
#include <sstream>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"

namespace eigentrail {
namespace {

std::string in_quotes(const std::string& text) {
  return "'" + printable(text) + "'";
}

/// "line 3 was 'a' and is 'b'": the first line in which two texts differ. Where one text has ended, its line
/// counts as empty.
std::string first_difference(const std::string& before, const std::string& now) {
  std::istringstream a(before), b(now);
  for (int line = 1;; ++line) {
    std::string line_a, line_b;
    const bool has_a = static_cast<bool>(std::getline(a, line_a));
    const bool has_b = static_cast<bool>(std::getline(b, line_b));
    if (!has_a && !has_b) return "line ends";
    if (line_a != line_b)
      return "line " + std::to_string(line) + " was " + in_quotes(line_a) + " and is " + in_quotes(line_b);
  }
}

}  // namespace

std::string changes(const Settings& before, const Settings& now) {
  std::map<std::string, std::array<std::string, 2>> texts;
  for (const auto& [label, text] : before) texts[label][0] = text;
  for (const auto& [label, text] : now) texts[label][1] = text;
  std::string found;
  for (const auto& [label, both] : texts) {
    const auto& [was, is] = both;
    if (was == is) continue;
    const bool lines = (was + is).find('\n') != std::string::npos;
    found += (found.empty() ? "" : "; ") + label + ": " +
             (lines ? first_difference(was, is) : "was " + in_quotes(was) + " and is " + in_quotes(is));
  }
  return found;
}

void require_same_run(const std::string& path, const Settings& before, const Settings& now) {
  const std::string found = changes(before, now);
  if (!found.empty())
    throw InputError(path + ": cannot be resumed: " + found + "; restore it, or begin anew with --force");
}

}  // namespace eigentrail
