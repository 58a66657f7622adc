// Scenes with a blade from the files of other programs.
#pragma once

#include "eigentrail/import/importer.hpp"

namespace eigentrail {

/// A rotor with one blade in vacuum; angles in degrees.
struct BladeScene {
  double hub_radius = 0.0, length = 0.0;  ///< m
  double precone = 0.0;                   ///< deg, towards the axis of the rotor
  double largest_speed = 0.0;             ///< rpm, of the trace
  std::string blade_keys;                 ///< further lines of [[blade]]
  std::string other_tables;               ///< further tables
};

/// Tables of the scene. The last one is [[blade]], to which the file of stations belongs.
std::string tables_of(const BladeScene& scene);

/// A table of stations: headings, then values by column.
std::string csv_of(const std::vector<std::pair<std::string, std::vector<double>>>& columns);

/// The rotor speed at which the tip moves with 80 m/s, as that of many turbines does, in rpm to one decimal.
double usual_speed(double tip_radius);

/// The option as a number; `otherwise` if it is not given. Throws InputError.
double number_option(const ImportRequest& request, const std::string& name, double otherwise);

/// A file that another one names, in the folder of that one.
std::string beside(const std::string& path, const std::string& named);

}  // namespace eigentrail
