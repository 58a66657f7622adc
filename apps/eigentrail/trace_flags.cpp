#include "trace_flags.hpp"

#include <algorithm>

#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail::app {
namespace {

/// The command line flag of an option of the trace: "max_step" becomes --max-step.
std::string flag(std::string key) {
  std::replace(key.begin(), key.end(), '_', '-');
  return "--" + key;
}

}  // namespace

void add_trace_options(CLI::App& command, std::map<std::string, std::string>& texts) {
  const TraceOptions defaults;
  TraceOptions::fields(defaults, [&](const char* key, const char* help, const auto&) {
    const std::string name = key;
    if (name == "certify") return;  // a flag, below
    command.add_option_function<std::string>(
        flag(name), [&texts, name](const std::string& text) { texts[name] = text; },
        std::string(help) + " (overrides the scene)");
  });
  command.add_flag_callback(
      "--no-certify", [&texts] { texts["certify"] = "false"; },
      "no certificate at every step that no modes were exchanged: faster, and compares shapes only");
}

void add_no_lock(CLI::App& command, SaveOptions& saving) {
  command.add_flag_callback(
      "--no-lock", [&saving] { saving.lock = false; },
      "write without a lock against other processes, on file systems that offer none");
}

}  // namespace eigentrail::app
