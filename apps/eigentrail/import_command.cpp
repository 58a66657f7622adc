#include <cctype>
#include <cstdio>
#include <filesystem>
#include <map>

#include "commands.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/import/importer.hpp"
#include "scene_arguments.hpp"

namespace eigentrail::app {
namespace {

struct ImportArguments {
  std::vector<std::string> files;
  std::string folder;
  std::string name;
  bool force = false;
  std::map<std::string, std::string> options;
};

/// A title as the name of a file: other characters than letters, digits, points and dashes become
/// underscores.
std::string file_name(std::string title) {
  for (char& c : title) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.' && c != '-') c = '_';
  }
  return title.empty() || title.front() == '.' ? "model" : title;
}

int run_import(const Importer& format, const ImportArguments& arguments) {
  const Imported imported = format.read({arguments.files, arguments.options});
  if (std::filesystem::path(arguments.name).filename() != arguments.name || arguments.name == "..")
    throw InputError("--name " + arguments.name + ": expected a name without folders; -o names the folder");
  std::string name = arguments.name.empty() ? common_name(arguments.files) : arguments.name;
  if (name.empty()) name = file_name(imported.title);
  const std::string scene = write_import(imported, arguments.folder, name, arguments.force);
  for (const std::string& line : imported.understood) std::printf("  %s\n", printable(line).c_str());
  for (const std::string& line : imported.warnings) std::printf("  warning  %s\n", printable(line).c_str());
  const char* next = imported.one_point() ? "spectrum" : "trace";
  std::printf("wrote %s and its %s; next: eigentrail %s %s%s\n", scene.c_str(),
              imported.stations ? "stations" : "matrices", next, scene.c_str(),
              imported.one_point() ? "" : " -o loci.h5");
  return done;
}

}  // namespace

void add_import(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("import", "make a scene from the files of another program");
  command->require_subcommand(1);
  command->footer(
      "Examples:\n"
      "  eigentrail import openfast ws*.lin -o turbine\n"
      "  eigentrail import numpy turbine.npz -o turbine\n"
      "  eigentrail import matrix-market M0.mtx K0.mtx K2.mtx -o rotor --parameter speed --to 100\n"
      "  eigentrail import nastran 0.pch 100.pch 200.pch -o shaft --parameter speed --values 0,100,200");
  for (const Importer& format : importers()) {
    const auto run = [&format](const ImportArguments& given) { return run_import(format, given); };
    const auto [one, arguments] =
        add_command<ImportArguments>(*command, exit_code, run, format.format, format.description);
    one->add_option("FILES", arguments->files, "files to read")->required();
    one->add_option("-o,--output", arguments->folder, "folder for the scene and its matrices")->required();
    one->add_option("--name", arguments->name, "name of the two files; default: that of the files");
    one->add_flag("--force", arguments->force, "replace existing files");
    for (const auto& [name, help] : format.options)
      add_text(*one, "--" + name, arguments->options, name, help);
    std::string reads = "Reads:\n";
    for (const ImportedItem& item : format.reads) reads += "  " + item.item + ": " + item.becomes + "\n";
    one->footer(reads);
  }
}

}  // namespace eigentrail::app
