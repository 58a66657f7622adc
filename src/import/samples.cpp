#include "import/samples.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "core/texts.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/limits.hpp"
#include "import/text_lines.hpp"

namespace eigentrail {
namespace {

constexpr int fewest_digits = 3;
constexpr int most_digits = 7;
/// Entries that must need all digits, and their share among those that are not whole numbers: rounded results
/// end in a zero in one of ten, while matrices that somebody typed have all kinds of lengths.
constexpr std::size_t fewest_entries = 20;
constexpr double least_share = 0.6;

/// The fewest digits to which x may have been rounded, those of the shortest text that reads back as x; 0 if
/// it has more than `most_digits`.
int least_digits_of(double x) {
  std::array<char, 32> text{};
  std::to_chars(text.begin(), text.end(), x, std::chars_format::scientific);
  const auto digits = std::count_if(text.begin(), std::find(text.begin(), text.end(), 'e'),
                                    [](char c) { return '0' <= c && c <= '9'; });
  return digits <= most_digits ? static_cast<int>(digits) : 0;
}

/// Empty for all.
std::optional<int> digits_asked_for(const std::string& text) {
  if (text == "all") return std::nullopt;
  const auto digits = whole_number_of(text);
  if (!digits || *digits < 1 || *digits > 17)
    throw InputError("--digits: expected a whole number from 1 to 17, or all; found '" + printable(text) +
                     "'");
  return static_cast<int>(*digits);
}

}  // namespace

std::string parameter_option(const ImportRequest& request, const std::string& otherwise) {
  std::string name = request.option("parameter", otherwise);
  if (!is_identifier(name) || name.size() > limits::key_length)
    throw InputError(
        "--parameter: expected a name, a letter and then letters, digits or underscores; found '" +
        printable(name) + "'");
  return name;
}

double number_option(const ImportRequest& request, const std::string& name, double otherwise, bool negative) {
  const auto given = request.options.find(name);
  if (given == request.options.end()) return otherwise;
  const auto value = number_of(given->second);
  if (!value || !std::isfinite(*value) || (*value < 0.0 && !negative))
    throw InputError("--" + name + ": expected a number" + (negative ? "" : " that is not negative") +
                     ", found '" + printable(given->second) + "'");
  return *value;
}

std::string matrices_in(const SampledData& data) {
  std::vector<std::string> names;
  for (const SampledMatrix& named : sampled_matrices()) {
    if (!(data.*named.samples).empty()) names.emplace_back(named.name);
  }
  return joined(names);
}

std::optional<int> digits_of(const SampledData& data) {
  int digits = 1;
  std::array<std::size_t, most_digits + 1> entries{};
  for (const SampledMatrix& named : sampled_matrices()) {
    for (const Matrix& sample : data.*named.samples) {
      for (const double x : sample.reshaped()) {
        if (x == std::round(x)) continue;
        const int own = least_digits_of(x);
        if (own == 0) return std::nullopt;
        digits = std::max(digits, own);
        ++entries[static_cast<std::size_t>(own)];
      }
    }
  }
  const std::size_t all = std::accumulate(entries.begin(), entries.end(), std::size_t{0});
  const std::size_t full = entries[static_cast<std::size_t>(digits)];
  const bool clear =
      full >= fewest_entries && static_cast<double>(full) >= least_share * static_cast<double>(all);
  return digits >= fewest_digits && clear ? std::optional(digits) : std::nullopt;
}

std::string note_digits(SampledData& data, const std::map<std::string, std::string>& options,
                        std::optional<int> known) {
  const auto asked = options.find("digits");
  const bool is_given = asked != options.end();
  data.digits = is_given ? digits_asked_for(asked->second) : known ? known : digits_of(data);
  if (!data.digits) return "";
  return std::to_string(*data.digits) + " significant digits" +
         (is_given ? "" : ", as most entries show; --digits all if they are exact");
}

std::pair<const std::string, std::string> digits_help() {
  return {"digits", "significant digits of the entries, or all; default: as many as they show"};
}

void finish_samples(Imported& imported, const ImportRequest& request, const std::string& file,
                    std::optional<int> known_digits) {
  SampledData& data = imported.samples;
  const std::string digits = note_digits(data, request.options, known_digits);
  if (!digits.empty()) imported.understood.push_back(digits);
  data.source = imported.title + ", " + std::to_string(data.count()) + " samples";
  require_fit(data, file);
}

void require_fit(const SampledData& data, const std::string& file) {
  try {
    check(data);
  } catch (const std::invalid_argument& error) {
    throw InputError(file + ": " + error.what());
  }
}

}  // namespace eigentrail
