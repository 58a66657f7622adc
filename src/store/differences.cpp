#include "store/differences.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/plain_file.hpp"
#include "eigentrail/core/text.hpp"

namespace eigentrail {
namespace {

std::string in_quotes(const std::string& text) {
  return "'" + printable(text) + "'";
}

}  // namespace

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

std::string bytes_of_file(const std::string& path) {
  require_plain_file(path);
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file && !file.eof()) throw InputError(path + ": cannot be read");
  return bytes;
}

}  // namespace eigentrail
