#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/store/loci_file.hpp"
#include "frequency_unit.hpp"
#include "output.hpp"
#include "ranges.hpp"
#include "values.hpp"

namespace eigentrail::app {
namespace {

struct EvalArguments {
  std::string file;
  std::vector<std::string> at;
  bool csv = false;
  bool json = false;
};

/// An eigenvalue at a value of the parameter.
struct Evaluated {
  double p = 0.0;
  std::string mode;
  Complex s;
  bool is_zero = false;  ///< the mode is zero throughout: s is rounding
  /// Bounds of errors that come from the data of the model; NaN if it has none.
  double interpolation = NAN, digits = NAN;
  Vector trimmed = {};  ///< values of the trimmed parameters
};

/// Each value p in `at`, each passage of the path there, and each mode that exists.
std::vector<Evaluated> all_values(const LociFile& loci, const std::vector<double>& at) {
  std::vector<Evaluated> values;
  const std::vector<Permanence> permanence = permanence_of_modes(loci);
  for (const double p : at) {
    const std::vector<ComplexVector> passages = loci.eigenvalues_at(p);
    const auto positions = loci.positions(p);
    for (std::size_t passage = 0; passage < passages.size(); ++passage) {
      const ComplexVector& s = passages[passage];
      for (Eigen::Index i = 0; i < s.size(); ++i) {
        if (std::isnan(s[i].real())) continue;
        const auto mode = static_cast<std::size_t>(i);
        Evaluated value{p, loci.modes[mode], s[i], permanence[mode] == Permanence::zero};
        if (loci.data_errors && passage < positions.size()) {
          const auto step = static_cast<Eigen::Index>(positions[passage].step);
          value.interpolation = loci.data_errors->interpolation(step, i);
          value.digits = loci.data_errors->digits(step, i);
        }
        if (passage < positions.size()) value.trimmed = loci.trimmed_at(positions[passage]);
        values.push_back(std::move(value));
      }
    }
  }
  return values;
}

/// The numbers of an eigenvalue that rows of CSV and JSON hold, by their names. Frequencies are in rad/s.
std::vector<std::pair<std::string, double>> numbers_of(const LociFile& loci, const Evaluated& value) {
  const double natural = std::abs(value.s);
  std::vector<std::pair<std::string, double>> numbers{{"real", value.s.real()},
                                                      {"imag", value.s.imag()},
                                                      {"natural_frequency", natural},
                                                      {"damped_frequency", std::abs(value.s.imag())},
                                                      {"damping_ratio", -value.s.real() / natural + 0.0},
                                                      {"log_decrement", log_decrement(value.s)}};
  if (loci.data_errors) {
    numbers.emplace_back("interpolation_error", value.interpolation);
    numbers.emplace_back("digits_error", value.digits);
  }
  for (std::size_t i = 0; i < loci.trimmed.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    numbers.emplace_back(loci.trimmed[i].name, at < value.trimmed.size() ? value.trimmed[at] : NAN);
  }
  return numbers;
}

void print_csv(const LociFile& loci, const std::vector<Evaluated>& values) {
  std::string heading = "parameter,mode";
  for (const auto& [name, number] : numbers_of(loci, {})) heading += "," + name;
  std::printf("%s\n", heading.c_str());
  for (const Evaluated& value : values) {
    std::string line = exact_text(value.p) + "," + value.mode;
    for (const auto& [name, number] : numbers_of(loci, value)) line += "," + exact_text(number);
    std::printf("%s\n", line.c_str());
  }
}

void print_json(const LociFile& loci, const std::vector<Evaluated>& values) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const Evaluated& value : values) {
    nlohmann::ordered_json row{{"parameter", value.p}, {"mode", value.mode}};
    for (const auto& [name, number] : numbers_of(loci, value)) row[name] = number;
    rows.push_back(std::move(row));
  }
  std::printf("%s\n", rows.dump(2).c_str());
}

void print_for_people(const LociFile& loci, const std::vector<Evaluated>& values, const FrequencyUnit& unit) {
  std::vector<std::vector<std::string>> rows{{loci.parameter, "mode", "s, 1/s", "natural, " + unit.name,
                                              "damped, " + unit.name, "damping", "decrement"}};
  if (loci.data_errors) rows[0].emplace_back("error of the data");
  for (const TrimmedParameter& trimmed : loci.trimmed)
    rows[0].push_back(trimmed.name + (trimmed.unit == "1" ? "" : ", " + trimmed.unit));
  for (const Evaluated& value : values) {
    const Complex s = value.is_zero ? Complex(0.0) : without_rounding(value.s, 0.0);
    const double size = std::abs(s);
    const double decrement = log_decrement(s);
    const bool has_damping = std::isfinite(size) && size > 0.0;
    rows.push_back({exact_text(value.p), value.mode, eigenvalue_text(s, 10), rounded(size / unit.factor, 8),
                    rounded(std::abs(s.imag()) / unit.factor, 8),
                    has_damping ? rounded(-100.0 * s.real() / size + 0.0, 6) + " %" : "-",
                    std::isfinite(decrement) ? rounded(decrement + 0.0, 6) : "-"});
    if (loci.data_errors) rows.back().push_back(rounded(value.interpolation + value.digits, 2));
    for (const double trimmed : value.trimmed) rows.back().push_back(rounded(trimmed, 10));
  }
  print_table(rows);
}

int run_eval(const EvalArguments& arguments) {
  const LociFile loci = read_loci(arguments.file);
  const Parameter parameter = parameter_of_file(loci.parameter, loci.parameter_unit);
  // Throws before anything is printed.
  const std::vector<Evaluated> values = all_values(loci, read_values("--at", arguments.at, parameter));
  if (arguments.csv) {
    print_csv(loci, values);
  } else if (arguments.json) {
    print_json(loci, values);
  } else {
    print_for_people(loci, values, frequency_unit(parameter));
  }
  return done;
}

}  // namespace

void add_eval(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<EvalArguments>();
  CLI::App* command =
      program.add_subcommand("eval", "eigenvalues at any parameter of a trace, from its dense output");
  command->add_option("FILE", arguments->file, "loci file")->required();
  command
      ->add_option(
          "--at", arguments->at,
          "parameter values, in the parameter's unit: 40, 10,20, 0:5:40 (begin:step:end), \"100 rpm\"")
      ->required();
  auto* csv = command->add_flag(
      "--csv", arguments->csv,
      "print parameter,mode,real,imag, then natural and damped frequency (rad/s), damping ratio, logarithmic "
      "decrement, errors of the data if there are any, and trimmed parameters");
  command->add_flag("--json", arguments->json, "print a list of objects")->excludes(csv);
  command->footer("Example:\n  eigentrail eval blade.h5 --at 12.5 40 --csv");
  command->callback([arguments, &exit_code] { exit_code = run_eval(*arguments); });
}

}  // namespace eigentrail::app
