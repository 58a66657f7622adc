#include "eigentrail/core/errors.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>

#include "core/texts.hpp"

namespace eigentrail {
namespace {

constexpr std::size_t longest_misprint = 200;  ///< characters; longer names get no suggestion
constexpr std::size_t most_listed = 100;       ///< largest number of names in a message

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      const std::size_t replace = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({above + 1, row[j - 1] + 1, replace});
      diagonal = above;
    }
  }
  return row[b.size()];
}

/// Whether a candidate may be meant by a misspelt name. If the edit distance equals the length, no character
/// is kept; the candidate is then meant only if it differs in case alone.
bool resembles(std::string_view name, std::string_view candidate, std::size_t distance) {
  return distance < std::max(name.size(), candidate.size()) || equal_words(name, candidate);
}

}  // namespace

std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates) {
  const std::size_t limit = std::max<std::size_t>(1, std::min<std::size_t>(3, (name.size() + 1) / 2));
  std::size_t best = limit + 1;
  std::string nearest;
  for (const std::string& candidate : candidates) {
    // The difference of the lengths is a lower bound of the distance. Comparing texts of thousands of
    // characters would take seconds.
    if (std::max(candidate.size(), name.size()) - std::min(candidate.size(), name.size()) > limit) continue;
    if (name.size() > longest_misprint) continue;
    const std::size_t distance = edit_distance(name, candidate);
    if (distance < best && resembles(name, candidate, distance)) {
      best = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

bool is_misprint(std::string_view name, std::string_view known) {
  constexpr std::size_t shortest = 4;
  if (name == known || std::min(name.size(), known.size()) < shortest) return false;
  if (equal_words(name, known)) return true;
  const auto first = static_cast<std::size_t>(
      std::mismatch(name.begin(), name.end(), known.begin(), known.end()).first - name.begin());
  if (name.size() == known.size()) {
    const bool swapped = first + 1 < name.size() && name[first] == known[first + 1] &&
                         name[first + 1] == known[first] && name.substr(first + 2) == known.substr(first + 2);
    return swapped && std::isalpha(static_cast<unsigned char>(name[first])) != 0 &&
           std::isalpha(static_cast<unsigned char>(name[first + 1])) != 0;
  }
  const std::string_view longer = name.size() > known.size() ? name : known;
  const std::string_view shorter = name.size() > known.size() ? known : name;
  return longer.size() == shorter.size() + 1 && longer.substr(first + 1) == shorter.substr(first) &&
         std::isalpha(static_cast<unsigned char>(longer[first])) != 0;
}

std::string suggestion(std::string_view name, const std::vector<std::string>& candidates) {
  if (const std::string nearest = nearest_name(name, candidates); !nearest.empty()) {
    return "did you mean '" + nearest + "'?";
  }
  if (candidates.empty()) return "none is known here";
  const std::string list = "known: " + joined(first_items(candidates, most_listed));
  if (candidates.size() <= most_listed) return list;
  return list + " and " + std::to_string(candidates.size() - most_listed) + " more";
}

}  // namespace eigentrail
