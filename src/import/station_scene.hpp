// Scenes with a blade from the files of other programs.
#pragma once

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/import/importer.hpp"
#include "import/blade_files.hpp"
#include "import/text_lines.hpp"

namespace eigentrail {

/// A rotor with one blade in vacuum; angles in degrees.
struct BladeScene {
  double hub_radius = 0.0, length = 0.0;  ///< m
  double precone = 0.0;                   ///< deg, towards the axis of the rotor
  double largest_speed = 0.0;             ///< rpm, of the trace
  std::string blade_keys;                 ///< further lines of [[blade]]
  std::string other_tables;               ///< further tables
};

/// What is imported of a blade: the tables of its scene, the last of which is [[blade]], and the stations as
/// text.
Imported blade_import(const std::string& title, const BladeScene& scene, const std::string& csv);

/// The largest rotor speed of the trace, rpm: the option `speed`, else the usual one. Throws InputError.
double speed_option(const ImportRequest& request, double usual);

/// A file that another one names, in the folder of that one.
std::string beside(const std::string& path, const std::string& named);

/// The main file of `program`, if it is among the files, and its blade file, which the main file may name. A
/// main file has a value called `mark`. Throws InputError.
template <class Main, class Blade>
std::pair<std::optional<Main>, Blade> read_blade_files(
    const std::vector<std::string>& paths, const std::string& program, std::string_view mark,
    Main (*read_main)(std::string_view, const std::string&),
    Blade (*read_blade)(std::string_view, const std::string&)) {
  std::optional<Main> main_file;
  std::optional<Blade> blade;
  for (const std::string& path : paths) {
    const std::string text = read_text_file(path);
    const bool is_main = names_value(text, mark);
    if (is_main && main_file) throw InputError(path + ": a second main file of " + program + "; give one");
    if (!is_main && blade) throw InputError(path + ": a second blade file; give one, of one blade");
    if (is_main)
      main_file = read_main(text, path);
    else
      blade = read_blade(text, path);
  }
  if (blade) return {std::move(main_file), *std::move(blade)};
  if (main_file->blade_file.empty())
    throw InputError(main_file->path + ": names no BldFile(1); give the blade file, too");
  const std::string path = beside(main_file->path, main_file->blade_file);
  return {std::move(main_file), read_blade(read_text_file(path), path)};
}

inline bool has_nonzero(const std::vector<double>& values) {
  return std::ranges::any_of(values, [](double value) { return value != 0.0; });
}

/// A table of stations: headings, then values by column.
std::string csv_of(const std::vector<std::pair<std::string, std::vector<double>>>& columns);

/// The rotor speed at which the tip moves with 80 m/s, as that of many turbines does, in rpm to one decimal.
double usual_speed(double tip_radius);

}  // namespace eigentrail
