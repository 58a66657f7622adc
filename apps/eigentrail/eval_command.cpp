#include <cmath>
#include <cstdio>

#include "commands.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/store/loci_file.hpp"
#include "output.hpp"
#include "output_choice.hpp"
#include "scene/frequency_unit.hpp"
#include "trace_summary.hpp"
#include "values.hpp"

namespace eigentrail::app {
namespace {

struct EvalArguments {
  std::string file;
  std::vector<std::string> at;
  PrintedFormat format;
};

/// An eigenvalue at a value of the parameter.
struct Evaluated {
  double p = 0.0;
  std::string mode;
  Complex s;
  Complex shown;  ///< the same without rounding
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
      const ComplexVector shown = passage < positions.size() ? loci.shown_at(positions[passage]) : s;
      for (Eigen::Index i = 0; i < s.size(); ++i) {
        if (std::isnan(s[i].real())) continue;
        const auto mode = static_cast<std::size_t>(i);
        Evaluated value{p, loci.modes[mode], s[i], permanence[mode] == Permanence::zero ? 0.0 : shown[i]};
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

/// What CSV and JSON hold. Frequencies are in rad/s.
Records records_of(const LociFile& loci, const std::vector<Evaluated>& values) {
  Records records{{"parameter", "mode", "real", "imag", "natural_frequency", "damped_frequency",
                   "damping_ratio", "log_decrement"}};
  if (loci.data_errors)
    records.columns.insert(records.columns.end(), {"interpolation_error", "digits_error"});
  for (const TrimmedParameter& trimmed : loci.trimmed) records.columns.push_back(trimmed.name);
  for (const Evaluated& value : values) {
    const double natural = std::abs(value.s);
    records.rows.push_back({value.p, value.mode, value.s.real(), value.s.imag(), natural,
                            std::abs(value.s.imag()), -value.s.real() / natural + 0.0,
                            log_decrement(value.s)});
    std::vector<Cell>& row = records.rows.back();
    if (loci.data_errors) row.insert(row.end(), {value.interpolation, value.digits});
    row.insert(row.end(), value.trimmed.begin(), value.trimmed.end());
    row.resize(records.columns.size(), NAN);
  }
  return records;
}

void print_for_people(const LociFile& loci, const std::vector<Evaluated>& values, const FrequencyUnit& unit) {
  std::vector<std::vector<std::string>> rows{{loci.parameter, "mode", "s, 1/s", "natural, " + unit.name,
                                              "damped, " + unit.name, "damping", "decrement"}};
  if (loci.data_errors) rows[0].emplace_back("error of the data");
  for (const TrimmedParameter& trimmed : loci.trimmed)
    rows[0].push_back(trimmed.name + (trimmed.unit == "1" ? "" : ", " + trimmed.unit));
  for (const Evaluated& value : values) {
    const Complex s = without_rounding(value.shown, 0.0);
    const double size = std::abs(s);
    const double decrement = log_decrement(s);
    const bool has_damping = std::isfinite(size) && size > 0.0;
    rows.push_back({exact_text(value.p), value.mode, eigenvalue_text(s, 10), rounded(size / unit.factor, 8),
                    rounded(std::abs(s.imag()) / unit.factor, 8),
                    has_damping ? percent(-s.real() / size, 6) : "-",
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
  if (arguments.format) {
    print(records_of(loci, values), arguments.format);
  } else {
    print_for_people(loci, values, frequency_unit(parameter.unit));
  }
  return done;
}

}  // namespace

void add_eval(CLI::App& program, int& exit_code) {
  const auto [command, arguments] = add_command<EvalArguments>(
      program, exit_code, run_eval, "eval", "eigenvalues at any parameter of a trace, from its dense output");
  command->add_option("FILE", arguments->file, "loci file")->required();
  command
      ->add_option(
          "--at", arguments->at,
          "parameter values, in the parameter's unit: 40, 10,20, 0:5:40 (begin:step:end), \"100 rpm\"")
      ->required();
  add_formats(
      *command, arguments->format,
      "print parameter,mode,real,imag, then natural and damped frequency (rad/s), damping ratio, logarithmic "
      "decrement, errors of the data if there are any, and trimmed parameters");
  command->footer("Example:\n  eigentrail eval blade.h5 --at 12.5 40 --csv");
}

}  // namespace eigentrail::app
