#include <cstdio>
#include <map>
#include <memory>

#include "commands.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/import/importer.hpp"

namespace eigentrail::app {
namespace {

struct ImportArguments {
  std::vector<std::string> files;
  std::string folder;
  std::string name;
  bool force = false;
  std::map<std::string, std::string> options;
};

int run_import(const Importer& format, const ImportArguments& arguments) {
  const Imported imported = format.read({arguments.files, arguments.options});
  const std::string name = arguments.name.empty() ? common_name(arguments.files) : arguments.name;
  const std::string scene = write_import(imported, arguments.folder, name, arguments.force);
  for (const std::string& line : imported.understood) std::printf("  %s\n", printable(line).c_str());
  for (const std::string& line : imported.warnings) std::printf("  warning  %s\n", printable(line).c_str());
  const char* next = imported.samples.count() == 1 ? "spectrum" : "trace";
  std::printf("wrote %s and its matrices; next: eigentrail %s %s%s\n", scene.c_str(), next, scene.c_str(),
              imported.samples.count() == 1 ? "" : " -o loci.h5");
  return done;
}

}  // namespace

void add_import(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("import", "make a scene from the files of another program");
  command->require_subcommand(1);
  command->footer(
      "Examples:\n"
      "  eigentrail import openfast ws*.lin -o turbine\n"
      "  eigentrail import numpy turbine.npz -o turbine");
  for (const Importer& format : importers()) {
    auto arguments = std::make_shared<ImportArguments>();
    CLI::App* one = command->add_subcommand(format.format, format.description);
    one->add_option("FILES", arguments->files, "files to read")->required();
    one->add_option("-o,--output", arguments->folder, "folder for the scene and its matrices")->required();
    one->add_option("--name", arguments->name, "name of the two files; default: that of the files");
    one->add_flag("--force", arguments->force, "replace existing files");
    for (const auto& [name, help] : format.options) {
      one->add_option_function<std::string>(
          "--" + name, [arguments, name = name](const std::string& text) { arguments->options[name] = text; },
          help);
    }
    std::string reads = "Reads:\n";
    for (const ImportedItem& item : format.reads) reads += "  " + item.item + ": " + item.becomes + "\n";
    one->footer(reads);
    one->callback([arguments, &format, &exit_code] { exit_code = run_import(format, *arguments); });
  }
}

}  // namespace eigentrail::app
