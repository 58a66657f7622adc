// Models of other programs: each importer reads the files of one format into samples of matrices, or into the
// coefficients of a polynomial family.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "eigentrail/core/system_matrix.hpp"
#include "eigentrail/model/sampled_data.hpp"

namespace eigentrail {

struct ImportRequest {
  std::vector<std::string> files;  ///< paths as the user gave them
  /// Options of the format, such as "parameter"; without an entry the importer chooses.
  std::map<std::string, std::string> options;

  /// An option; `otherwise` if it was not given.
  std::string option(const std::string& name, const std::string& otherwise = "") const {
    const auto given = options.find(name);
    return given == options.end() ? otherwise : given->second;
  }
};

/// Matrices that are polynomials of the parameter: M = M[0] + M[1] p + M[2] p^2 + ... Coefficients without
/// entries are zero. The equations are those of [matrix_family]: E x' = A x, or M x'' + C x' + K x = 0 with
/// constraints A x = 0. Sparse coefficients are written as such.
struct PolynomialData {
  std::vector<SystemMatrix> M, C, K, E, A;
  std::vector<std::string> state_names;  ///< n, or empty
  std::string parameter_unit;            ///< empty: none, or not known
  double from = 0.0, to = 1.0;           ///< range of the parameter
};

/// Names of the matrices, and their coefficients.
inline constexpr std::pair<const char*, std::vector<SystemMatrix> PolynomialData::*> polynomial_matrices[] = {
    {"M", &PolynomialData::M},
    {"C", &PolynomialData::C},
    {"K", &PolynomialData::K},
    {"E", &PolynomialData::E},
    {"A", &PolynomialData::A}};

/// A blade: a scene with a table of stations beside it.
struct StationData {
  std::string tables;  ///< of the scene; its last line belongs to the table that names the file of stations
  std::string csv;     ///< the stations
};

/// What an importer has read: samples or, if there is one, a polynomial family or a table of stations.
struct Imported {
  std::string title;
  std::string parameter;  ///< name of the parameter, an identifier
  SampledData samples;
  std::optional<PolynomialData> family = {};
  std::optional<StationData> stations = {};
  std::vector<std::string> understood;  ///< sentences for the user: what was found and what was done with it
  std::vector<std::string> warnings;    ///< sentences for the user: what is doubtful

  /// Whether there is one operating point only, and no range to trace.
  bool one_point() const { return !family && !stations && samples.count() == 1; }
};

/// One thing in the files of a format, and what becomes of it. For help and documentation.
struct ImportedItem {
  std::string item;
  std::string becomes;
};

/// A format. `read` throws InputError for files that cannot be used; the message names file, place and
/// remedy.
struct Importer {
  std::string format;       ///< as on the command line: "openfast"
  std::string description;  ///< one line
  std::vector<ImportedItem> reads;
  std::map<std::string, std::string> options;  ///< name and help of each option
  Imported (*read)(const ImportRequest& request);
};

/// All formats, in the order of the documentation.
const std::vector<Importer>& importers();

/// The importer of a format; throws InputError that names the known ones.
const Importer& importer(const std::string& format);

/// What the names of files begin with, up to a separator or a number: "ws03.0" for ws03.0.1.lin and
/// ws03.0.13.lin, "ws" for ws00.0.1.lin and ws03.0.1.lin; empty if they have nothing in common. At least one
/// file.
std::string common_name(const std::vector<std::string>& files);

/// Writes `name`.toml and `name`.h5, or `name`.csv with stations, to `folder`, which is made if it does not
/// exist. Existing files are replaced only if `force` is set. Returns the path of the scene. Throws
/// InputError or std::runtime_error.
std::string write_import(const Imported& imported, const std::string& folder, const std::string& name,
                         bool force);

}  // namespace eigentrail
