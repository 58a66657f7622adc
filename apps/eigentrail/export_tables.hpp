// The content of a loci file as tables, for CSV and JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eigentrail/store/loci_file.hpp"
#include "records.hpp"

namespace eigentrail::app {

struct ExportTable : Records {
  ExportTable(std::string of_file, std::vector<std::string> names)
      : Records{std::move(names), {}, ""}, name(std::move(of_file)) {}

  std::string name;  ///< of the file, without ending
};

/// Every mode that exists at every place: number of the place along the output, parameter, mode, name, real
/// and imaginary part (1/s), natural and damped frequency (rad/s), damping ratio, logarithmic decrement,
/// certified, and errors of the data where the file has them. The places are the stored points, or `points`
/// equidistant values of the parameter, at which the dense output is evaluated; where the path turns back,
/// every passage of a value is a place.
ExportTable loci_table(const LociFile& loci, std::optional<int> points);

/// All events with their sensitivities (real and imaginary part) and shifts, per parameter of the scene.
ExportTable events_table(const LociFile& loci);

/// Stable ranges with their ends; without rows if the file has none.
ExportTable ranges_table(const LociFile& loci);

/// Mode shapes at the stored points: a row per coordinate.
ExportTable shapes_table(const LociFile& loci);

}  // namespace eigentrail::app
