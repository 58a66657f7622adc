#include <algorithm>
#include <map>

#include "core/texts.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/import/importer.hpp"
#include "import/formats.hpp"

namespace eigentrail {

const std::vector<Importer>& importers() {
  static const std::vector<Importer> all{openfast_importer(),      elastodyn_importer(), beamdyn_importer(),
                                         matrix_market_importer(), matlab_importer(),    nastran_importer(),
                                         numpy_importer()};
  return all;
}

namespace {

/// What users call the formats: the endings of their files, and programs that write them.
const std::map<std::string, std::string> other_names{
    {"npz", "numpy"},        {"npy", "numpy"},     {"python", "numpy"},      {"mat", "matlab"},
    {"lin", "openfast"},     {"fast", "openfast"}, {"mtx", "matrix-market"}, {"csv", "matrix-market"},
    {"mm", "matrix-market"}, {"op4", "nastran"},   {"pch", "nastran"}};

}  // namespace

const Importer& importer(const std::string& format) {
  std::vector<std::string> known;
  for (const Importer& one : importers()) {
    if (one.format == format) return one;
    known.push_back(one.format);
  }
  std::string ending = lower_case(format);
  ending.erase(0, ending.find_last_of('.') + 1);
  const auto other = other_names.find(ending);
  std::string meant = other == other_names.end() ? nearest_name(ending, known) : other->second;
  if (std::find(known.begin(), known.end(), meant) == known.end()) meant.clear();
  const bool is_file = format.find('.') != std::string::npos;
  const std::string remedy = meant.empty() ? ""
                             : is_file     ? "; for this file: import " + meant + " " + format + " -o FOLDER"
                                           : "; did you mean '" + meant + "'?";
  throw InputError("import: expected a format (" + joined(known) + "), found '" + format + "'" + remedy);
}

}  // namespace eigentrail
