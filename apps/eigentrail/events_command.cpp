#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/store/loci_file.hpp"
#include "output.hpp"

namespace eigentrail::app {
namespace {

struct EventsArguments {
  std::string file;
  bool csv = false;
  bool json = false;
};

void print_csv(const LociFile& loci) {
  std::printf("kind,parameter,real,imag,modes\n");
  for (const LociEvent& event : loci.events) {
    std::printf("%s,%s,%s,%s,%s\n", event.kind.c_str(), exact_text(event.parameter).c_str(),
                exact_text(event.s.real()).c_str(), exact_text(event.s.imag()).c_str(), event.modes.c_str());
  }
}

void print_json(const LociFile& loci) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const LociEvent& event : loci.events) {
    nlohmann::ordered_json row{{"kind", event.kind},
                               {"parameter", event.parameter},
                               {"real", event.s.real()},
                               {"imag", event.s.imag()},
                               {"modes", event.modes}};
    if (std::isfinite(event.half_width)) row["half_width"] = event.half_width;
    if (std::isfinite(event.puiseux.real())) row["puiseux"] = {event.puiseux.real(), event.puiseux.imag()};
    rows.push_back(std::move(row));
  }
  std::printf("%s\n", rows.dump(2).c_str());
}

void print_for_people(const LociFile& loci) {
  if (loci.events.empty()) {
    std::printf("no special points between %s = %s and %s\n", loci.parameter.c_str(),
                exact_text(loci.lowest()).c_str(), exact_text(loci.highest()).c_str());
    return;
  }
  std::vector<std::vector<std::string>> rows{{"kind", loci.parameter, "s", "modes", "remark"}};
  for (const LociEvent& event : loci.events) {
    std::string remark;
    if (std::isfinite(event.half_width)) remark = "half-width " + rounded(event.half_width, 6);
    if (std::isfinite(event.puiseux.real())) {
      remark = "Puiseux coefficient " + complex_text(event.puiseux.real(), event.puiseux.imag(), 6);
    }
    rows.push_back({event.kind, rounded(event.parameter, 14),
                    complex_text(event.s.real(), event.s.imag(), 10), event.modes, remark});
  }
  print_table(rows);
}

int run_events(const EventsArguments& arguments) {
  const LociFile loci = read_loci(arguments.file);
  if (arguments.csv) {
    print_csv(loci);
  } else if (arguments.json) {
    print_json(loci);
  } else {
    print_for_people(loci);
  }
  return done;
}

}  // namespace

void add_events(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<EventsArguments>();
  CLI::App* command = program.add_subcommand(
      "events", "special points of a trace: flutter, divergence, collisions, crossings, veerings, folds");
  command->add_option("FILE", arguments->file, "loci file")->required();
  auto* csv = command->add_flag("--csv", arguments->csv, "print kind,parameter,real,imag,modes");
  command->add_flag("--json", arguments->json, "print a list of objects")->excludes(csv);
  command->footer("Example:\n  eigentrail events blade.h5 --csv");
  command->callback([arguments, &exit_code] { exit_code = run_events(*arguments); });
}

}  // namespace eigentrail::app
