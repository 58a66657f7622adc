#include "import/samples.hpp"

#include <cmath>
#include <stdexcept>

#include "core/texts.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/limits.hpp"
#include "import/digits.hpp"
#include "import/text_lines.hpp"

namespace eigentrail {

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
