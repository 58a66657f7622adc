#include "report/file_data.hpp"

#include <filesystem>
#include <tuple>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/store/accuracy_writer.hpp"
#include "eigentrail/store/boundary_writer.hpp"
#include "eigentrail/store/loci_file.hpp"
#include "eigentrail/store/loci_writer.hpp"
#include "eigentrail/store/map_writer.hpp"
#include "store/provenance.hpp"

namespace eigentrail {
namespace {

Json data_of_kind(const Hdf5File& file, const std::string& path, const ReportBudget& budget) {
  const std::string format = file.has_attribute("format") ? file.text_attribute("format") : "";
  if (format == loci_format) return loci_data(read_loci(path), file, budget);
  for (const auto& [other, schema, data] :
       {std::tuple(boundary_format, boundary_schema_version, &boundary_data),
        std::tuple(map_format, map_schema_version, &map_data),
        std::tuple(accuracy_format, accuracy_schema_version, &accuracy_data)}) {
    if (format != other) continue;
    check_schema(file, path, schema);
    return data(file);
  }
  throw InputError(path + ": is an HDF5 file, but none of eigentrail" +
                   (format.empty() ? "" : " (its format is '" + format + "')"));
}

}  // namespace

Json file_data(const std::string& path, const ReportBudget& budget) {
  require_result_file(path);
  const Hdf5File file = Hdf5File::open(path);
  Json data = data_of_kind(file, path, budget);
  data["name"] = std::filesystem::path(path).filename().string();
  std::map<std::string, std::string> attributes = file.attribute_texts();  // in alphabetical order
  for (const char* apart : {"title", "scene"}) {
    data[apart] = attributes[apart];
    attributes.erase(apart);
  }
  data["attributes"] = attributes;
  return data;
}

}  // namespace eigentrail
