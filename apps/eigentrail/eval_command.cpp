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

/// Calls visit(p, mode, s) for each value p in `at`, each passage of the path there, and each mode that
/// exists.
template <class Visit>
void for_each_value(const LociFile& loci, const std::vector<double>& at, Visit&& visit) {
  for (const double p : at) {
    for (const ComplexVector& s : loci.eigenvalues_at(p)) {
      for (Eigen::Index i = 0; i < s.size(); ++i) {
        if (!std::isnan(s[i].real())) visit(p, loci.modes[static_cast<std::size_t>(i)], s[i]);
      }
    }
  }
}

void print_csv(const LociFile& loci, const std::vector<double>& at) {
  std::printf("parameter,mode,real,imag\n");
  for_each_value(loci, at, [](double p, const std::string& mode, Complex s) {
    std::printf("%s,%s,%s,%s\n", exact_text(p).c_str(), mode.c_str(), exact_text(s.real()).c_str(),
                exact_text(s.imag()).c_str());
  });
}

void print_json(const LociFile& loci, const std::vector<double>& at) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for_each_value(loci, at, [&rows](double p, const std::string& mode, Complex s) {
    rows.push_back({{"parameter", p}, {"mode", mode}, {"real", s.real()}, {"imag", s.imag()}});
  });
  std::printf("%s\n", rows.dump(2).c_str());
}

void print_for_people(const LociFile& loci, const std::vector<double>& at) {
  std::vector<std::vector<std::string>> rows{{loci.parameter, "mode", "s", "frequency", "damping ratio"}};
  for_each_value(loci, at, [&rows](double p, const std::string& mode, Complex s) {
    rows.push_back({exact_text(p), mode, complex_text(s.real(), s.imag(), 10), rounded(std::abs(s), 8),
                    std::isfinite(std::abs(s)) ? rounded(-s.real() / std::abs(s) + 0.0, 6) : "-"});
  });
  print_table(rows);
}

int run_eval(const EvalArguments& arguments) {
  const LociFile loci = read_loci(arguments.file);
  for (const double p : arguments.at) (void)loci.eigenvalues_at(p);  // throw before anything is printed
  if (arguments.csv) {
    print_csv(loci, arguments.at);
  } else if (arguments.json) {
    print_json(loci, arguments.at);
  } else {
    print_for_people(loci, arguments.at);
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
  auto* csv = command->add_flag("--csv", arguments->csv, "print parameter,mode,real,imag");
  command->add_flag("--json", arguments->json, "print a list of objects")->excludes(csv);
  command->footer("Example:\n  eigentrail eval blade.h5 --at 12.5 40 --csv");
  command->callback([arguments, &exit_code] { exit_code = run_eval(*arguments); });
}

}  // namespace eigentrail::app
