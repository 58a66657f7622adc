// Pictures as SVG, PDF and PNG. The Python package draws them; this command checks the files, finds the
// package and an interpreter, and runs it.
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>

#include "commands.hpp"
#include "core/texts.hpp"
#include "eigentrail/core/errors.hpp"
#include "output_choice.hpp"
#include "scene_arguments.hpp"

extern char** environ;  // NOLINT: of POSIX

namespace eigentrail::app {
namespace {

struct PlotArguments {
  std::vector<std::string> files;
  OutputChoice output;
  std::map<std::string, std::string> options;
  bool log = false;
};

/// A kind of picture by the ending of its name: how its files begin.
struct PictureKind {
  std::string_view ending, beginning;
};
constexpr std::array<PictureKind, 3> picture_kinds{
    {{".svg", "<?xml"}, {".pdf", "%PDF"}, {".png", "\x89PNG"}}};

const PictureKind* kind_of(const std::string& path) {
  const auto* const found = std::ranges::find(picture_kinds, extension_of(path), &PictureKind::ending);
  return found == picture_kinds.end() ? nullptr : found;
}

void check_picture_name(const std::string& output) {
  if (kind_of(output) != nullptr) return;
  const std::string known = joined(picture_kinds, ", ", &PictureKind::ending);
  const std::string page = extension_of(output).starts_with(".htm") ? "; eigentrail report writes pages" : "";
  throw InputError(output + ": expected a name that ends in one of " + known + page);
}

/// Whether a file is a picture that this command has written: of its kind, and with the mark of the program.
bool is_picture(const std::string& path) {
  const PictureKind* kind = kind_of(path);
  std::ifstream file(path, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(file), {}};
  return kind != nullptr && content.starts_with(kind->beginning) &&
         content.find("eigentrail ") != std::string::npos;
}

/// The folder with the package `eigentrail`, beside the program: in the build tree, under the prefix of an
/// installation, or of the Debian package. Empty where there is none.
std::string package_folder() {
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) return "";
  const auto folder = program.parent_path();
  for (const auto& candidate : {folder / ".." / "python", folder / ".." / "share" / "eigentrail" / "python",
                                folder / ".." / "lib" / "python3" / "dist-packages"}) {
    if (std::filesystem::exists(candidate / "eigentrail" / "plot.py", error))
      return std::filesystem::weakly_canonical(candidate, error).string();
  }
  return "";
}

/// Exit code of the script below where a package of Python is missing.
constexpr int package_missing = 97;

/// Draws, or says which package is missing. Python's own messages would be a traceback.
constexpr const char* script = R"(import mmap, sys
try:
    mmap.mmap(-1, 1 << 29).close()
except OSError:
    sys.exit("eigentrail: not enough memory to draw: Python needs 512 MB; allow more by ulimit -v")
try:
    import matplotlib
    from eigentrail import engine, plot
    engine.engine()
except ImportError as error:
    if sys.argv[1] == "last":
        print(f"eigentrail: {sys.executable}: {error}", file=sys.stderr)
    sys.exit(97)
sys.exit(plot.main(sys.argv[2:]))
)";

/// Sets the environment of the processes that this one starts: the package's folder is first on the search
/// path of Python, and nothing is shown in windows.
void prepare_environment() {
  const char* given = std::getenv("PYTHONPATH");
  std::string path = package_folder();
  if (given != nullptr && *given != '\0') path += (path.empty() ? "" : ":") + std::string(given);
  if (!path.empty()) setenv("PYTHONPATH", path.c_str(), 1);
  setenv("MPLBACKEND", "agg", 1);
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> list;
  for (std::string& text : texts) list.push_back(text.data());
  list.push_back(nullptr);
  return list;
}

/// Runs an interpreter. Returns its exit code; empty if it could not be started or was killed.
/// `last`: no other follows, so a missing package is reported.
std::optional<int> run_python(const std::string& interpreter, bool last,
                              const std::vector<std::string>& arguments) {
  std::vector<std::string> words{interpreter, "-c", script, last ? "last" : "other"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  pid_t child = 0;
  if (posix_spawnp(&child, interpreter.c_str(), nullptr, nullptr, pointers(words).data(), environ) != 0)
    return std::nullopt;
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return std::nullopt;
  }
  return WIFEXITED(status) ? std::optional(WEXITSTATUS(status)) : std::nullopt;
}

/// Interpreters to try: the one that the user names, or that of Debian, for which the engine is built, and
/// that of the path.
std::vector<std::string> interpreters() {
  const char* named = std::getenv("EIGENTRAIL_PYTHON");
  if (named != nullptr && *named != '\0') return {named};
  return {"/usr/bin/python3", "python3"};
}

std::vector<std::string> words(const PlotArguments& arguments) {
  std::vector<std::string> list = arguments.files;
  list.push_back("--output=" + arguments.output.path);
  for (const auto& [option, value] : arguments.options) {
    if (!value.empty()) list.push_back(option + "=" + value);
  }
  if (arguments.log) list.emplace_back("--log");
  if (arguments.output.force) list.emplace_back("--force");
  return list;
}

int run_plot(PlotArguments& arguments) {
  OutputChoice& output = arguments.output;
  output.name_like(arguments.files.front(), ".svg");
  check_picture_name(output.path);
  check_new_output(output.path, output.force, {"picture of eigentrail", is_picture});
  prepare_environment();
  const std::vector<std::string> candidates = interpreters();
  for (const std::string& interpreter : candidates) {
    const std::optional<int> code =
        run_python(interpreter, interpreter == candidates.back(), words(arguments));
    if (!code || *code == package_missing || *code == 127) continue;
    if (*code == done && !output.quiet) std::printf("wrote %s\n", output.path.c_str());
    return *code;
  }
  throw InputError(
      "plot draws with Python: expected the Python for which eigentrail was built, with numpy, pandas, "
      "xarray, h5py and matplotlib (apt install python3-matplotlib python3-xarray python3-h5py); "
      "EIGENTRAIL_PYTHON=/path/to/python3 names one; eigentrail report draws without it");
}

}  // namespace

void add_plot(CLI::App& program, int& exit_code) {
  const auto [command, arguments] =
      add_command<PlotArguments>(program, exit_code, run_plot, "plot",
                                 "a picture: Campbell diagram, root locus, map, ... as SVG, PDF, PNG");
  command->add_option("FILE", arguments->files, "a loci file, a map and its boundary, or an accuracy study")
      ->required();
  add_output(*command, arguments->output,
             "picture to write, .svg, .pdf or .png; default: the name of the first file, .svg");
  const auto add = [&, &options = arguments->options](const char* flag, const char* help) {
    return add_text(*command, flag, options, flag, help);
  };
  add("--kind", "what to draw; default by the kind of the file")
      ->check(CLI::IsMember({"campbell", "root-locus", "damping", "shape", "plane", "accuracy"}));
  add("--harmonics", "rays of a Campbell diagram: 1,2; default: those of the scene");
  add("--unit", "of frequencies: rad/s, Hz, rpm, rev/s, deg/s");
  command->add_flag("--log", arguments->log, "logarithmic frequency in a Campbell diagram");
  add("--mode", "mode of a shape: its number or its name; default: 1");
  add("--at", "value of the parameter of a shape; default: the begin of the trace");
  add("--view", "view of a shape: 3D, xy, xz, yz");
  add("--size", "width and height in inches: 9x6");
  add_output_flags(*command, arguments->output, {"replace an existing picture", "", "say nothing"});
  command->footer(
      "Examples:\n  eigentrail plot rotor.h5 -o campbell.svg --harmonics 1,2 --unit Hz\n"
      "  eigentrail plot blade.h5 --kind shape --at 40 --mode 2 -o flap.png\n"
      "  eigentrail plot drag.h5 flutter.h5 -o plane.pdf\n"
      "Python draws: EIGENTRAIL_PYTHON names another interpreter than python3.");
}

}  // namespace eigentrail::app
