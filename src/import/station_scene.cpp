#include "import/station_scene.hpp"

#include <cmath>
#include <filesystem>
#include <numbers>

#include "core/texts.hpp"
#include "eigentrail/core/text.hpp"
#include "import/samples.hpp"

namespace eigentrail {

namespace {

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

}  // namespace

Imported blade_import(const std::string& title, const BladeScene& scene, const std::string& csv) {
  Imported result;
  result.title = title;
  result.parameter = "rotor_speed";
  result.stations = {tables_of(scene), csv};
  return result;
}

double speed_option(const ImportRequest& request, double usual) {
  const double speed = number_option(request, "speed", usual, false);
  if (!(speed > 0.0)) throw InputError("--speed: expected a positive number");
  return speed;
}

std::string csv_of(const std::vector<std::pair<std::string, std::vector<double>>>& columns) {
  using Column = std::pair<std::string, std::vector<double>>;
  std::string text = joined(columns, ", ", &Column::first) + "\n";
  for (std::size_t i = 0; i < columns.front().second.size(); ++i)
    text += joined(columns, ", ", [i](const Column& one) { return exact_text(one.second[i]); }) + "\n";
  return text;
}

double usual_speed(double tip_radius) {
  constexpr double tip_speed = 80.0;  // m/s
  return std::max(0.1, std::round(10.0 * tip_speed / tip_radius * 30.0 / std::numbers::pi) / 10.0);
}

std::string beside(const std::string& path, const std::string& named) {
  std::string plain = named;
  for (char& c : plain) c = c == '\\' ? '/' : c;
  return (std::filesystem::path(path).parent_path() / plain).string();
}

}  // namespace eigentrail
