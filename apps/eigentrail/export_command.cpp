#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "eigentrail/core/errors.hpp"
#include "export_tables.hpp"
#include "output_choice.hpp"

namespace eigentrail::app {
namespace {

struct ExportArguments {
  std::string file;
  OutputChoice output;
  bool csv = false;
  bool json = false;
  bool no_shapes = false;
  int points = 0;
};

/// What this command writes, for messages.
constexpr const char* exported = "export of eigentrail";

/// What JSON files of this command begin with.
constexpr std::string_view json_signature = "{\n  \"format\": \"eigentrail-export\"";

/// Whether a file is a table with the same first columns.
bool is_table(const std::string& path, const ExportTable& table) {
  return begins_with(path, table.columns[0] + "," + table.columns[1] + "," + table.columns[2]);
}

/// All tables of the file; `only_loci`: just the first.
std::vector<ExportTable> tables_of(const LociFile& loci, const ExportArguments& arguments, bool only_loci) {
  const std::optional<int> points = arguments.points > 0 ? std::optional(arguments.points) : std::nullopt;
  std::vector<ExportTable> tables{loci_table(loci, points)};
  if (only_loci) return tables;
  tables.push_back(events_table(loci));
  tables.push_back(ranges_table(loci));
  if (!arguments.no_shapes) tables.push_back(shapes_table(loci));
  return tables;
}

void write_json(const LociFile& loci, const std::vector<ExportTable>& tables,
                const ExportArguments& arguments) {
  const OutputChoice& output = arguments.output;
  check_new_output(output.path, output.force,
                   {exported, [](const std::string& path) { return begins_with(path, json_signature); }});
  nlohmann::ordered_json data{
      {"format", "eigentrail-export"}, {"parameter", loci.parameter}, {"unit", loci.parameter_unit}};
  for (const ExportTable& table : tables) data[table.name] = json_of(table);
  const std::string text = data.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  write_durably(output.path, {text}, output.existing());
  if (!output.quiet) std::printf("wrote %s\n", output.path.c_str());
}

/// One table to a file, or all of them to a folder. Nothing is written if one of the files may not be
/// replaced.
void write_csv(const std::vector<ExportTable>& tables, const ExportArguments& arguments, bool to_file) {
  const OutputChoice& output = arguments.output;
  const auto path_of = [&](const ExportTable& table) {
    return to_file ? output.path : (std::filesystem::path(output.path) / (table.name + ".csv")).string();
  };
  if (!to_file) {
    std::error_code error;
    std::filesystem::create_directories(output.path, error);
    if (error) throw InputError(output.path + ": cannot be created: " + error.message());
  }
  for (const ExportTable& table : tables)
    check_new_output(path_of(table), output.force,
                     {exported, [&table](const std::string& path) { return is_table(path, table); }});
  for (const ExportTable& table : tables) {
    write_durably(path_of(table), {csv_text(table)}, output.existing());
    if (!output.quiet)
      std::printf("wrote %s (%zu row%s)\n", path_of(table).c_str(), table.rows.size(),
                  table.rows.size() == 1 ? "" : "s");
  }
}

bool ends_in(const std::string& path, const char* ending) {
  return std::filesystem::path(path).extension() == ending;
}

int run_export(ExportArguments& arguments) {
  arguments.output.name_like(arguments.file, arguments.json ? ".json" : "_csv");
  if (arguments.points == 1 || arguments.points < 0)
    throw InputError("--points " + std::to_string(arguments.points) + ": expected two or more");
  if (arguments.csv && arguments.json) throw InputError("--csv and --json: expected one of them");
  const bool json = arguments.json || (!arguments.csv && ends_in(arguments.output.path, ".json"));
  if (json != ends_in(arguments.output.path, ".json"))
    throw InputError(arguments.output.path +
                     (json ? ": expected a name that ends in .json" : ": --csv writes no JSON"));
  const LociFile loci = read_loci(arguments.file);
  if (loci.n_nodes() == 0) throw InputError(arguments.file + ": holds no points");
  const bool to_file = !json && ends_in(arguments.output.path, ".csv");
  const std::vector<ExportTable> tables = tables_of(loci, arguments, to_file);
  if (json) {
    write_json(loci, tables, arguments);
  } else {
    write_csv(tables, arguments, to_file);
  }
  return done;
}

}  // namespace

void add_export(CLI::App& program, int& exit_code) {
  const auto [command, arguments] = add_command<ExportArguments>(
      program, exit_code, run_export, "export",
      "a trace as tables: loci, events, stable ranges, mode shapes as CSV or JSON");
  command->add_option("FILE", arguments->file, "loci file")->required();
  command->add_flag("--csv", arguments->csv, "write comma-separated values (the default)");
  command->add_flag("--json", arguments->json, "write one file with all tables as lists of objects");
  add_output(*command, arguments->output,
             "folder for loci.csv, events.csv, stable_ranges.csv, mode_shapes.csv; a name that ends in "
             ".csv: only the loci; default: the name of the file");
  command->add_option(
      "--points", arguments->points,
      "equidistant values of the parameter, from the dense output; default: the stored points");
  command->add_flag("--no-shapes", arguments->no_shapes, "leave out mode shapes");
  add_output_flags(*command, arguments->output, {"replace existing tables", "", "say nothing"});
  command->footer(
      "Examples:\n  eigentrail export blade.h5 --csv -o tables\n  eigentrail export blade.h5 --points 500 -o "
      "blade.csv");
}

}  // namespace eigentrail::app
