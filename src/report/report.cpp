#include "eigentrail/report/report.hpp"

#include <stdexcept>
#include <string_view>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/version.hpp"
#include "report/file_data.hpp"

// The page with its scripts and styles but without data (page.S.in).
extern "C" const char eigentrail_report_page[];      // NOLINT: named by the assembler
extern "C" const char eigentrail_report_page_end[];  // NOLINT

namespace eigentrail {
namespace {

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
