#include "eigentrail/report/report.hpp"

#include <filesystem>
#include <map>
#include <stdexcept>
#include <string_view>
#include <tuple>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/version.hpp"
#include "eigentrail/store/accuracy_writer.hpp"
#include "eigentrail/store/boundary_writer.hpp"
#include "eigentrail/store/loci_writer.hpp"
#include "eigentrail/store/map_writer.hpp"
#include "report/file_data.hpp"
#include "store/provenance.hpp"

// The page with its scripts and styles but without data (page.S.in).
extern "C" const char eigentrail_report_page[];      // NOLINT: named by the assembler
extern "C" const char eigentrail_report_page_end[];  // NOLINT

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

constexpr std::string_view data_mark = "<!-- data -->";

std::string_view page() {
  return {eigentrail_report_page, eigentrail_report_page_end};
}

Json page_data(const std::vector<std::string>& files) {
  ReportBudget budget;
  budget.curves /= files.size();
  budget.shapes /= files.size();
  Json data{{"program_version", version()}, {"files", Json::array()}};
  for (const std::string& file : files) data["files"].push_back(file_data(file, budget));
  return data;
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

std::string report_page(const std::vector<std::string>& files) {
  const std::string data = page_json(page_data(files));
  const std::size_t mark = page().find(data_mark);
  if (mark == std::string_view::npos || !page().starts_with(report_signature))
    throw std::logic_error("report_page: the page in this program is damaged; build it again");
  return std::string(page()).replace(mark, data_mark.size(), data);
}

std::string drawing_data(std::string_view loci_file, std::size_t node) {
  const LociFile loci = read_loci_image("result", loci_file);
  if (node >= loci.n_nodes())
    throw InputError(loci.path + ": holds " + std::to_string(loci.n_nodes()) + " points, found number " +
                     std::to_string(node));
  return page_json({{"excitation", excitation_data(loci)}, {"geometry", geometry_data(loci, {node})}});
}

}  // namespace eigentrail
