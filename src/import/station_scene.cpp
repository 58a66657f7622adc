#include "import/station_scene.hpp"

#include <cmath>
#include <filesystem>
#include <numbers>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "import/text_lines.hpp"

namespace eigentrail {

std::string tables_of(const BladeScene& scene) {
  std::string text = "[parameters]\nrotor_speed = { value = 0, unit = \"rpm\" }\n\n";
  text += "[trace]\nparameter = \"rotor_speed\"\nfrom = 0\nto = " + exact_text(scene.largest_speed);
  text += "\ntolerance = 1e-6\nmodes = 5\n\n";
  text += "[frame]                    # turns with the rotor\nangular_velocity = [0, 0, \"rotor_speed\"]\n\n";
  text += scene.other_tables;
  text += "[[blade]]\nname = \"blade\"\nhub_radius = " + exact_text(scene.hub_radius);
  text += "\nlength = " + exact_text(scene.length) + "\n";
  if (scene.precone != 0.0) text += "precone = \"" + exact_text(scene.precone) + "*pi/180\"\n";
  return text + "elements = 12\n" + scene.blade_keys;
}

std::string csv_of(const std::vector<std::pair<std::string, std::vector<double>>>& columns) {
  std::string text;
  for (const auto& [heading, values] : columns) text += (text.empty() ? "" : ", ") + heading;
  text += "\n";
  for (std::size_t i = 0; i < columns.front().second.size(); ++i) {
    for (std::size_t k = 0; k < columns.size(); ++k)
      text += (k == 0 ? "" : ", ") + exact_text(columns[k].second[i]);
    text += "\n";
  }
  return text;
}

double usual_speed(double tip_radius) {
  constexpr double tip_speed = 80.0;  // m/s
  return std::max(0.1, std::round(10.0 * tip_speed / tip_radius * 30.0 / std::numbers::pi) / 10.0);
}

double number_option(const ImportRequest& request, const std::string& name, double otherwise) {
  const auto given = request.options.find(name);
  if (given == request.options.end()) return otherwise;
  const auto value = number_of(given->second);
  if (!value || !std::isfinite(*value) || *value < 0.0)
    throw InputError("--" + name + ": expected a number that is not negative, found '" +
                     printable(given->second) + "'");
  return *value;
}

std::string beside(const std::string& path, const std::string& named) {
  std::string plain = named;
  for (char& c : plain) c = c == '\\' ? '/' : c;
  return (std::filesystem::path(path).parent_path() / plain).string();
}

}  // namespace eigentrail
