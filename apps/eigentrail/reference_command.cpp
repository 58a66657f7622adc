#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

#include "commands.hpp"
#include "core/texts.hpp"
#include "eigentrail/continuation/event_kinds.hpp"
#include "eigentrail/continuation/trace_options.hpp"
#include "eigentrail/model/build.hpp"
#include "output.hpp"

namespace eigentrail::app {
namespace {

struct ReferenceArguments {
  std::vector<std::string> tables;
  bool markdown = false;
};

/// The heading of a table in TOML: [name] for tables that a scene may have only once, otherwise [[name]].
std::string heading(const std::string& name) {
  static const std::set<std::string> single = {"trace",   "events", "modes",         "frame",
                                               "gravity", "rotor",  "matrix_family", "sampled_family"};
  return single.contains(name) ? "[" + name + "]" : "[[" + name + "]]";
}

constexpr const char* page_heading =
    "# Tables of a scene\n\n"
    "Every table that a scene may have, with its keys. "
    "Written by `eigentrail reference --markdown` from what the program reads; "
    "[the scene reference](scene.md) explains parameters, places and directions, and families of matrices. "
    "Tables with `[[ ]]` may stand several times and have a `name`.\n";

EffectHelp trace_help() {
  EffectHelp help{"trace", "what is followed, and how accurately; each key is an option of `trace`, too", {}};
  const TraceOptions defaults;
  const OptionTexts texts = describe_options(defaults);
  const std::map<std::string, std::string> otherwise(texts.begin(), texts.end());
  TraceOptions::fields(defaults, [&](const std::string& key, const char* text, const auto&) {
    const bool required = key == "parameter" || key == "from" || key == "to";
    help.fields.push_back({key, "", text, required ? "" : otherwise.at(key)});
  });
  return help;
}

void add_operating_ranges(EffectHelp& help) {
  help.fields.push_back({"operating_range", "[from, to] or list",
                         "speeds between which the machine runs, in the unit of the traced parameter",
                         "none"});
  help.fields.push_back({"separation_margin", "fraction",
                         "how far critical speeds must stay away, of the nearer end of the range",
                         "by API 684"});
}

EffectHelp events_help() {
  EffectHelp help{"events", "what counts as a special point beside stability and collisions", {}};
  for (const EventKindInfo& kind : event_kinds()) {
    const EventRequest& request = kind.request;
    if (request.key.empty()) continue;
    help.fields.push_back({std::string(request.key), "number or list", std::string(request.help), "none"});
    if (request.of_excitation)
      help.fields.push_back({"excitation", "rad/s", "the excitation frequency",
                             "the traced parameter, or the speed of the shafts"});
    if (request.of_excitation) add_operating_ranges(help);
  }
  help.fields.push_back({"extrema", "true or false", "locate extrema of damping ratios", "false"});
  help.fields.push_back({"veerings", "true or false",
                         "locate veerings; without them, traces of many close modes take a third less time",
                         "true"});
  return help;
}

EffectHelp modes_help() {
  return {
      "modes",
      "names of modes in place of those that the program finds",
      {{"names", "table",
        "per name a frequency (\"1.2 Hz\"), a part of a mode's own name (\"blade lag\"), or coordinates and "
        "amounts of a shape",
        "none"}}};
}

/// A scene has one of the families, and no elements beside it.
EffectHelp matrix_family_help() {
  const std::string powers = "list of matrices";
  return {
      "matrix_family",
      "M x'' + C x' + K x = 0 or E x' = A x, polynomials of the parameter that [trace] names",
      {{"M", powers, "mass, by powers of the parameter, lowest first; entries may be expressions", "none"},
       {"C", powers, "damping and gyroscopic matrix", "none"},
       {"K", powers, "stiffness; required with M or C", "none"},
       {"A", powers, "beside K: constraints A x = 0; else the state matrix of E x' = A x", "none"},
       {"E", powers, "beside A", "identity"},
       {"state_names", "texts", "names of the rows, each once", "x1, x2, ..."},
       {"file", "text",
        "HDF5 file with datasets /M/0, /K/0, /K/1, ... or /E/0, /A/0, ..., dense or sparse, in place of the "
        "keys above",
        "none"},
       {"factors", "table of expressions",
        "factors of the file's matrices with names: { bearing = \"k\" } for /K/bearing", "none"}}};
}

EffectHelp sampled_family_help() {
  return {"sampled_family",
          "matrices at single values of the parameter that [trace] names, interpolated between them",
          {{"file", "text", "HDF5 file with the samples, in the scene's folder or below it"},
           {"kinks", "list of numbers", "values, of samples, at which the matrices have a kink", "none"},
           {"digits", "1 to 17", "significant digits of the entries", "the file's"},
           {"degree", "1 to 15", "degree of the interpolant; without poles", "chosen"}}};
}

std::vector<EffectHelp> whole_reference() {
  std::vector<EffectHelp> all = {trace_help(), events_help(), modes_help(), matrix_family_help(),
                                 sampled_family_help()};
  for (EffectHelp& table : rotor_reference()) all.push_back(std::move(table));
  for (EffectHelp& effect : effect_reference()) all.push_back(std::move(effect));
  return all;
}

/// A sentence on the unknowns that the elements of a table have of their own.
std::string states_in_words(const EffectHelp& table, const std::string& quote) {
  std::string text;
  for (const FieldHelp& state : table.states)
    text += (text.empty() ? "Each has a state of its own: " : "; ") + quote + state.key + quote + " (" +
            state.unit + "), " + state.help;
  return text + ".";
}

void print_text(const EffectHelp& table) {
  std::printf("%s  %s\n", heading(table.name).c_str(), table.description.c_str());
  std::vector<std::vector<std::string>> rows;
  for (const FieldHelp& field : table.fields) {
    const std::string otherwise = field.otherwise.empty() ? "required" : "default: " + field.otherwise;
    rows.push_back({"  " + field.key, field.unit, otherwise, field.help});
  }
  print_table(rows);
  if (!table.states.empty()) std::printf("  %s\n", states_in_words(table, "").c_str());
}

std::string cell(const std::string& text) {
  return replaced_all(text, "|", "\\|");
}

void print_markdown(const EffectHelp& table) {
  std::printf("\n## %s\n\n`%s`: %s.\n\n", table.name.c_str(), heading(table.name).c_str(),
              cell(table.description).c_str());
  std::printf("| key | value | meaning | default |\n|---|---|---|---|\n");
  for (const FieldHelp& field : table.fields) {
    std::printf("| `%s` | %s | %s | %s |\n", field.key.c_str(), cell(field.unit).c_str(),
                cell(field.help).c_str(),
                field.otherwise.empty() ? "required" : cell(field.otherwise).c_str());
  }
  if (!table.states.empty()) std::printf("\n%s\n", states_in_words(table, "`").c_str());
}

int run_reference(const ReferenceArguments& arguments) {
  const std::vector<EffectHelp> all = whole_reference();
  std::vector<std::string> names;
  for (const EffectHelp& table : all) names.push_back(table.name);
  for (const std::string& name : arguments.tables) {
    if (std::ranges::find(names, name) == names.end())
      throw InputError("no table of a scene is called '" + name + "'; " + suggestion(name, names));
  }
  if (arguments.markdown) std::printf("%s", page_heading);
  for (const EffectHelp& table : all) {
    const bool wanted =
        arguments.tables.empty() || std::ranges::find(arguments.tables, table.name) != arguments.tables.end();
    if (wanted) arguments.markdown ? print_markdown(table) : print_text(table);
  }
  return done;
}

}  // namespace

void add_reference(CLI::App& program, int& exit_code) {
  const auto [command, arguments] =
      add_command<ReferenceArguments>(program, exit_code, run_reference, "reference",
                                      "every table that a scene may have, with its keys and units");
  command->add_option("TABLE", arguments->tables, "tables to show, such as spring; default: all");
  command->add_flag("--markdown", arguments->markdown, "as the documentation has it");
  command->footer("Examples:\n  eigentrail reference\n  eigentrail reference spring damper");
}

}  // namespace eigentrail::app
