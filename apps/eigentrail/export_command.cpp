#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/store/loci_file.hpp"
#include "output.hpp"
#include "output_choice.hpp"
#include "records.hpp"

namespace eigentrail::app {
namespace {

struct ExportTable {
  std::string name;  ///< of the file, without ending
  Records records;
};

/// The eigenvalues at a place of the path.
struct Place {
  double p = 0.0;
  std::size_t step = 0;
  double t = 0.0;
  ComplexVector s;
};

/// The step that says something on a mode at a place: the step behind it where the mode begins at its end.
std::size_t step_of(const LociFile& loci, const Place& place, int mode) {
  const bool next =
      place.t == 1.0 && place.step + 1 < loci.steps.size() && loci.block_of(place.step, mode) == nullptr;
  return place.step + (next ? 1 : 0);
}

/// 1 or 0; NaN where the mode exists on no step at the place.
Cell certified_at(const LociFile& loci, const Place& place, int mode) {
  if (loci.steps.empty()) return NAN;
  const DenseBlock* block = loci.block_of(step_of(loci, place, mode), mode);
  return block == nullptr ? NAN : count(block->certified ? 1 : 0);
}

/// The stored points; a point belongs to the step that ends there.
std::vector<Place> stored_places(const LociFile& loci) {
  std::vector<Place> places;
  for (std::size_t node = 0; node < loci.n_nodes(); ++node) {
    const auto row = static_cast<Eigen::Index>(node);
    places.push_back(
        {loci.p[node], node > 0 ? node - 1 : 0, node > 0 ? 1.0 : 0.0, loci.eigenvalues.row(row)});
  }
  return places;
}

std::vector<Place> equidistant_places(const LociFile& loci, int points) {
  std::vector<Place> places;
  const double low = loci.lowest(), high = loci.highest();
  for (int i = 0; i < points; ++i) {
    const double share = static_cast<double>(i) / (points - 1);
    const double p = i + 1 == points ? high : low + share * (high - low);
    for (const PathPosition& position : loci.positions(p))
      places.push_back({p, position.step, position.t, loci.eigenvalues_at(position)});
  }
  return places;
}

/// Every mode that exists at every place: number of the place along the output, parameter, mode, name, real
/// and imaginary part (1/s), natural and damped frequency (rad/s), damping ratio, logarithmic decrement,
/// certified, and errors of the data where the file has them. The places are the stored points, or `points`
/// equidistant values of the parameter, at which the dense output is evaluated; where the path turns back,
/// every passage of a value is a place.
Records loci_table(const LociFile& loci, std::optional<int> points) {
  Records table{{"place", loci.parameter, "mode", "name", "real", "imag", "natural_frequency",
                 "damped_frequency", "damping_ratio", "log_decrement", "certified"}};
  if (loci.data_errors) table.columns.insert(table.columns.end(), {"interpolation_error", "digits_error"});
  const std::vector<Place> places = points ? equidistant_places(loci, *points) : stored_places(loci);
  for (std::size_t number = 0; number < places.size(); ++number) {
    const Place& place = places[number];
    for (Eigen::Index i = 0; i < place.s.size(); ++i) {
      const Complex s = place.s[i];
      if (std::isnan(s.real())) continue;
      const auto mode = static_cast<int>(i);
      const double size = std::abs(s);
      table.rows.push_back({count(number), place.p, count(mode + 1),
                            loci.mode_names[static_cast<std::size_t>(i)], s.real(), s.imag(), size,
                            std::abs(s.imag()), -s.real() / size + 0.0, log_decrement(s),
                            certified_at(loci, place, mode)});
      if (!loci.data_errors) continue;
      const auto step = static_cast<Eigen::Index>(step_of(loci, place, mode));
      table.rows.back().insert(table.rows.back().end(),
                               {loci.data_errors->interpolation(step, i), loci.data_errors->digits(step, i)});
    }
  }
  return table;
}

/// All events with their sensitivities (real and imaginary part) and shifts, per parameter of the scene.
Records events_table(const LociFile& loci) {
  Records table{{"kind", loci.parameter, "real", "imag", "modes", "direction", "value", "half_width",
                 "puiseux_real", "puiseux_imag"}};
  if (loci.data_errors) table.columns.insert(table.columns.end(), {"interval_from", "interval_to"});
  for (const std::string& name : loci.scene_parameters)
    table.columns.insert(table.columns.end(),
                         {"sensitivity_" + name + "_real", "sensitivity_" + name + "_imag", "shift_" + name});
  for (std::size_t i = 0; i < loci.events.size(); ++i) {
    const LociEvent& event = loci.events[i];
    std::vector<Cell> row{event.kind,           event.parameter,        event.s.real(), event.s.imag(),
                          event.modes,          count(event.direction), event.value,    event.half_width,
                          event.puiseux.real(), event.puiseux.imag()};
    if (loci.data_errors)
      row.insert(row.end(), {loci.data_errors->intervals[i].from, loci.data_errors->intervals[i].to});
    for (Eigen::Index q = 0; q < event.shift.size(); ++q)
      row.insert(row.end(), {event.sensitivity[q].real(), event.sensitivity[q].imag(), event.shift[q]});
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// Stable ranges with their ends; without rows if the file has none.
Records ranges_table(const LociFile& loci) {
  Records table{{"kind", "from", "to", "cause_from", "cause_to", "margin_from", "margin_to", "mode_from",
                 "mode_to", "least_margin", "largest_margin", "largest_at", "whole_model"}};
  if (!loci.ranges) return table;
  const auto mode = [](int number) { return number < 0 ? Cell(NAN) : count(number + 1); };
  for (const StableRange& range : *loci.ranges) {
    table.rows.push_back({std::string(stability_name(range.kind)), range.from.p, range.to.p, range.from.cause,
                          range.to.cause, range.from.margin, range.to.margin, mode(range.from.mode),
                          mode(range.to.mode), range.least_margin, range.largest_margin, range.largest_at,
                          count(range.whole ? 1 : 0)});
  }
  return table;
}

/// Mode shapes at the stored points: a row per coordinate.
Records shapes_table(const LociFile& loci) {
  Records table{{"place", loci.parameter, "mode", "name", "coordinate", "real", "imag"}};
  const std::size_t n = loci.coordinates.size();
  read_mode_shapes(loci, [&](std::size_t node, std::span<const Complex> shapes) {
    for (std::size_t mode = 0; mode < loci.modes.size(); ++mode) {
      for (std::size_t i = 0; i < n; ++i) {
        const Complex z = shapes[mode * n + i];
        if (std::isnan(z.real())) continue;
        table.rows.push_back({count(node), loci.p[node], count(mode + 1), loci.mode_names[mode],
                              loci.coordinates[i], z.real(), z.imag()});
      }
    }
  });
  return table;
}

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
bool is_table(const std::string& path, const Records& table) {
  return begins_with(path, table.columns[0] + "," + table.columns[1] + "," + table.columns[2]);
}

/// All tables of the file; `only_loci`: just the first.
std::vector<ExportTable> tables_of(const LociFile& loci, const ExportArguments& arguments, bool only_loci) {
  const std::optional<int> points = arguments.points > 0 ? std::optional(arguments.points) : std::nullopt;
  std::vector<ExportTable> tables{{"loci", loci_table(loci, points)}};
  if (only_loci) return tables;
  tables.push_back({"events", events_table(loci)});
  tables.push_back({"stable_ranges", ranges_table(loci)});
  if (!arguments.no_shapes) tables.push_back({"mode_shapes", shapes_table(loci)});
  return tables;
}

void write_json(const LociFile& loci, const std::vector<ExportTable>& tables,
                const ExportArguments& arguments) {
  const OutputChoice& output = arguments.output;
  check_new_output(output.path, output.force,
                   {exported, [](const std::string& path) { return begins_with(path, json_signature); }});
  nlohmann::ordered_json data{
      {"format", "eigentrail-export"}, {"parameter", loci.parameter}, {"unit", loci.parameter_unit}};
  for (const ExportTable& table : tables) data[table.name] = json_of(table.records);
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
                     {exported, [&table](const std::string& path) { return is_table(path, table.records); }});
  for (const ExportTable& table : tables) {
    write_durably(path_of(table), {csv_text(table.records, "")}, output.existing());
    const std::size_t rows = table.records.rows.size();
    if (!output.quiet)
      std::printf("wrote %s (%zu row%s)\n", path_of(table).c_str(), rows, rows == 1 ? "" : "s");
  }
}

int run_export(ExportArguments& arguments) {
  arguments.output.name_like(arguments.file, arguments.json ? ".json" : "_csv");
  if (arguments.points == 1 || arguments.points < 0)
    throw InputError("--points " + std::to_string(arguments.points) + ": expected two or more");
  if (arguments.csv && arguments.json) throw InputError("--csv and --json: expected one of them");
  const std::filesystem::path ending = std::filesystem::path(arguments.output.path).extension();
  const bool json = arguments.json || (!arguments.csv && ending == ".json");
  if (json != (ending == ".json"))
    throw InputError(arguments.output.path +
                     (json ? ": expected a name that ends in .json" : ": --csv writes no JSON"));
  const LociFile loci = read_loci(arguments.file);
  if (loci.n_nodes() == 0) throw InputError(arguments.file + ": holds no points");
  const bool to_file = !json && ending == ".csv";
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
