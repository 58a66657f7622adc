#include "values.hpp"

#include <cmath>
#include <cstdlib>

#include "core/texts.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/measure.hpp"
#include "eigentrail/scene/units.hpp"

namespace eigentrail::app {
namespace {

constexpr double most_values = 1e6;

double in_unit(const Parameter& parameter, const Measure& measure, const std::string& label) {
  const UnitValue found = value_in_unit_of(parameter, measure);
  if (!found.fault.empty()) throw InputError(label + ": " + found.fault);
  return found.value;
}

/// The message about a text that is no number.
InputError no_number(const std::string& option, const std::string& text, const std::string& expected) {
  if (text.empty()) return InputError(option + ": expected a number, found an empty text");
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const bool is_number = end == text.c_str() + text.size();
  if (is_number && !std::isfinite(value))
    return InputError(option + ": is not a finite number; found " + text);
  return InputError(option + ": expected " + expected + ", found \"" + text + "\"");
}

/// The numbers of a list or a range. Those without a unit have that of the last one.
std::vector<double> numbers(const std::vector<std::string>& texts, const Parameter& parameter,
                            const std::string& label) {
  const auto last = texts.empty() ? std::nullopt : parse_measure(texts.back());
  std::vector<double> values;
  for (const std::string& text : texts) {
    auto measure = parse_measure(text);
    if (!measure) throw no_number(label, text, "numbers, such as 40, 10,20 or 0:5:40 (begin:step:end)");
    if (measure->unit.empty() && last) measure->unit = last->unit;
    values.push_back(in_unit(parameter, *measure, label));
  }
  return values;
}

void append_range(std::vector<double>& values, const std::vector<double>& range, const std::string& label) {
  if (range.size() != 3) throw InputError(label + ": expected begin:step:end, three numbers, such as 0:5:40");
  const double begin = range[0], step = range[1], end = range[2];
  // An end that the steps miss by rounding alone belongs to the range.
  constexpr double rounding = 1e-9;
  const double count = std::floor((end - begin) / step + rounding) + 1.0;
  if (!(step != 0.0) || !(count >= 1.0) || !std::isfinite(count))
    throw InputError(label + ": the step " + exact_text(step) + " does not lead from " + exact_text(begin) +
                     " to " + exact_text(end));
  if (count > most_values)
    throw InputError(label + ": has more than " + std::to_string(static_cast<int>(most_values)) + " values");
  for (int i = 0; i < static_cast<int>(count); ++i) values.push_back(begin + i * step);
}

}  // namespace

std::vector<double> read_values(const std::string& option, const std::vector<std::string>& texts,
                                const Parameter& parameter) {
  std::vector<double> values;
  for (const std::string& text : texts) {
    const std::string label = text.empty() ? option : option + " " + text;
    const bool is_range = text.find(':') != std::string::npos;
    const std::vector<double> found = numbers(split(text, is_range ? ':' : ','), parameter, label);
    if (is_range) {
      append_range(values, found, label);
    } else {
      values.insert(values.end(), found.begin(), found.end());
    }
  }
  return values;
}

double read_value(const std::string& option, const std::string& text, const Parameter& parameter) {
  const auto measure = parse_measure(text);
  if (!measure) throw no_number(option, text, "a number, or a number with its unit");
  return in_unit(parameter, *measure, option);
}

Parameter parameter_called(const Scene& scene, const std::string& name) {
  const auto index = scene.parameters.index(name);
  return index ? scene.parameters[static_cast<std::size_t>(*index)] : Parameter{};
}

Parameter parameter_of_file(const std::string& name, const std::string& unit) {
  Parameter parameter;
  parameter.name = name;
  const auto known = parse_unit(unit);
  if (unit.empty() || unit == "1" || !known) return parameter;
  parameter.unit = unit;
  parameter.factor = known->factor;
  parameter.dimension = known->dimension;
  return parameter;
}

}  // namespace eigentrail::app
