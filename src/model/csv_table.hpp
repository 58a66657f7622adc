// Tables of numbers in text files: a line of headings, then lines of numbers, separated by commas, semicolons
// or tabs. Lines that begin with # and empty lines do not count.
#pragma once

#include <string>
#include <vector>

#include "model/beside_scene.hpp"

namespace eigentrail {

/// A column; "outer [mm]" is the heading of the column "outer" in the unit mm.
struct CsvColumn {
  std::string name;
  std::string unit;            ///< empty: none given
  std::vector<double> values;  ///< as in the file
};

struct CsvTable {
  std::string path;
  std::vector<CsvColumn> columns;
  std::vector<int> lines;  ///< number of the line of each row, from 1

  std::size_t rows() const { return lines.size(); }
  const CsvColumn* find(const std::string& name) const;
};

/// Reads such a file. Throws InputError with path and line.
CsvTable read_csv(const std::string& path);

/// What `read` makes of the file that a key of a scene's table names. InputErrors get the place in the scene.
auto read_csv(const Scene& scene, TableReader& table, const std::string& key, auto read) {
  const std::string path = beside_scene(scene, table, key);
  try {
    return read(read_csv(path));
  } catch (const InputError& error) {
    table.fail(key, error.what());
  }
}

/// Factor of the values of a column to the SI unit of a quantity in `wanted`; empty: of any quantity. Throws
/// InputError as si_values.
double si_factor(const CsvTable& table, const CsvColumn& column, WantedUnit wanted);

/// Values of a column in the SI unit of a quantity in `wanted`. Throws InputError if the column has another
/// dimension or a unit that is not known.
std::vector<double> si_values(const CsvTable& table, const CsvColumn& column, const std::string& wanted);

}  // namespace eigentrail
