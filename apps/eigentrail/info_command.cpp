#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/model/sampled_data.hpp"
#include "eigentrail/store/loci_file.hpp"
#include "output.hpp"
#include "records.hpp"
#include "report/file_data.hpp"
#include "samples_info.hpp"
#include "trace_summary.hpp"

namespace eigentrail::app {
namespace {

struct InfoArguments {
  std::string file;
  bool json = false;
  bool scene = false;
};

/// Largest value for one mode in a row-major node x mode array.
double column_maximum(const std::vector<double>& values, std::size_t mode, std::size_t n_modes) {
  double maximum = 0.0;
  for (std::size_t i = mode; i < values.size(); i += n_modes) maximum = std::max(maximum, values[i]);
  return maximum;
}

std::string attribute(const LociFile& loci, const std::string& name) {
  const auto found = loci.attributes.find(name);
  return found == loci.attributes.end() ? "?" : found->second;
}

/// Prints the parameter ranges on which the identity of a mode is not certified.
void print_uncertified(const LociFile& loci) {
  constexpr std::size_t most_lines = 20;
  std::size_t lines = 0;
  for (std::size_t mode = 0; mode < loci.modes.size(); ++mode) {
    for (const auto& [first, last] : loci.uncertified(mode)) {
      if (++lines > most_lines) continue;
      std::printf("  identity of %s not certified from %s to %s\n", loci.modes[mode].c_str(),
                  rounded(loci.p[first], 8).c_str(), rounded(loci.p[last], 8).c_str());
    }
  }
  if (lines > most_lines) std::printf("  and %zu more such stretches\n", lines - most_lines);
}

/// Prints the trimmed parameters at both ends.
void print_trimmed(const LociFile& loci) {
  if (loci.trimmed.empty()) return;
  std::vector<std::vector<std::string>> rows{{"trimmed parameter", "unit", "at the start", "at the end"}};
  for (const TrimmedParameter& trimmed : loci.trimmed)
    rows.push_back({printable(trimmed.about.substr(std::string("trimmed parameter ").size())),
                    trimmed.unit == "1" ? "-" : trimmed.unit, rounded(trimmed.values.front(), 8),
                    rounded(trimmed.values.back(), 8)});
  print_table(rows);
}

/// The order of the series as text, for example ", order 3 (auto)"; empty if the file does not contain it.
std::string order_of_series(const LociFile& loci) {
  const std::string order = attribute(loci, "series_order");
  return order == "?" ? "" : ", " + order_text(std::stoi(order), attribute(loci, "option_order") == "auto");
}

/// A hint on --resume for a file whose trace has not ended; empty for others.
std::string how_to_go_on(const std::string& status) {
  if (status == "running")
    return "  the trace is still running, or was killed: its command with --resume goes on\n";
  return status == "interrupted" ? "  its command with --resume goes on\n" : "";
}

void print_for_people(const LociFile& loci) {
  if (const std::string title = attribute(loci, "title"); !title.empty())
    std::printf("%s\n", printable(title).c_str());
  std::printf("  written by eigentrail %s, schema %s, run %s", attribute(loci, "program_version").c_str(),
              attribute(loci, "schema_version").c_str(), attribute(loci, "status").c_str());
  if (const std::string message = attribute(loci, "message"); message != "?" && !message.empty()) {
    std::printf(": %s", message.c_str());
  }
  std::printf("\n%s  %zu coordinates, %zu constraints, %zu modes, %zu points\n",
              how_to_go_on(attribute(loci, "status")).c_str(), loci.coordinates.size(),
              loci.constraints.size(), loci.modes.size(), loci.n_nodes());
  if (const std::string data = attribute(loci, "model_data"); data != "?") std::printf("%s", data.c_str());
  if (loci.n_nodes() == 0) return;
  std::printf("  %s  %s -> %s%s, tolerance %s relative to max(|s|, %s 1/s)%s\n", loci.parameter.c_str(),
              exact_text(loci.p.front()).c_str(), exact_text(loci.p.back()).c_str(),
              loci.parameter_unit == "1" ? "" : (" " + loci.parameter_unit).c_str(),
              attribute(loci, "tolerance").c_str(), rounded(loci.number("reference"), 4).c_str(),
              order_of_series(loci).c_str());
  std::vector<std::vector<std::string>> rows{{"mode", "what moves", "s at the start", "s at the end",
                                              "certified", "worst residual", "worst condition"}};
  const std::vector<Permanence> permanence = permanence_of_modes(loci);
  const auto end_value = [&](const ComplexVector& end, std::size_t mode) {
    if (permanence[mode] == Permanence::zero) return std::string("0");
    const Complex s = end[static_cast<Eigen::Index>(mode)];
    return std::isnan(s.real()) ? std::string("-") : eigenvalue_text(s, 8);
  };
  const ComplexVector first = loci.shown_at(loci.at_node(0)),
                      last = loci.shown_at(loci.at_node(loci.n_nodes() - 1));
  for (std::size_t i = 0; i < loci.modes.size(); ++i) {
    const double share = loci.certified_share(i);
    rows.push_back({loci.modes[i], cell_text(loci.mode_names[i]), end_value(first, i), end_value(last, i),
                    std::isnan(share) ? "-" : percent(share, 4),
                    rounded(column_maximum(loci.residual, i, loci.modes.size()), 2),
                    rounded(column_maximum(loci.condition, i, loci.modes.size()), 3)});
  }
  print_table(rows);
  print_uncertified(loci);
  print_trimmed(loci);
  print_permanent(permanence, loci.mode_names);
  if (loci.ranges) print_ranges(*loci.ranges, loci.parameter);
  if (!loci.events.empty())
    std::printf("  %zu special point%s; `eigentrail events` lists them\n", loci.events.size(),
                loci.events.size() == 1 ? "" : "s");
  if (const std::string notes = attribute(loci, "notes"); notes != "?" && !notes.empty())
    std::printf("  notes  %s\n", printable(notes).c_str());
  std::string counts;
  for (const auto& [name, value] : loci.attributes) {
    if (name.starts_with("count_")) counts += (counts.empty() ? "" : ", ") + name.substr(6) + " " + value;
  }
  if (!counts.empty()) std::printf("  counts  %s\n", counts.c_str());
}

void print_json(const LociFile& loci) {
  nlohmann::ordered_json info;
  info["file"] = loci.path;
  info["parameter"] = loci.parameter;
  info["unit"] = loci.parameter_unit;
  info["nodes"] = loci.n_nodes();
  if (loci.n_nodes() > 0) {
    info["from"] = loci.p.front();
    info["to"] = loci.p.back();
  }
  info["modes"] = loci.modes;
  info["mode_names"] = loci.mode_names;
  info["coordinates"] = loci.coordinates;
  info["constraints"] = loci.constraints;
  nlohmann::ordered_json certified;
  for (std::size_t i = 0; i < loci.modes.size(); ++i) {
    const double share = loci.certified_share(i);
    if (std::isfinite(share)) certified[loci.modes[i]] = share;
  }
  for (const TrimmedParameter& trimmed : loci.trimmed) {
    info["trimmed"][trimmed.name] = {{"unit", trimmed.unit},
                                     {"from", trimmed.values.empty() ? NAN : trimmed.values.front()},
                                     {"to", trimmed.values.empty() ? NAN : trimmed.values.back()}};
  }
  info["certified_share"] = certified;
  info["events"] = loci.events.size();
  if (loci.ranges) info["stable_ranges"] = ranges_data(*loci.ranges);
  info["attributes"] = loci.attributes;
  print_text_of(info);
}

int run_info(const InfoArguments& arguments) {
  require_result_file(arguments.file);
  if (holds_samples(arguments.file)) {
    if (arguments.scene)
      throw InputError(arguments.file + ": holds samples of matrices; --scene is for loci files");
    print_samples(arguments.file, arguments.json);
    return done;
  }
  const LociFile loci = read_loci(arguments.file);
  if (arguments.scene) {
    std::fputs(attribute(loci, "scene").c_str(), stdout);
  } else if (arguments.json) {
    print_json(loci);
  } else {
    print_for_people(loci);
  }
  return done;
}

}  // namespace

void add_info(CLI::App& program, int& exit_code) {
  const auto [command, arguments] =
      add_command<InfoArguments>(program, exit_code, run_info, "info",
                                 "what a loci file or a file of samples holds, and how it was made");
  command->add_option("FILE", arguments->file, "loci file, or samples of matrices (HDF5)")->required();
  auto* json = command->add_flag("--json", arguments->json, "print one JSON object");
  command->add_flag("--scene", arguments->scene, "print the scene that the file was made from")
      ->excludes(json);
  command->footer("Example:\n  eigentrail info blade.h5");
}

}  // namespace eigentrail::app
