#include <charconv>
#include <cstdio>
#include <memory>

#include "commands.hpp"
#include "eigentrail/accuracy/verify.hpp"
#include "eigentrail/core/text.hpp"
#include "output.hpp"

namespace eigentrail::app {
namespace {

struct VerifyArguments {
  std::string file;
  VerifyOptions options;
};

/// An error message if the text is no valid seed, otherwise empty. CLI11 would convert negative numbers and
/// numbers that are too large to other ones without an error.
std::string seed_fault(const std::string& text) {
  std::uint64_t seed = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), seed);
  const bool whole = parsed.ec == std::errc() && parsed.ptr == text.data() + text.size();
  return whole ? "" : "expected a whole number from 0 to 18446744073709551615, found " + text;
}

int run_verify(const VerifyArguments& arguments) {
  const LociFile loci = read_loci(arguments.file);
  const VerifyReport report = verify_loci(loci, arguments.options);
  std::printf("  %d random values of %s, each solved afresh %s", report.samples, loci.parameter.c_str(),
              report.large ? "by shift-invert of the whole model" : "by QZ");
  if (report.refined > 0) std::printf(", at %d of them refined in extended precision", report.refined);
  if (report.unsolved > 0) std::printf("; %d could not be solved", report.unsolved);
  std::printf("\n");
  if (report.worst.mode >= 0) {
    std::printf("  worst discrepancy %s, %s of the tolerance %s: %s at %s = %s\n",
                rounded(report.worst.relative, 3).c_str(),
                rounded(report.worst.relative / report.tolerance, 3).c_str(),
                exact_text(report.tolerance).c_str(),
                loci.modes[static_cast<std::size_t>(report.worst.mode)].c_str(), loci.parameter.c_str(),
                exact_text(report.worst.parameter).c_str());
  }
  if (report.missing > 0) {
    std::printf("  %d eigenvalue%s of the spectrum at %s = %s %s no mode\n", report.missing,
                report.missing == 1 ? "" : "s", loci.parameter.c_str(), exact_text(report.missing_at).c_str(),
                report.missing == 1 ? "has" : "have");
  }
  if (report.passed()) return done;
  std::fprintf(stderr, "eigentrail: %s: the check failed%s\n", arguments.file.c_str(),
               report.other_matrices.empty()
                   ? ""
                   : ("; the stored points do not fit the matrices in " + report.other_matrices +
                      ": has this file changed since the trace? Trace again, or restore it")
                         .c_str());
  return numbers_failed;
}

}  // namespace

void add_verify(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<VerifyArguments>();
  CLI::App* command =
      program.add_subcommand("verify", "independent check of a loci file at random parameters");
  command->add_option("FILE", arguments->file, "loci file")->required();
  command
      ->add_option("--samples", arguments->options.samples,
                   "number of random parameters; else 100, of a large model 10")
      ->check(CLI::Range(1, 1000000));
  command->add_option("--seed", arguments->options.seed, "seed of their choice")
      ->check(seed_fault)
      ->capture_default_str();
  command->footer(
      "Exits with 1 when an eigenvalue is off by more than the file's tolerance, or is missing where all "
      "modes "
      "are followed.\n\n"
      "Example:\n  eigentrail verify blade.h5 --samples 1000");
  command->callback([arguments, &exit_code] { exit_code = run_verify(*arguments); });
}

}  // namespace eigentrail::app
