#include "trace_end.hpp"

#include <algorithm>

#include "eigentrail/accuracy/shallow_extrema.hpp"
#include "eigentrail/stability/undecided_ranges.hpp"

namespace eigentrail::app {
namespace {

/// The command line flag of an option of the trace: "max_step" becomes --max-step.
std::string flag(std::string key) {
  std::replace(key.begin(), key.end(), '_', '-');
  return "--" + key;
}

}  // namespace

TraceEnd complete_file(const TraceSetup& setup, TraceResult& result, const RecordedPath& path,
                       LociWriter& writer) {
  const EigenvalueAccuracy accuracy{setup.options.tolerance, result.s_ref};
  TraceEnd end{stable_ranges(path, result.events, accuracy),
               data_errors(*setup.model, setup.options, path, result.events)};
  const int shallow = end.errors ? remove_shallow_extrema(path, result.events, *end.errors) : 0;
  if (shallow > 0)
    result.notes.push_back(std::to_string(shallow) + (shallow == 1 ? " extremum" : " extrema") +
                           " of damping ratios left out: no deeper than the errors of the data");
  if (end.errors) end.ranges = with_undecided(end.ranges, path, result.events, *end.errors, accuracy);
  writer.finish(result, end.ranges, end.errors ? &*end.errors : nullptr);
  return end;
}

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

}  // namespace eigentrail::app
