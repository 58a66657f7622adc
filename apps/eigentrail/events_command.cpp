#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "eigentrail/continuation/event_kinds.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/store/loci_file.hpp"
#include "output.hpp"
#include "output_choice.hpp"

namespace eigentrail::app {
namespace {

struct EventsArguments {
  std::string file;
  PrintedFormat format;
  bool sensitivity = false;
};

Records records_of(const LociFile& loci) {
  Records records{{"kind", "parameter", "real", "imag", "modes"}};
  if (loci.data_errors) records.columns.insert(records.columns.end(), {"interval_from", "interval_to"});
  for (std::size_t i = 0; i < loci.events.size(); ++i) {
    const LociEvent& event = loci.events[i];
    records.rows.push_back({event.kind, event.parameter, event.s.real(), event.s.imag(), event.modes});
    if (!loci.data_errors) continue;
    const EventInterval& interval = loci.data_errors->intervals[i];
    records.rows.back().insert(records.rows.back().end(), {interval.from, interval.to});
  }
  return records;
}

/// The interval of an event; null if it has none.
const EventInterval* interval_of(const LociFile& loci, std::size_t event) {
  if (!loci.data_errors) return nullptr;
  const EventInterval& interval = loci.data_errors->intervals[event];
  return std::isfinite(interval.from) ? &interval : nullptr;
}

void print_events_json(const LociFile& loci) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (std::size_t number = 0; number < loci.events.size(); ++number) {
    const LociEvent& event = loci.events[number];
    nlohmann::ordered_json row{{"kind", event.kind},
                               {"parameter", event.parameter},
                               {"real", event.s.real()},
                               {"imag", event.s.imag()},
                               {"modes", event.modes}};
    if (const EventInterval* interval = interval_of(loci, number)) {
      row["interval"] = {interval->from, interval->to};
      row["interval_cut"] = is_cut(*interval, loci.lowest(), loci.highest());
    }
    if (std::isfinite(event.half_width)) row["half_width"] = event.half_width;
    if (std::isfinite(event.puiseux.real())) row["puiseux"] = {event.puiseux.real(), event.puiseux.imag()};
    if (event.direction != 0) row["direction"] = event.direction;
    if (std::isfinite(event.value)) row["value"] = event.value;
    for (std::size_t i = 0; i < loci.scene_parameters.size(); ++i) {
      const auto q = static_cast<Eigen::Index>(i);
      const Complex slope = event.sensitivity[q];
      if (std::isfinite(slope.real()))
        row["sensitivity"][loci.scene_parameters[i]] = {slope.real(), slope.imag()};
      if (std::isfinite(event.shift[q])) row["shift"][loci.scene_parameters[i]] = event.shift[q];
    }
    rows.push_back(std::move(row));
  }
  print_text_of(rows);
}

/// The remark on an event; empty if this version of the program does not know its kind.
std::string remark_on(const LociEvent& event) {
  const EventKindInfo* kind = find_event_kind(event.kind);
  return kind == nullptr ? "" : kind->remark(event);
}

void print_events_table(const LociFile& loci) {
  if (loci.events.empty()) {
    std::printf("no special points between %s = %s and %s\n", loci.parameter.c_str(),
                exact_text(loci.lowest()).c_str(), exact_text(loci.highest()).c_str());
    return;
  }
  std::vector<std::vector<std::string>> rows{{"kind", loci.parameter, "s", "modes", "remark"}};
  for (std::size_t i = 0; i < loci.events.size(); ++i) {
    const LociEvent& event = loci.events[i];
    std::string remark = remark_on(event);
    if (const EventInterval* interval = interval_of(loci, i)) {
      const std::string text = interval_text(*interval, loci.lowest(), loci.highest());
      remark += (remark.empty() || text.empty() ? "" : ", ") + text;
    }
    rows.push_back({event.kind, rounded(without_rounding(event.parameter, loci.lowest(), loci.highest()), 14),
                    eigenvalue_text(event.s, 10), event.modes, remark});
  }
  print_table(rows);
}

/// Prints the sensitivities of all events to all parameters.
void print_sensitivities(const LociFile& loci) {
  const auto text = [](double value) { return std::isfinite(value) ? rounded(value, 8) : "-"; };
  std::vector<std::vector<std::string>> rows{
      {"kind", loci.parameter, "modes", "q", "ds/dq", "d" + loci.parameter + "/dq"}};
  for (const LociEvent& event : loci.events) {
    for (std::size_t i = 0; i < loci.scene_parameters.size(); ++i) {
      const auto q = static_cast<Eigen::Index>(i);
      const Complex slope = event.sensitivity[q];
      if (!std::isfinite(slope.real()) && !std::isfinite(event.shift[q])) continue;
      rows.push_back({event.kind, rounded(event.parameter, 14), event.modes, loci.scene_parameters[i],
                      std::isfinite(slope.real()) ? complex_text(slope.real(), slope.imag(), 8) : "-",
                      text(event.shift[q])});
    }
  }
  print_table(rows);
}

int run_events(const EventsArguments& arguments) {
  const LociFile loci = read_loci(arguments.file);
  if (arguments.format.csv) {
    print(records_of(loci), arguments.format);
  } else if (arguments.format.json) {
    print_events_json(loci);
  } else if (arguments.sensitivity) {
    print_sensitivities(loci);
  } else {
    print_events_table(loci);
  }
  return done;
}

}  // namespace

void add_events(CLI::App& program, int& exit_code) {
  const auto [command, arguments] = add_command<EventsArguments>(
      program, exit_code, run_events, "events",
      "special points of a trace: flutter, divergence, resonances, collisions, crossings, veerings, folds");
  command->add_option("FILE", arguments->file, "loci file")->required();
  const auto [csv, json] = add_formats(*command, arguments->format, "print kind,parameter,real,imag,modes");
  command->add_flag("--sensitivity", arguments->sensitivity, "print how they depend on every parameter")
      ->excludes(csv)
      ->excludes(json);
  command->footer(
      "Examples:\n  eigentrail events blade.h5 --csv\n  eigentrail events blade.h5 --sensitivity");
}

}  // namespace eigentrail::app
