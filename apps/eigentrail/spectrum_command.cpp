#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "commands.hpp"
#include "eigentrail/continuation/operating_point.hpp"
#include "eigentrail/core/text.hpp"
#include "output.hpp"

namespace eigentrail::app {
namespace {

struct SpectrumArguments {
  std::string scene;
  std::vector<double> at;
  std::map<std::string, std::string> options;
  bool csv = false;
  bool json = false;
};

/// Real part below which an eigenvalue neither grows nor decays, as far as rounding tells.
double rounding_of(const OperatingMode& mode) {
  constexpr double few_roundings = 1e-15;
  return std::isfinite(mode.condition)
             ? few_roundings * std::max(mode.condition, 1.0) * natural_frequency(mode)
             : 0.0;
}

/// The eigenvalue with a real part within rounding shown as zero.
Complex shown(const OperatingMode& mode) {
  return std::abs(mode.s.real()) <= rounding_of(mode) ? Complex(0.0, mode.s.imag()) : mode.s;
}

double in_hertz(double angular) {
  return angular / (2.0 * std::numbers::pi);
}

void print_csv(const std::vector<OperatingPoint>& points) {
  std::printf(
      "parameter,mode,real,imag,natural_frequency_hz,damped_frequency_hz,damping_ratio,condition,what_"
      "moves\n");
  for (const OperatingPoint& point : points) {
    for (std::size_t i = 0; i < point.modes.size(); ++i) {
      const OperatingMode& mode = point.modes[i];
      std::printf("%s,%zu,%s,%s,%s,%s,%s,%s,\"%s\"\n", exact_text(point.p).c_str(), i + 1,
                  exact_text(mode.s.real()).c_str(), exact_text(mode.s.imag()).c_str(),
                  exact_text(in_hertz(natural_frequency(mode))).c_str(),
                  exact_text(in_hertz(mode.s.imag())).c_str(), exact_text(damping_ratio(mode)).c_str(),
                  exact_text(mode.condition).c_str(), printable(mode.what_moves).c_str());
    }
  }
}

void print_json(const std::vector<OperatingPoint>& points) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const OperatingPoint& point : points) {
    for (std::size_t i = 0; i < point.modes.size(); ++i) {
      const OperatingMode& mode = point.modes[i];
      rows.push_back({{"parameter", point.p},
                      {"mode", i + 1},
                      {"real", mode.s.real()},
                      {"imag", mode.s.imag()},
                      {"natural_frequency_hz", in_hertz(natural_frequency(mode))},
                      {"damped_frequency_hz", in_hertz(mode.s.imag())},
                      {"damping_ratio", damping_ratio(mode)},
                      {"condition", mode.condition},
                      {"what_moves", mode.what_moves}});
    }
  }
  std::printf("%s\n", rows.dump(2).c_str());
}

void print_for_people(const TraceSetup& setup, const std::vector<OperatingPoint>& points) {
  const std::string& unit = setup.model->description().parameters.at(setup.options.parameter).unit;
  if (!setup.scene.title.empty()) std::printf("%s\n", printable(setup.scene.title).c_str());
  for (const OperatingPoint& point : points) {
    std::printf("%s = %s%s\n", setup.options.parameter.c_str(), exact_text(point.p).c_str(),
                (unit.empty() ? unit : " " + unit).c_str());
    std::vector<std::vector<std::string>> rows{
        {"mode", "s, 1/s", "natural, Hz", "damped, Hz", "damping", "condition", "what moves"}};
    for (std::size_t i = 0; i < point.modes.size(); ++i) {
      const OperatingMode& mode = point.modes[i];
      const Complex s = shown(mode);
      const double ratio = -s.real() / std::abs(s);
      rows.push_back({std::to_string(i + 1), complex_text(s.real() + 0.0, s.imag(), 8),
                      rounded(in_hertz(natural_frequency(mode)), 6), rounded(in_hertz(mode.s.imag()), 6),
                      std::isfinite(ratio) ? rounded(100.0 * ratio + 0.0, 4) + " %" : "-",
                      rounded(mode.condition, 3), printable(mode.what_moves)});
    }
    print_table(rows);
    std::vector<std::size_t> growing;
    for (std::size_t i = 0; i < point.modes.size(); ++i) {
      if (shown(point.modes[i]).real() > 0.0) growing.push_back(i + 1);
    }
    if (growing.empty()) continue;
    std::string list;
    for (const std::size_t mode : growing) list += (list.empty() ? "" : ", ") + std::to_string(mode);
    std::printf("  modes that grow: %s\n", list.c_str());
  }
}

int run_spectrum(const SpectrumArguments& arguments) {
  const TraceSetup setup =
      prepare_trace(read_scene(arguments.scene), {arguments.options.begin(), arguments.options.end()},
                    Purpose::operating_point);
  const std::vector<double> values = arguments.at.empty() ? std::vector{setup.options.from} : arguments.at;
  const std::vector<OperatingPoint> points = operating_points(setup, values);
  if (arguments.csv) {
    print_csv(points);
  } else if (arguments.json) {
    print_json(points);
  } else {
    print_for_people(setup, points);
  }
  int code = done;
  for (const OperatingPoint& point : points) {
    if (point.fault.empty()) continue;
    std::fprintf(stderr, "eigentrail: %s = %s: %s\n", setup.options.parameter.c_str(),
                 exact_text(point.p).c_str(), printable(point.fault).c_str());
    code = numbers_failed;
  }
  return code;
}

}  // namespace

void add_spectrum(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<SpectrumArguments>();
  CLI::App* command =
      program.add_subcommand("spectrum", "eigenvalues at single values of the parameter, without a trace");
  command->add_option("SCENE", arguments->scene, "scene file (TOML)")->required();
  command->add_option("--at", arguments->at,
                      "parameter values, in the parameter's unit; default: where the trace begins");
  for (const std::string name : {"parameter", "modes", "without"}) {
    command->add_option_function<std::string>(
        "--" + name, [arguments, name](const std::string& text) { arguments->options[name] = text; },
        "as for trace (overrides the scene)");
  }
  auto* csv = command->add_flag("--csv", arguments->csv, "print a line per mode");
  command->add_flag("--json", arguments->json, "print a list of objects")->excludes(csv);
  command->footer(
      "Examples:\n"
      "  eigentrail spectrum data/scenes/rotating_mass.toml --at 40\n"
      "  eigentrail spectrum turbine.toml --at 8 12 --modes \"band = ['0.1 Hz', '3 Hz']\" --csv");
  command->callback([arguments, &exit_code] { exit_code = run_spectrum(*arguments); });
}

}  // namespace eigentrail::app
