// eigentrail: follows the eigenvalues of a constrained mechanical system while a parameter changes.
#include <algorithm>
#include <cstdio>
#include <exception>

#include "commands.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/core/version.hpp"
#include "eigentrail/import/importer.hpp"
#include "output.hpp"

extern "C" void openblas_set_num_threads(int) __attribute__((weak));  // defined only if LAPACK is OpenBLAS

namespace eigentrail::app {
namespace {

/// The program uses its own threads, for modes and for traces. Threads of BLAS would compete with these, and
/// results would differ in the last bits with their number.
void use_one_thread_within_blas() {
  if (openblas_set_num_threads != nullptr) openblas_set_num_threads(1);
}

/// Throws InputError with a suggestion for an unknown command. The message of CLI11 would only be that a
/// command is required.
void reject_unknown_command(const CLI::App& program, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> commands;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
    commands.push_back(command->get_name());
  }
  const std::string given = argv[1];
  if (std::find(commands.begin(), commands.end(), given) == commands.end()) {
    throw InputError("unknown command '" + given + "'; " + suggestion(given, commands));
  }
  if (given == "import" && argc > 2 && argv[2][0] != '-') (void)importer(argv[2]);
  if (given == "import" && argc == 2) {
    std::string formats;
    for (const Importer& one : importers()) formats += (formats.empty() ? "" : ", ") + one.format;
    throw InputError("import: expected a format (" + formats +
                     ") and files; eigentrail import FORMAT --help says what is read");
  }
}

/// Rejects empty texts for numbers, which CLI11 reads as zero.
void reject_empty_numbers(CLI::App& program) {
  const auto check = [](const std::string& text) {
    return text.empty() ? std::string("expected a number, found an empty text") : std::string();
  };
  for (CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
    for (CLI::Option* option : command->get_options()) {
      const std::string type = option->get_type_name();
      const bool number = type.starts_with("FLOAT") || type.starts_with("INT") || type.starts_with("UINT");
      if (number) option->check(check);
    }
  }
}

int run(int argc, char** argv) {
  CLI::App program("Follows the eigenvalues of a constrained mechanical system while a parameter changes.",
                   "eigentrail");
  program.set_version_flag("--version", "eigentrail " + version());
  program.require_subcommand(1);
  program.footer(
      "Exit codes: 0 done; 1 the numbers failed (what was computed is kept); 2 bad input or usage.");
  int exit_code = done;
  add_new(program, exit_code);
  add_import(program, exit_code);
  add_suggest(program, exit_code);
  add_explain(program, exit_code);
  add_trace(program, exit_code);
  add_spectrum(program, exit_code);
  add_eval(program, exit_code);
  add_events(program, exit_code);
  add_boundary(program, exit_code);
  add_map(program, exit_code);
  add_sweep(program, exit_code);
  add_merge(program, exit_code);
  add_info(program, exit_code);
  add_verify(program, exit_code);
  add_accuracy(program, exit_code);
  add_report(program, exit_code);
  add_plot(program, exit_code);
  add_export(program, exit_code);
  add_reference(program, exit_code);
  reject_empty_numbers(program);
  reject_unknown_command(program, argc, argv);
  try {
    program.parse(argc, argv);
    return exit_code;
  } catch (const CLI::Success& help) {
    return program.exit(help);
  } catch (const CLI::ParseError& error) {
    std::fprintf(stderr, "eigentrail: %s (see eigentrail --help)\n", printable(error.what()).c_str());
    return bad_input;
  }
}

}  // namespace
}  // namespace eigentrail::app

int main(int argc, char** argv) try {
  eigentrail::app::use_one_thread_within_blas();
  return eigentrail::app::run(argc, argv);
} catch (const std::exception& error) {
  return eigentrail::app::report_error(error);
}
