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

struct EvalArguments {
  std::string file;
  std::vector<double> at;
  bool csv = false;
  bool json = false;
};

/// An eigenvalue at a value of the parameter.
struct Value {
  double p = 0.0;
  std::string mode;
  Complex s;
  /// Bounds of errors that come from the data of the model; NaN if it has none.
  double interpolation = NAN, digits = NAN;
};

/// Each value p in `at`, each passage of the path there, and each mode that exists.
std::vector<Value> all_values(const LociFile& loci, const std::vector<double>& at) {
  std::vector<Value> values;
  for (const double p : at) {
    const std::vector<ComplexVector> passages = loci.eigenvalues_at(p);
    const auto positions = loci.positions(p);
    for (std::size_t passage = 0; passage < passages.size(); ++passage) {
      const ComplexVector& s = passages[passage];
      for (Eigen::Index i = 0; i < s.size(); ++i) {
        if (std::isnan(s[i].real())) continue;
        Value value{p, loci.modes[static_cast<std::size_t>(i)], s[i]};
        if (loci.data_errors && passage < positions.size()) {
          const auto step = static_cast<Eigen::Index>(positions[passage].step);
          value.interpolation = loci.data_errors->interpolation(step, i);
          value.digits = loci.data_errors->digits(step, i);
        }
        values.push_back(std::move(value));
      }
    }
  }
  return values;
}

void print_csv(const LociFile& loci, const std::vector<Value>& values) {
  const bool errors = loci.data_errors.has_value();
  std::printf("parameter,mode,real,imag%s\n", errors ? ",interpolation_error,digits_error" : "");
  for (const Value& value : values) {
    std::printf("%s,%s,%s,%s", exact_text(value.p).c_str(), value.mode.c_str(),
                exact_text(value.s.real()).c_str(), exact_text(value.s.imag()).c_str());
    if (errors)
      std::printf(",%s,%s", exact_text(value.interpolation).c_str(), exact_text(value.digits).c_str());
    std::printf("\n");
  }
}

void print_json(const LociFile& loci, const std::vector<Value>& values) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const Value& value : values) {
    nlohmann::ordered_json row{
        {"parameter", value.p}, {"mode", value.mode}, {"real", value.s.real()}, {"imag", value.s.imag()}};
    if (loci.data_errors) {
      row["interpolation_error"] = value.interpolation;
      row["digits_error"] = value.digits;
    }
    rows.push_back(std::move(row));
  }
  std::printf("%s\n", rows.dump(2).c_str());
}

void print_for_people(const LociFile& loci, const std::vector<Value>& values) {
  std::vector<std::vector<std::string>> rows{{loci.parameter, "mode", "s", "frequency", "damping ratio"}};
  if (loci.data_errors) rows[0].emplace_back("error of the data");
  for (const Value& value : values) {
    const double size = std::abs(value.s);
    rows.push_back({exact_text(value.p), value.mode, complex_text(value.s.real(), value.s.imag(), 10),
                    rounded(size, 8),
                    std::isfinite(size) && size > 0.0 ? rounded(-value.s.real() / size + 0.0, 6) : "-"});
    if (loci.data_errors) rows.back().push_back(rounded(value.interpolation + value.digits, 2));
  }
  print_table(rows);
}

int run_eval(const EvalArguments& arguments) {
  const LociFile loci = read_loci(arguments.file);
  const std::vector<Value> values = all_values(loci, arguments.at);  // throws before anything is printed
  if (arguments.csv) {
    print_csv(loci, values);
  } else if (arguments.json) {
    print_json(loci, values);
  } else {
    print_for_people(loci, values);
  }
  return done;
}

}  // namespace

void add_eval(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<EvalArguments>();
  CLI::App* command =
      program.add_subcommand("eval", "eigenvalues at any parameter of a trace, from its dense output");
  command->add_option("FILE", arguments->file, "loci file")->required();
  command->add_option("--at", arguments->at, "parameter values, in the parameter's unit")->required();
  auto* csv = command->add_flag("--csv", arguments->csv,
                                "print parameter,mode,real,imag; errors of the data follow if there are any");
  command->add_flag("--json", arguments->json, "print a list of objects")->excludes(csv);
  command->footer("Example:\n  eigentrail eval blade.h5 --at 12.5 40 --csv");
  command->callback([arguments, &exit_code] { exit_code = run_eval(*arguments); });
}

}  // namespace eigentrail::app
