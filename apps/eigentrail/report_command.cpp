#include <cctype>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "check_output.hpp"
#include "commands.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/report/report.hpp"
#include "eigentrail/store/output_file.hpp"
#include "scene_arguments.hpp"

namespace eigentrail::app {
namespace {

struct ReportArguments {
  std::vector<std::string> files;
  std::string output;
  bool force = false;
  bool quiet = false;
};

/// A page is HTML whatever its name: "-o page.png" is a mistake.
void check_ending(const std::string& output) {
  std::string ending = std::filesystem::path(output).extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (ending.empty() || ending == ".html" || ending == ".htm") return;
  throw InputError(output + ": a report is a page in HTML; give a name that ends in .html, found '" + ending +
                   "'");
}

int run_report(const ReportArguments& arguments) {
  check_output(arguments.output, arguments.force, OtherOutput{is_report, "report of eigentrail"});
  check_ending(arguments.output);
  check_can_create(arguments.output);
  write_durably(arguments.output, {report_page(arguments.files)}, existing(arguments.force));
  if (!arguments.quiet) {
    std::printf("wrote %s (%.1f MB); open it in a browser\n", arguments.output.c_str(),
                1e-6 * static_cast<double>(std::filesystem::file_size(arguments.output)));
  }
  return done;
}

}  // namespace

void add_report(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<ReportArguments>();
  CLI::App* command = program.add_subcommand(
      "report", "one HTML page: Campbell diagram, root locus, events, mode shapes; no network needed");
  command
      ->add_option("FILE", arguments->files,
                   "loci files, boundaries, maps or accuracy studies; several are shown together")
      ->required();
  auto* output = command->add_option("-o,--output", arguments->output,
                                     "page to write (HTML); default: the name of the first file, here");
  command->add_flag("--force", arguments->force, "replace an existing page");
  command->add_flag("-q,--quiet", arguments->quiet, "say nothing");
  command->footer(
      "Examples:\n  eigentrail report blade.h5 -o blade.html\n"
      "  eigentrail report blade.h5 blade_drag_20.h5 flutter.h5 -o compare.html");
  command->callback([arguments, output, &exit_code] {
    if (output->count() == 0) arguments->output = beside(arguments->files.front(), ".html");
    exit_code = run_report(*arguments);
  });
}

}  // namespace eigentrail::app
