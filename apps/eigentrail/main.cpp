// eigentrail: follows the eigenvalues of a constrained mechanical system while a parameter changes.
#include <cstdio>
#include <exception>

#include "commands.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/version.hpp"

namespace eigentrail::app {
namespace {

int run(int argc, char** argv) {
  CLI::App program("Follows the eigenvalues of a constrained mechanical system while a parameter changes.",
                   "eigentrail");
  program.set_version_flag("--version", "eigentrail " + version());
  program.require_subcommand(1);
  program.footer(
      "Exit codes: 0 done; 1 the numbers failed (what was computed is kept); 2 bad input or usage.");
  int exit_code = done;
  add_trace(program, exit_code);
  add_eval(program, exit_code);
  add_info(program, exit_code);
  add_explain(program, exit_code);
  try {
    program.parse(argc, argv);
    return exit_code;
  } catch (const CLI::Success& help) {
    return program.exit(help);
  } catch (const CLI::ParseError& error) {
    std::fprintf(stderr, "eigentrail: %s (see eigentrail --help)\n", error.what());
    return bad_input;
  }
}

}  // namespace
}  // namespace eigentrail::app

int main(int argc, char** argv) try {
  return eigentrail::app::run(argc, argv);
} catch (const eigentrail::InputError& error) {
  std::fprintf(stderr, "eigentrail: %s\n", error.what());
  return eigentrail::app::bad_input;
} catch (const std::exception& error) {
  std::fprintf(stderr, "eigentrail: %s\n", error.what());
  return eigentrail::app::numbers_failed;
}
