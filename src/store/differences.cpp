#include "store/differences.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
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

void require_same_run(const std::string& path, const Settings& before, const Settings& now) {
  const std::map<std::string, std::string> old(before.begin(), before.end()), given(now.begin(), now.end());
  const auto of = [](const auto& settings, const std::string& label) {
    const auto found = settings.find(label);
    return found == settings.end() ? std::string() : found->second;
  };
  const auto changed = [&](const std::string& label) { return of(old, label) != of(given, label); };
  const std::string refused = path + ": cannot be resumed: ", anew = "begin anew with --force",
                    restore = "; restore it, or " + anew;
  if (changed("version"))
    throw InputError(refused + "it was written by eigentrail " + printable(of(old, "version")) +
                     ", this is " + of(given, "version") + "; " + anew);
  if (changed("scene"))
    throw InputError(refused + "the scene has changed since: " +
                     first_difference(of(old, "scene"), of(given, "scene")) + restore);
  if (changed("files of the scene"))
    throw InputError(refused + "the files that the scene names have changed since" + restore);
  std::set<std::string> labels;
  for (const auto& [label, text] : before) labels.insert(label);
  for (const auto& [label, text] : now) labels.insert(label);
  std::string options;
  for (const std::string& label : labels) {
    if (changed(label))
      options += (options.empty() ? "" : ", ") + label + " was " + printable(of(old, label)) + " and is " +
                 printable(of(given, label));
  }
  if (!options.empty()) throw InputError(refused + "other options: " + options + restore);
}

std::string bytes_of_file(const std::string& path) {
  require_plain_file(path);
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file && !file.eof()) throw InputError(path + ": cannot be read");
  return bytes;
}

}  // namespace eigentrail
