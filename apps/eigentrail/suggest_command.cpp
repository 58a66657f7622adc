#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "commands.hpp"
#include "eigentrail/accuracy/suggest.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/units.hpp"
#include "import/text_lines.hpp"
#include "output.hpp"
#include "records.hpp"
#include "samples_info.hpp"
#include "scene_arguments.hpp"

namespace eigentrail::app {
namespace {

struct SuggestArguments : SceneArguments {
  int count = 3;
  bool json = false;
};

/// A scene, or the samples themselves: then a scene that names them and follows all modes on their range.
Scene scene_of(const std::string& path) {
  if (std::filesystem::path(path).extension() != ".h5") return read_scene(path);
  const SampledData data = samples_in(path);
  const std::string file = std::filesystem::path(path).filename().string();
  const std::string parameter = is_identifier(data.parameter_name) ? data.parameter_name : "p";
  const bool known_unit = data.parameter_unit != "1" && unit_factor(data.parameter_unit).has_value();
  std::string text = "[parameters]\n" + parameter + " = { value = " + exact_text(data.values.front()) +
                     (known_unit ? ", unit = \"" + data.parameter_unit + "\"" : "") + " }\n";
  text += "[sampled_family]\nfile = \"" + file + "\"\n[trace]\nparameter = \"" + parameter +
          "\"\nfrom = " + exact_text(data.values.front()) + "\n";
  if (data.count() > 1) text += "to = " + exact_text(data.values.back()) + "\n";
  return parse_scene(text, path);
}

Records records_of(const std::vector<Suggestion>& suggestions) {
  Records records{{"parameter", "error", "real", "imag"}};
  for (const Suggestion& one : suggestions)
    records.rows.push_back({one.p, one.error, one.s.real(), one.s.imag()});
  return records;
}

int run_suggest(const SuggestArguments& arguments) {
  const TraceSetup setup = given_setup(arguments, scene_of(arguments.scene), Purpose::operating_point);
  const std::vector<Suggestion> all = suggest_samples(setup);
  const double tolerance = setup.options.tolerance;
  const auto above = static_cast<std::size_t>(
      std::count_if(all.begin(), all.end(), [&](const Suggestion& one) { return one.error > tolerance; }));
  std::vector<Suggestion> first = all;
  first.resize(std::min(above, static_cast<std::size_t>(arguments.count)));
  if (arguments.json) {
    print(records_of(first), {.json = true});
    return done;
  }
  std::printf("%zu samples, relative error of eigenvalues between them up to %s\n", all.size() + 1,
              rounded(all.empty() ? 0.0 : all.front().error, 2).c_str());
  if (above == 0) {
    std::printf("no more samples are needed for the tolerance %s\n", exact_text(tolerance).c_str());
    return done;
  }
  std::printf("%zu of %zu gaps miss the tolerance %s; compute next:\n", above, all.size(),
              exact_text(tolerance).c_str());
  const std::string& unit = setup.model->description().parameters.at(setup.options.parameter).unit;
  std::vector<std::vector<std::string>> rows{
      {setup.options.parameter + (unit.empty() ? "" : ", " + unit), "error there", "of the eigenvalue"}};
  for (const Suggestion& one : first)
    rows.push_back({exact_text(one.p), rounded(one.error, 2), complex_text(one.s.real(), one.s.imag(), 6)});
  print_table(rows);
  const auto none_wanted =
      std::find_if(first.begin(), first.end(), [](const Suggestion& one) { return !one.note.empty(); });
  if (none_wanted != first.end())
    std::printf("  note  at %s = %s there is %s\n", setup.options.parameter.c_str(),
                exact_text(none_wanted->p).c_str(), none_wanted->note.c_str());
  return done;
}

}  // namespace

void add_suggest(CLI::App& program, int& exit_code) {
  const auto [command, arguments] = add_command<SuggestArguments>(
      program, exit_code, run_suggest, "suggest", "at which values of the parameter to compute more samples");
  command->add_option("FILE", arguments->scene, "scene with a [sampled_family], or its samples (.h5)")
      ->required();
  add_settings(*command, *arguments);
  command->add_option("--count", arguments->count, "largest number of values")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  add_overrides(*command, *arguments, {"from", "to", "tolerance", "modes"});
  command->add_flag("--json", arguments->json, "print a list of objects");
  command->footer(
      "Examples:\n"
      "  eigentrail suggest turbine.toml --modes \"band = ['0.1 Hz', '3 Hz']\"\n"
      "  eigentrail suggest samples.h5 --tolerance 1e-4 --count 1");
}

}  // namespace eigentrail::app
