#include <cstdio>
#include <filesystem>

#include "commands.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/report/report.hpp"
#include "output_choice.hpp"

namespace eigentrail::app {
namespace {

struct ReportArguments {
  std::vector<std::string> files;
  OutputChoice output;
};

/// A page is HTML whatever its name: "-o page.png" is a mistake.
void check_ending(const std::string& output) {
  const std::string ending = extension_of(output);
  if (ending.empty() || ending == ".html" || ending == ".htm") return;
  throw InputError(output + ": a report is a page in HTML; give a name that ends in .html, found '" + ending +
                   "'");
}

int run_report(ReportArguments& arguments) {
  OutputChoice& output = arguments.output;
  output.name_like(arguments.files.front(), ".html");
  check_new_output(output.path, output.force, {"report of eigentrail", [](const std::string& path) {
                                                 return begins_with(path, report_signature);
                                               }});
  check_ending(output.path);
  write_durably(output.path, {report_page(arguments.files)}, output.existing());
  if (!output.quiet) {
    std::printf("wrote %s (%.1f MB); open it in a browser\n", output.path.c_str(),
                1e-6 * static_cast<double>(std::filesystem::file_size(output.path)));
  }
  return done;
}

}  // namespace

void add_report(CLI::App& program, int& exit_code) {
  const auto [command, arguments] = add_command<ReportArguments>(
      program, exit_code, run_report, "report",
      "one HTML page: Campbell diagram, root locus, events, mode shapes; no network needed");
  command
      ->add_option("FILE", arguments->files,
                   "loci files, boundaries, maps or accuracy studies; several are shown together")
      ->required();
  add_output(*command, arguments->output, "page to write (HTML); default: the name of the first file, here");
  add_output_flags(*command, arguments->output, {"replace an existing page", "", "say nothing"});
  command->footer(
      "Examples:\n  eigentrail report blade.h5 -o blade.html\n"
      "  eigentrail report blade.h5 blade_drag_20.h5 flutter.h5 -o compare.html");
}

}  // namespace eigentrail::app
