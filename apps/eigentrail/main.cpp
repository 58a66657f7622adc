// eigentrail: follows the eigenvalues of a constrained mechanical system while a parameter changes.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>

#include "commands.hpp"
#include "core/texts.hpp"
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
  if (given == "import" && argc == 2)
    throw InputError("import: expected a format (" + joined(importers(), ", ", &Importer::format) +
                     ") and files; eigentrail import FORMAT --help says what is read");
}

/// The command that was given, "import matlab" as well as "trace"; the program itself without one.
const CLI::App& command_of(const CLI::App& program) {
  const std::vector<CLI::App*> given = program.get_subcommands();
  return given.empty() ? program : command_of(*given.front());
}

std::string name_of(const CLI::App& command) {
  const CLI::App* above = command.get_parent();
  return above == nullptr ? command.get_name() : name_of(*above) + " " + command.get_name();
}

std::vector<std::string> options_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// Says of an option that a command does not have which one may be meant, or which commands have it.
std::string unknown_option(const CLI::App& program, const CLI::App& command, const std::string& given) {
  const std::string name = given.substr(0, given.find('='));
  const std::string text = "unknown option '" + name + "'; ";
  if (const std::string meant = nearest_name(name, options_of(command)); !meant.empty())
    return text + "did you mean '" + meant + "'?";
  std::string others;
  for (const CLI::App* other : program.get_subcommands([](const CLI::App*) { return true; })) {
    if (other->get_option_no_throw(name) != nullptr)
      others += (others.empty() ? "" : ", ") + other->get_name();
  }
  if (!others.empty()) return text + "it is an option of " + others;
  return text + suggestion(name, options_of(command));
}

/// A line of the help as several, so that none is wider than a terminal: descriptions go on below themselves,
/// commands with an option, behind a backslash. `column`: where descriptions begin.
std::string within_terminal(std::string line, std::size_t column) {
  constexpr std::size_t width = 80;
  const bool is_command = line.starts_with("  eigentrail ");
  const bool is_described =
      line.size() > column && (line.starts_with("  -") || line.compare(column - 2, 2, "  ") == 0);
  const std::size_t own_indent = std::min(line.find_first_not_of(' '), line.size());
  const std::string indent(is_command ? own_indent + 4 : is_described ? column : own_indent, ' ');
  const std::string end = is_command ? " \\" : "";
  std::string lines;
  while (line.size() > width) {
    const std::size_t blank = line.rfind(is_command ? " -" : " ", width - end.size());
    if (blank == std::string::npos || blank <= indent.size()) break;  // a word that is as wide
    lines += line.substr(0, blank) + end + '\n';
    line = indent + line.substr(blank + 1);
  }
  return lines + line;
}

class HelpFormatter : public CLI::Formatter {
  std::string make_help(const CLI::App* command, std::string name, CLI::AppFormatMode mode) const override {
    const std::string help = Formatter::make_help(command, std::move(name), mode);
    return joined(split(help, '\n'), "\n",
                  [this](const std::string& line) { return within_terminal(line, get_column_width()); });
  }
};

/// What is wrong with a command line.
std::string message_of(const CLI::App& program, const CLI::ParseError& error) {
  const CLI::App& command = command_of(program);
  const std::string see = " (see " + name_of(command) + " --help)";
  for (const std::string& left : command.remaining()) {
    if (left.starts_with("--")) return unknown_option(program, command, left) + see;
  }
  return error.what() + see;
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

int run(int argc, char** argv) try {
  use_one_thread_within_blas();
  CLI::App program("Follows the eigenvalues of a constrained mechanical system while a parameter changes.",
                   "eigentrail");
  program.formatter(std::make_shared<HelpFormatter>());
  program.set_version_flag("--version", "eigentrail " + version());
  program.require_subcommand(1);
  program.footer(
      "Exit codes: 0 done; 1 the numbers failed (what was computed is kept); 2 bad input or usage.");
  int exit_code = done;
  for (const auto& add :
       {add_new,    add_import,   add_suggest,  add_explain, add_trace,  add_spectrum, add_linearize,
        add_eval,   add_events,   add_boundary, add_map,     add_sweep,  add_merge,    add_info,
        add_verify, add_accuracy, add_report,   add_plot,    add_export, add_reference})
    add(program, exit_code);
  reject_empty_numbers(program);
  reject_unknown_command(program, argc, argv);
  try {
    program.parse(argc, argv);
    return exit_code;
  } catch (const CLI::Success& help) {
    return program.exit(help);
  } catch (const CLI::ParseError& error) {
    std::fprintf(stderr, "eigentrail: %s\n", printable(message_of(program, error)).c_str());
    return bad_input;
  }
} catch (const std::exception& error) {
  return report_error(error);
}

/// A standard stream that is closed would become the next file that is opened, and get what is printed.
/// Writing to what stands in its place fails.
void occupy_standard_streams() {
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream) {
    if (::fcntl(stream, F_GETFD) >= 0) continue;                              // NOLINT: as POSIX has it
    (void)::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);  // NOLINT: likewise
  }
}

/// The exit code, which is that of failed numbers where not all could be printed. A reader that has left
/// needs no message.
int after_printing(int exit_code) {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return exit_code;
  if (errno != EPIPE)
    std::fprintf(stderr, "eigentrail: not all could be printed%s%s\n", errno == 0 ? "" : ": ",
                 errno == 0 ? "" : std::strerror(errno));
  return exit_code == done ? numbers_failed : exit_code;
}

}  // namespace
}  // namespace eigentrail::app

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on the size of files is met as a full disk is
  eigentrail::app::occupy_standard_streams();
  return eigentrail::app::after_printing(eigentrail::app::run(argc, argv));
}
