#include "output_choice.hpp"

#include <filesystem>
#include <fstream>

#include "core/texts.hpp"
#include "eigentrail/core/errors.hpp"

namespace eigentrail::app {

std::string part_ending(const Part& part) {
  return "part-" + std::to_string(part.number) + "-of-" + std::to_string(part.count);
}

void OutputChoice::name_like(const std::string& source, const std::string& ending,
                             const std::string& extension) {
  if (given->count() > 0) return;
  path = std::filesystem::path(source).stem().string() + ending;
  path += part && !extension.empty() ? "." + part_ending(*part) : extension;
}

CLI::Option* add_output(CLI::App& command, OutputChoice& output, const std::string& help) {
  CLI::Option* given = command.add_option("-o,--output", output.path, help);
  output.given = given;
  return given;
}

CLI::Option* add_output_flags(CLI::App& command, OutputChoice& output, const OutputFlags& help) {
  CLI::Option* force = command.add_flag("--force", output.force, help.force);
  if (!help.resume.empty()) command.add_flag("--resume", output.resume, help.resume)->excludes(force);
  return command.add_flag("-q,--quiet", output.quiet, help.quiet);
}

void add_part(CLI::App& command, OutputChoice& output) {
  command.add_option_function<std::string>(
      "--part", [&output](const std::string& text) { output.part = read_part(text); },
      "i/N: compute part i of N only and write it to a file of its own; eigentrail merge joins the parts");
}

std::array<CLI::Option*, 2> add_formats(CLI::App& command, PrintedFormat& format,
                                        const std::string& csv_help) {
  CLI::Option* csv = command.add_flag("--csv", format.csv, csv_help);
  return {csv, command.add_flag("--json", format.json, "print a list of objects")->excludes(csv)};
}

OutputFormat hdf5_format(const std::string& attribute, const std::string& name) {
  return {name, [attribute](const std::string& path) { return may_be_replaced(path, attribute); }};
}

void check_output(const std::string& path, bool force, const OutputFormat& format) {
  if (path.empty()) throw InputError("--output: expected the name of a file");
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw InputError(path + ": is a folder; give the name of a file");
  if (std::filesystem::exists(std::filesystem::symlink_status(path, error))) {
    if (!force) throw InputError(path + ": exists already; give another name, or --force to replace it");
    if (!format.is_format(path))
      throw InputError(path + ": is no readable " + format.name + "; --force replaces nothing else");
  }
  const auto folder = std::filesystem::path(path).parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder, error))
    throw InputError(path + ": the folder " + folder.string() + " does not exist");
}

void check_new_output(const std::string& path, bool force, const OutputFormat& format) {
  check_output(path, force, format);
  check_can_create(path);
}

std::string extension_of(const std::string& path) {
  return lower_case(std::filesystem::path(path).extension().string());
}

bool begins_with(const std::string& path, std::string_view text) {
  std::ifstream file(path, std::ios::binary);
  std::string begin(text.size(), '\0');
  file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return static_cast<std::size_t>(file.gcount()) == text.size() && begin == text;
}

}  // namespace eigentrail::app
