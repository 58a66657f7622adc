#include "samples_info.hpp"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/texts.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "import/samples.hpp"
#include "output.hpp"
#include "records.hpp"

namespace eigentrail::app {
namespace {

/// "angle (rad), rate (rad/s)", the first few.
std::string states_in(const SampledData& data) {
  constexpr std::size_t most = 12;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, data.state_names.size()); ++i) {
    const bool unit =
        i < data.state_units.size() && !data.state_units[i].empty() && data.state_units[i] != "1";
    text += (i == 0 ? "" : ", ") + data.state_names[i] + (unit ? " (" + data.state_units[i] + ")" : "");
  }
  if (data.state_names.size() > most)
    text += " and " + std::to_string(data.state_names.size() - most) + " more";
  return text;
}

std::string digits_in(const SampledData& data) {
  const std::string digits =
      data.digits ? std::to_string(*data.digits) + " significant" : std::string("not stated: exact");
  return data.A_error.empty() ? digits : "bounds of the errors of A are given; others " + digits;
}

void print_json(const std::string& path, const SampledData& data) {
  nlohmann::ordered_json info;
  info["file"] = path;
  info["holds"] = "samples";
  info["parameter"] =
      data.parameter_name.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(data.parameter_name);
  info["unit"] = data.parameter_unit;
  info["values"] = data.values;
  info["matrices"] = matrices_in(data);
  info["states"] = data.size();
  info["state_names"] = data.state_names;
  info["state_units"] = data.state_units;
  info["digits"] = data.digits ? nlohmann::ordered_json(*data.digits) : nlohmann::ordered_json();
  info["source"] = data.source;
  print_text_of(info);
}

}  // namespace

SampledData samples_in(const std::string& path) {
  try {
    return read_samples(path);
  } catch (const std::exception& error) {
    const std::string message = error.what();
    throw InputError(message.find(path) != std::string::npos ? message : path + ": " + message);
  }
}

void print_samples(const std::string& path, bool json) {
  const SampledData data = samples_in(path);
  if (json) return print_json(path, data);
  const std::string size = std::to_string(data.size()) + " x " + std::to_string(data.size());
  const std::string unit =
      data.parameter_unit.empty() || data.parameter_unit == "1" ? "" : " " + data.parameter_unit;
  const std::string name = data.parameter_name.empty() ? "the parameter" : data.parameter_name;
  constexpr std::size_t most = 30;
  std::string values =
      joined(first_items(data.values, most), ", ", [](double value) { return rounded(value, 8); });
  if (data.count() > most)
    values += " and " + std::to_string(data.count() - most) + " more up to " + rounded(data.values.back(), 8);
  std::vector<std::vector<std::string>> rows{
      {"samples", std::to_string(data.count()) + " of " + matrices_in(data) + ", " + size},
      {printable(name), values + printable(unit)},
      {"states", data.state_names.empty() ? "without names" : printable(states_in(data))},
      {"digits", digits_in(data)}};
  if (!data.source.empty()) rows.push_back({"source", printable(data.source)});
  print_table(rows);
  std::printf("  next: a scene with [sampled_family] that names this file, then eigentrail %s\n",
              data.count() == 1 ? "spectrum" : "trace");
}

}  // namespace eigentrail::app
