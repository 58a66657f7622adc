// A table of files in text form, comma-separated: the first column has the values of the parameter, the
// others name the files of the sample, relative to the table.
//
//   wind_speed [m/s], A, E
//   3.0, A_3.mtx, E.mtx
//   5.0, A_5.mtx, E.mtx
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace eigentrail {

struct FileTable {
  std::string path;
  std::string parameter;                        ///< title of the first column
  std::string unit;                             ///< in brackets behind it; empty: none
  std::vector<std::string> columns;             ///< titles of the others
  std::vector<double> values;                   ///< one per row
  std::vector<std::vector<std::string>> files;  ///< rows x columns, paths
};

/// Reads the text of a table. Throws InputError that names file and line.
FileTable parse_file_table(std::string_view text, const std::string& path);

/// Whether the name of a file ends like that of a table: .csv.
bool is_file_table(const std::string& path);

}  // namespace eigentrail
