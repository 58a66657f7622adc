// eigentrail: follows the eigenvalues of a constrained mechanical system while a parameter changes.
#include <cstdio>
#include <exception>

#include "commands.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/version.hpp"

int main(int argc, char** argv) {
  using namespace eigentrail::app;
  CLI::App program("Follows the eigenvalues of a constrained mechanical system while a parameter changes.",
                   "eigentrail");
  program.set_version_flag("--version", "eigentrail " + eigentrail::version());
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
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? done : bad_input;
  } catch (const eigentrail::InputError& error) {
    std::fprintf(stderr, "eigentrail: %s\n", error.what());
    return bad_input;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "eigentrail: %s\n", error.what());
    return numbers_failed;
  }
}
