// Table of the stations of a beam in a file.
#pragma once

#include <map>

#include "model/draft.hpp"

namespace eigentrail {

/// Columns of the CSV file that the key `file` names, in SI units, by the keys in its first line. A unit may
/// follow a key in brackets. Lines that begin with # are left out. `fields` are the keys that are known, with
/// their units.
std::map<std::string, std::vector<double>> read_station_file(const Scene& scene, TableReader& table,
                                                             const std::vector<FieldHelp>& fields);

}  // namespace eigentrail
