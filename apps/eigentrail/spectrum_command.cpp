#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "commands.hpp"
#include "core/texts.hpp"
#include "eigentrail/accuracy/data_errors.hpp"
#include "eigentrail/continuation/operating_point.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/projection/project.hpp"
#include "output.hpp"
#include "output_choice.hpp"
#include "scene_arguments.hpp"

namespace eigentrail::app {
namespace {

struct SpectrumArguments : SceneArguments {
  std::vector<std::string> at;
  PrintedFormat format;
};

double in_hertz(double angular) {
  return angular / (2.0 * std::numbers::pi);
}

/// A spectrum with the errors of its eigenvalues that come from the data, if the model has such.
struct ShownPoint : OperatingPoint {
  std::optional<Matrix> errors;  ///< a row per mode: interpolation and digits, 1/s

  double error(std::size_t mode) const {
    return errors ? errors->row(static_cast<Eigen::Index>(mode)).sum() : 0.0;
  }
};

std::vector<ShownPoint> with_errors(const TraceSetup& setup, std::vector<OperatingPoint> points) {
  std::vector<ShownPoint> result;
  for (OperatingPoint& point : points) {
    std::optional<Matrix> errors = data_errors_at(*setup.model, setup.options, point);
    result.push_back({std::move(point), std::move(errors)});
  }
  return result;
}

/// What CSV and JSON hold: a row per mode.
Records records_of(const std::vector<ShownPoint>& points) {
  Records records{{"parameter", "mode", "real", "imag", "natural_frequency_hz", "damped_frequency_hz",
                   "damping_ratio", "log_decrement", "condition", "rounding", "what_moves"}};
  const bool errors = std::ranges::any_of(points, [](const ShownPoint& point) { return bool(point.errors); });
  if (errors) records.columns.insert(records.columns.end(), {"interpolation_error", "digits_error"});
  for (const ShownPoint& point : points) {
    for (std::size_t i = 0; i < point.modes.size(); ++i) {
      const OperatingMode& mode = point.modes[i];
      records.rows.push_back({point.p, count(i + 1), mode.s.real(), mode.s.imag(), in_hertz(std::abs(mode.s)),
                              in_hertz(mode.s.imag()), -mode.s.real() / std::abs(mode.s),
                              log_decrement(mode.s), mode.condition, mode.rounding,
                              printable(mode.what_moves)});
      if (!point.errors) continue;
      for (const double error : point.errors->row(static_cast<Eigen::Index>(i)))
        records.rows.back().emplace_back(error);
    }
  }
  return records;
}

/// Prints "  LABEL: 1, 4", or nothing if there are none.
void print_modes(const char* label, const std::vector<std::size_t>& modes) {
  const auto text = [](std::size_t mode) { return std::to_string(mode); };
  if (!modes.empty()) std::printf("  %s: %s\n", label, joined(modes, ", ", text).c_str());
}

std::vector<std::string> table_row(const ShownPoint& point, std::size_t i) {
  const OperatingMode& mode = point.modes[i];
  const Complex s = shown(mode);
  const double ratio = -s.real() / std::abs(s);
  const double decrement = log_decrement(s);
  std::vector<std::string> row{std::to_string(i + 1), complex_text(s.real() + 0.0, s.imag(), 8)};
  if (point.errors) row.push_back(rounded(point.error(i), 2));
  row.insert(row.end(), {rounded(in_hertz(std::abs(s)), 6), rounded(in_hertz(s.imag()), 6),
                         std::isfinite(ratio) ? percent(ratio, 4) : "-",
                         std::isfinite(decrement) ? rounded(decrement + 0.0, 4) : "-",
                         rounded(mode.condition, 3), cell_text(mode.what_moves)});
  return row;
}

void print_point(const ShownPoint& point) {
  std::vector<std::string> titles{"mode", "s, 1/s"};
  if (point.errors) titles.emplace_back("error of data, 1/s");
  titles.insert(titles.end(),
                {"natural, Hz", "damped, Hz", "damping", "decrement", "condition", "what moves"});
  std::vector<std::vector<std::string>> rows{titles};
  std::vector<std::size_t> growing, undecided, unknown;
  for (std::size_t i = 0; i < point.modes.size(); ++i) {
    rows.push_back(table_row(point, i));
    const double real = shown(point.modes[i]).real();
    if (std::abs(real) <= point.error(i) && point.error(i) > 0.0) {
      undecided.push_back(i + 1);
    } else if (real > 0.0) {
      (std::isfinite(point.modes[i].rounding) ? growing : unknown).push_back(i + 1);
    }
  }
  print_table(rows);
  if (!point.note.empty()) std::printf("  note  %s\n", point.note.c_str());
  print_modes("modes that grow", growing);
  print_modes("modes of which rounding leaves undecided whether they grow", unknown);
  print_modes("modes of which the errors of the data leave undecided whether they grow", undecided);
}

void print_for_people(const TraceSetup& setup, const std::vector<ShownPoint>& points) {
  const std::string& unit = setup.model->description().parameters.at(setup.options.parameter).unit;
  print_title(setup.scene.title);
  for (const ShownPoint& point : points) {
    std::printf("%s = %s%s\n", setup.options.parameter.c_str(), exact_text(point.p).c_str(),
                (unit.empty() ? unit : " " + unit).c_str());
    if (point.fault.empty()) print_point(point);
  }
}

int run_spectrum(const SpectrumArguments& arguments, const SparseSolverMaker& solver) {
  TraceSetup setup = given_setup(arguments, Purpose::operating_point);
  const std::vector<double> values = given_values(setup, arguments.at);
  project_at_if_large(setup.model, setup.options, values, {.solver = solver});
  const std::vector<ShownPoint> points = with_errors(setup, operating_points(setup, values));
  const Records records = records_of(points);
  if (!arguments.format) {
    print_for_people(setup, points);
  } else if (arguments.format.json || !records.rows.empty()) {
    print(records, arguments.format);
  }
  int code = done;
  for (const ShownPoint& point : points) {
    const auto tell = [&](const std::string& text) {
      std::fprintf(stderr, "eigentrail: %s = %s: %s\n", setup.options.parameter.c_str(),
                   exact_text(point.p).c_str(), printable(text).c_str());
    };
    if (!point.note.empty() && arguments.format) tell(point.note);
    if (point.fault.empty()) continue;
    tell(point.fault);
    code = numbers_failed;
  }
  return code;
}

}  // namespace

void add_spectrum(CLI::App& program, int& exit_code) {
  const auto [command, arguments] =
      add_command<SpectrumArguments>(program, exit_code, factoring(run_spectrum), "spectrum",
                                     "eigenvalues at single values of the parameter, without a trace");
  add_scene(*command, *arguments);
  command->add_option(
      "--at", arguments->at,
      "parameter values, in the parameter's unit: 40, 10,20, 0:5:40 (begin:step:end), \"100 rpm\"; "
      "default: the value of --set, or where the trace begins");
  add_overrides(*command, *arguments, {"parameter", "modes", "without"});
  add_formats(*command, arguments->format, "print a line per mode");
  command->footer(
      "Examples:\n"
      "  eigentrail spectrum data/scenes/rotating_mass.toml --at 40\n"
      "  eigentrail spectrum turbine.toml --at 8 12 --modes \"band = ['0.1 Hz', '3 Hz']\" --csv");
}

}  // namespace eigentrail::app
