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

void print_csv(const LociFile& loci, const std::vector<double>& at) {
  std::printf("parameter,mode,real,imag\n");
  for (const double p : at) {
    const ComplexVector s = loci.eigenvalues_at(p);
    for (Eigen::Index i = 0; i < s.size(); ++i) {
      std::printf("%s,%s,%s,%s\n", exact_text(p).c_str(), loci.modes[static_cast<std::size_t>(i)].c_str(),
                  exact_text(s[i].real()).c_str(), exact_text(s[i].imag()).c_str());
    }
  }
}

void print_json(const LociFile& loci, const std::vector<double>& at) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const double p : at) {
    const ComplexVector s = loci.eigenvalues_at(p);
    for (Eigen::Index i = 0; i < s.size(); ++i) {
      rows.push_back({{"parameter", p},
                      {"mode", loci.modes[static_cast<std::size_t>(i)]},
                      {"real", s[i].real()},
                      {"imag", s[i].imag()}});
    }
  }
  std::printf("%s\n", rows.dump(2).c_str());
}

void print_for_people(const LociFile& loci, const std::vector<double>& at) {
  std::vector<std::vector<std::string>> rows{{loci.parameter, "mode", "s", "frequency", "damping ratio"}};
  for (const double p : at) {
    const ComplexVector s = loci.eigenvalues_at(p);
    for (Eigen::Index i = 0; i < s.size(); ++i) {
      rows.push_back({exact_text(p), loci.modes[static_cast<std::size_t>(i)],
                      complex_text(s[i].real(), s[i].imag(), 10), rounded(std::abs(s[i]), 8),
                      rounded(-s[i].real() / std::abs(s[i]) + 0.0, 6)});
    }
  }
  print_table(rows);
}

int run_eval(const EvalArguments& arguments) {
  const LociFile loci = read_loci(arguments.file);
  for (const double p : arguments.at) (void)loci.eigenvalues_at(p);  // refuse before anything is printed
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
