#include <algorithm>
#include <cstdio>

#include "commands.hpp"
#include "core/texts.hpp"
#include "eigentrail/accuracy/verify.hpp"

namespace eigentrail::app {
namespace {

struct VerifyArguments {
  std::string file;
  VerifyOptions options;
};

/// An error message if the text is no valid seed, otherwise empty. CLI11 would convert negative numbers and
/// numbers that are too large to other ones without an error.
std::string seed_fault(const std::string& text) {
  if (parsed_number<std::uint64_t>(text)) return "";
  return "expected a whole number from 0 to 18446744073709551615, found " + text;
}

/// Prints the faults of a comparison: the first ones, and how many there are more.
void print_faults(const std::string& file, const std::vector<std::string>& faults) {
  constexpr std::size_t most = 3;
  for (std::size_t i = 0; i < std::min(most, faults.size()); ++i)
    std::fprintf(stderr, "eigentrail: %s: %s\n", file.c_str(), faults[i].c_str());
  if (faults.size() > most)
    std::fprintf(stderr, "eigentrail: %s: and %zu more of this kind\n", file.c_str(), faults.size() - most);
}

int run_verify(const VerifyArguments& arguments) {
  const VerifyReport report = verify_loci(read_loci(arguments.file), arguments.options);
  for (const Comparison& comparison : report.comparisons) {
    std::printf("  %s\n", comparison.compared.c_str());
    print_faults(arguments.file, comparison.faults);
  }
  if (report.passed()) return done;
  std::fprintf(stderr, "eigentrail: %s: the check failed\n", arguments.file.c_str());
  return numbers_failed;
}

}  // namespace

void add_verify(CLI::App& program, int& exit_code) {
  const auto [command, arguments] = add_command<VerifyArguments>(
      program, exit_code, run_verify, "verify",
      "check all that a loci file says: solved by another method, and traced again");
  command->add_option("FILE", arguments->file, "loci file")->required();
  command
      ->add_option("--samples", arguments->options.samples,
                   "number of random parameters, and of stored points at most; else 100, of a large model 10")
      ->check(CLI::Range(1, 1000000));
  command->add_option("--seed", arguments->options.seed, "seed of their choice")
      ->check(seed_fault)
      ->capture_default_str();
  command->footer(
      "Exits with 1 when something is wrong, and says what and where.\n\n"
      "Example:\n  eigentrail verify blade.h5 --samples 1000");
}

}  // namespace eigentrail::app
