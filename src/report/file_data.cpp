#include "report/file_data.hpp"

#include <filesystem>
#include <tuple>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/store/accuracy_writer.hpp"
#include "eigentrail/store/boundary_writer.hpp"
#include "eigentrail/store/loci_file.hpp"
#include "eigentrail/store/loci_writer.hpp"
#include "eigentrail/store/map_writer.hpp"
#include "store/provenance.hpp"

namespace eigentrail {
namespace {

std::string text_of(const Hdf5File& file, const std::string& name) {
  return file.has_attribute(name) ? file.text_attribute(name) : "";
}

Json data_of_kind(const Hdf5File& file, const std::string& path, const ReportBudget& budget) {
  const std::string format = text_of(file, "format");
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

Json attributes_data(const Hdf5File& file) {
  std::map<std::string, std::string> attributes = file.attribute_texts();
  attributes.erase("scene");
  attributes.erase("title");
  return attributes;
}

Json file_data(const std::string& path, const ReportBudget& budget) {
  require_result_file(path);
  const Hdf5File file = Hdf5File::open(path);
  Json data = data_of_kind(file, path, budget);
  data["name"] = std::filesystem::path(path).filename().string();
  data["title"] = text_of(file, "title");
  data["scene"] = text_of(file, "scene");
  data["attributes"] = attributes_data(file);
  return data;
}

}  // namespace eigentrail
