#include "continuation/trace/mode_choice_option.hpp"

#include <cmath>

#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/units.hpp"

namespace eigentrail {
namespace {

/// Frequencies in rad/s, at least 0.
std::vector<double> frequencies(TableReader& table, const std::string& key) {
  std::vector<double> values;
  for (const std::string& text : table.texts(key)) {
    const auto value = angular_frequency(text);
    if (!value || *value < 0.0)
      table.fail(
          key, "expected a frequency such as \"3 Hz\", \"200 rpm\" or 18.8 (rad/s), found \"" + text + "\"");
    values.push_back(*value);
  }
  return values;
}

}  // namespace

double constant_number(TableReader& table, const std::string& key) {
  const Expression expression = table.expression(key);
  if (!expression.is_constant()) table.fail(key, "expected a number without parameters");
  return expression.evaluate(std::span<const double>());
}

ModeChoice read_mode_choice(TableReader table) {
  ModeChoice choice;
  if (table.has("count")) {
    const double count = constant_number(table, "count");
    if (!(count >= 1.0 && count <= 1e9 && count == std::floor(count)))
      table.fail("count", "expected a whole number of at least 1, found " + exact_text(count));
    choice.count = static_cast<int>(count);
  }
  if (table.has("band")) {
    const std::vector<double> ends = frequencies(table, "band");
    if (ends.size() != 2 || !(ends[0] < ends[1]))
      table.fail("band", "expected two frequencies, the lower one first: [\"0.05 Hz\", \"3 Hz\"]");
    choice.band = FrequencyBand{ends[0], ends[1]};
  }
  if (table.has("damping_below")) {
    choice.damping_below = constant_number(table, "damping_below");
    if (!(*choice.damping_below > -1.0 && *choice.damping_below <= 1.0))
      table.fail("damping_below",
                 "must lie above -1, and be 1 at most; found " + exact_text(*choice.damping_below));
  }
  if (table.has("near")) {
    const std::vector<double> place = frequencies(table, "near");
    if (place.size() != 1) table.fail("near", "expected one frequency");
    choice.near = place.front();
    if (!choice.count && !choice.band)
      table.fail("near", "says where to look; say also how many modes are wanted: count = 6");
  }
  table.finish();
  return choice;
}

}  // namespace eigentrail
