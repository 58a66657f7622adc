#include "eigentrail/continuation/trace_options.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

#include "continuation/trace/mode_options.hpp"
#include "core/texts.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/measure.hpp"
#include "eigentrail/scene/traced_parameter.hpp"

namespace eigentrail {
namespace {

/// Number of equidistant points of the range, ends included, at which the model is checked before the trace
/// (masses, lengths, direction of gravity). The interval is 1/32 of the range. With fewer points a fault in
/// the middle of the range may end the trace instead; more points make the start slower.
constexpr std::size_t checked_points = 33;
/// Largest magnitude of a whole number that an option may have: it fits into an int (2^31 - 1 = 2.1e9).
constexpr double largest_whole_number = 1e9;
/// Bounds of the tolerance. Rounding of an eigenvalue leaves no accuracy below about 1e-13. Above 0.1 the
/// error would be of the size of the distances between modes.
constexpr double least_tolerance = 1e-13;
constexpr double largest_tolerance = 0.1;

/// Reads the options from a table of texts and numbers: the [trace] table merged with the command line.
class OptionReader {
 public:
  OptionReader(const Scene& scene, TableReader& table) : scene_(scene), table_(table) {}

  template <class Value>
  void operator()(const char* key, const char*, Value& value) {
    if (table_.has(key)) read(key, value);
  }

 private:
  void read(const char* key, std::string& value) { value = table_.text(key); }
  void read(const char* key, bool& value) { value = table_.flag(key); }
  void read(const char* key, double& value) { value = number(key); }
  void read(const char* key, int& value) { value = whole_number(key); }
  void read(const char* key, std::optional<double>& value) { value = number(key); }
  void read(const char* key, std::optional<int>& value) { value = whole_number_or(key, "auto"); }
  void read(const char* key, ModeChoice& value) {
    value =
        table_.is_table(key) ? read_mode_choice(table_.table(key)) : ModeChoice{whole_number_or(key, "all")};
  }
  /// A whole number, or a text with several: "1, 2".
  void read(const char* key, std::vector<int>& value) {
    if (!is_text(key)) {
      value = {whole_number(key)};
      return;
    }
    value.clear();
    std::istringstream text(table_.text(key));
    for (std::string item; std::getline(text, item, ',');) {
      std::istringstream digits(item);
      int number = 0;
      if (!(digits >> number) || !(digits >> std::ws).eof())
        table_.fail(key, "expected whole numbers separated by commas, found \"" + table_.text(key) + "\"");
      value.push_back(number);
    }
  }
  /// Names separated by commas; "none" is the empty list.
  void read(const char* key, std::vector<std::string>& value) {
    value.clear();
    std::istringstream text(table_.text(key));
    for (std::string item; std::getline(text, item, ',');) {
      const std::string_view name = trimmed(item, " ");
      if (name.empty()) table_.fail(key, "expected names separated by commas");
      value.emplace_back(name);
    }
    if (value == std::vector<std::string>{"none"}) value.clear();
  }

  bool is_text(const char* key) {
    try {
      return !table_.text(key).empty();
    } catch (const InputError&) {
      return false;
    }
  }

  /// A whole number; empty for the word that stands for its absence. Reports other words that are no
  /// parameters.
  std::optional<int> whole_number_or(const char* key, const std::string& word_for_absent) {
    if (!is_text(key)) return whole_number(key);
    const std::string text = table_.text(key);
    if (text == word_for_absent) return std::nullopt;
    const bool word = std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isalpha(c); });
    if (word && !scene_.parameters.index(text))
      table_.fail(key, "expected a whole number or \"" + word_for_absent + "\", found \"" + text + "\"");
    return whole_number(key);
  }

  /// A plain number is in the parameter's unit, a text may have a unit of its own ("100 Hz"); an expression
  /// of parameters is an SI value.
  double number(const char* key) {
    const Parameter* traced = in_parameter_unit(key);
    if (traced != nullptr && is_text(key)) {
      const auto measure = parse_measure(table_.text(key));
      const UnitValue found = measure ? value_in_unit_of(*traced, *measure) : UnitValue{};
      if (!found.fault.empty()) table_.fail(key, found.fault);
      if (measure && std::isfinite(found.value)) return found.value;
    }
    const bool has_unit = traced != nullptr && traced->dimension;
    const Expression expression = table_.expression(key, has_unit ? WantedUnit(traced->unit) : WantedUnit());
    const double value = this->value(expression, key);
    if (!std::isfinite(value)) table_.fail(key, "is not a finite number");
    return value;
  }

  double value(const Expression& expression, const char* key) {
    if (expression.is_constant()) return expression.evaluate(std::span<const double>());
    Vector si = scene_.parameters.declared_values();
    scene_.parameters.to_si(std::span<double>(si.data(), static_cast<std::size_t>(si.size())));
    const double value =
        expression.evaluate(std::span<const double>(si.data(), static_cast<std::size_t>(si.size())));
    const Parameter* traced = in_parameter_unit(key);
    return traced != nullptr ? value / traced->factor : value;
  }

  /// The traced parameter, if a key is in its unit.
  const Parameter* in_parameter_unit(const std::string& key) {
    const bool of_range = std::set<std::string_view>{"from", "to", "first_step", "max_step"}.contains(key);
    if (!of_range || !table_.has("parameter")) return nullptr;
    const auto traced = scene_.parameters.index(table_.text("parameter"));
    return traced ? &scene_.parameters[static_cast<std::size_t>(*traced)] : nullptr;
  }

  int whole_number(const char* key) {
    const double value = number(key);
    if (value != std::floor(value) || std::abs(value) > largest_whole_number) {
      table_.fail(key, "expected a whole number, found " + exact_text(value));
    }
    return static_cast<int>(value);
  }

  const Scene& scene_;
  TableReader& table_;
};

/// "count = 12, near = '3 Hz'", as on the command line, as a table.
Table table_of(const std::string& key, const std::string& text) {
  Table parsed;
  try {
    parsed = parse_toml(key + " = {" + text + "}", "--" + key);
  } catch (const InputError&) {
    throw InputError("--" + key + " \"" + text +
                     "\": expected keys with values, such as \"count = 12, band = ['0.05 Hz', '3 Hz']\"");
  }
  Table table = std::get<Table>(parsed.entries.front().second.data);
  table.where = given_as_option;
  for (auto& [name, value] : table.entries) value.where = given_as_option;
  return table;
}

/// The [trace] table in which values from the command line replace those of the same key. The range in it is
/// that of its own parameter, not of another one. Texts of the command line that are numbers become numbers,
/// "true" and "false" become flags, a choice of modes a table.
Table merged_table(const Scene& scene, const OptionTexts& overrides) {
  const auto found = tables(scene, "trace");
  if (found.size() > 1)
    throw scene_error(scene, found[1]->where, "[trace]: a scene has one of these at most");
  Table merged;
  if (!found.empty()) merged = *found[0];
  const auto leave_out = [&merged](const std::string& key) {
    std::erase_if(merged.entries, [&key](const auto& entry) { return entry.first == key; });
  };
  const Value* own = merged.find("parameter");
  const auto other = std::ranges::find(overrides, "parameter", &OptionTexts::value_type::first);
  const auto* name = own == nullptr ? nullptr : std::get_if<std::string>(&own->data);
  if (name != nullptr && other != overrides.end() && *name != other->second &&
      scene.parameters.index(other->second)) {
    leave_out("from");
    leave_out("to");
  }
  for (const auto& option : overrides) {
    const std::string& text = option.second;
    Value value{text, given_as_option};
    if (const auto number = parsed_number<double>(text)) value.data = *number;
    if (text == "true" || text == "false") value.data = text == "true";
    const bool is_choice = option.first == "modes" && text.find('=') != std::string::npos;
    if (is_choice) value.data = table_of(option.first, text);
    leave_out(option.first);
    merged.entries.emplace_back(option.first, std::move(value));
  }
  return merged;
}

}  // namespace

std::vector<OptionFault> find_faults(const TraceOptions& options, const Parameters& parameters) {
  std::vector<OptionFault> faults;
  const auto require = [&faults](bool holds, const char* key, const std::string& message) {
    if (!holds) faults.push_back({key, message});
  };
  const auto positive = [](const std::optional<double>& value) {
    return !value || (*value > 0.0 && std::isfinite(*value));
  };
  const std::string& name = options.parameter;
  const auto index = parameters.index(name);
  if (name.empty()) {
    require(false, "parameter", "is missing; name the parameter to trace");
  } else if (!index) {
    require(false, "parameter",
            "no parameter is called '" + name + "'; " + suggestion(name, parameters.names()));
  } else {
    require(!parameters.at(name).definition, "parameter",
            "'" + name + "' is defined by an expression; trace one of the parameters in it");
  }
  require(std::isfinite(options.from), "from", "is not a finite number");
  require(std::isfinite(options.to), "to", "is not a finite number");
  require(options.from != options.to, "to",
          "equals from (" + exact_text(options.from) + "): the range is empty");
  require(options.tolerance >= least_tolerance && options.tolerance <= largest_tolerance, "tolerance",
          "must lie between 1e-13 and 0.1; found " + exact_text(options.tolerance));
  require(options.modes.count.value_or(1) >= 1, "modes", "must be at least 1, or \"all\"");
  require(options.constant_modes == "list" || options.constant_modes == "follow", "constant_modes",
          "must be \"list\" or \"follow\"; found \"" + options.constant_modes + "\"");
  require(!options.order || (*options.order >= 1 && *options.order < max_order), "order",
          "must lie between 1 and " + std::to_string(max_order - 1) + ", or be \"auto\"");
  require(positive(options.reference), "reference", "must be positive");
  require(positive(options.first_step), "first_step", "must be positive");
  require(positive(options.max_step), "max_step", "must be positive");
  require(options.max_nodes >= 2, "max_nodes", "must be at least 2");
  for (const auto& [other, value] : options.values) {
    const bool free = parameters.index(other) && !parameters.at(other).definition && other != name;
    require(free, "values", "'" + other + "' is no parameter whose value can be given");
    require(std::isfinite(value), "values", "the value of '" + other + "' is not a finite number");
  }
  for (const int branch : options.branch)
    require(branch >= 1 && branch <= 3, "branch", "must be 1, 2 or 3; found " + std::to_string(branch));
  return faults;
}

namespace {

/// Checks that the excitation frequency is finite at both ends of the range; throws if not.
void check_excitation(const Scene& scene, const TraceOptions& options) {
  const auto traced = scene.parameters.index(options.parameter);
  if (!options.events.excitation || !traced) return;
  for (const double p : {options.from, options.to}) {
    Vector values = scene.parameters.declared_values();
    values[*traced] = p;
    const std::span<double> si(values.data(), static_cast<std::size_t>(values.size()));
    scene.parameters.to_si(si);
    const double frequency = options.events.excitation->evaluate(std::span<const double>(si));
    if (std::isfinite(frequency)) continue;
    const Value* given = tables(scene, "events").front()->find("excitation");
    throw scene_error(scene, given == nullptr ? SourceLocation{} : given->where,
                      "[events] excitation: is not a finite number; found " + exact_text(frequency) +
                          " where " + options.parameter + " = " + exact_text(p));
  }
}

}  // namespace

TraceOptions read_trace_options(const Scene& scene, const OptionTexts& overrides, std::set<int>& used,
                                Purpose purpose) {
  const Table merged = merged_table(scene, overrides);
  TableReader table(scene, merged, "[trace]", used);
  TraceOptions options;
  OptionReader reader(scene, table);
  TraceOptions::fields(options, reader);
  options.events = read_event_options(scene, options.parameter, used);
  options.mode_names = read_mode_names(scene, used);
  if (const auto& band = options.modes.band) {
    for (const double edge : {band->lowest, band->highest}) {
      if (edge > 0.0) options.events.wanted.push_back({EventKind::band_edge, edge});
    }
  }
  // One value of the parameter is enough to look at single values: at least that of the parameter itself.
  const bool range = purpose != Purpose::operating_point;
  const auto traced = scene.parameters.index(options.parameter);
  if (!range && !table.has("from") && traced) options.from = scene.parameters.declared_values()[*traced];
  if (!range && !table.has("to")) options.to = options.from;
  for (const std::string key : {"from", "to"}) {
    if (table.has(key) || !range) continue;
    const bool samples = scene.root.find("sampled_family") != nullptr;
    table.fail(key, "is missing; expected a number, here or as --" + key +
                        (samples ? "; of a single sample, 'eigentrail spectrum' shows the eigenvalues" : ""));
  }
  table.finish();
  std::vector<OptionFault> faults = find_faults(options, scene.parameters);
  if (!range) std::erase_if(faults, [](const OptionFault& fault) { return fault.key == std::string("to"); });
  if (faults.empty()) {
    check_excitation(scene, options);
    return options;
  }
  std::string message = faults.front().message;
  for (std::size_t i = 1; i < faults.size(); ++i) message += "; " + faults[i].key + ": " + faults[i].message;
  table.fail(faults.front().key, message);
}

TraceSetup prepare_trace(Scene scene, const OptionTexts& overrides, Purpose purpose) {
  check_top_level(scene);
  TraceSetup setup{std::move(scene), {}, nullptr};
  std::set<int> used;
  setup.options = read_trace_options(setup.scene, overrides, used, purpose);
  // The model itself must depend on the traced parameter, unless only single values are looked at.
  if (purpose == Purpose::operating_point) {
    used.insert(setup.traced());
  } else {
    used.erase(setup.traced());
  }
  const TraceOptions& options = setup.options;
  std::vector<Vector> points(checked_points, setup.scene.parameters.declared_values());
  points[0][setup.traced()] = options.from;
  points[1][setup.traced()] = options.to;
  for (std::size_t i = 2; i < checked_points; ++i) {
    const double share = static_cast<double>(i - 1) / (checked_points - 1);
    points[i][setup.traced()] = (1.0 - share) * options.from + share * options.to;
  }
  setup.model = build_model(setup.scene, {points, used, options.without, purpose == Purpose::strengths});
  if (is_trimmed(setup.scene, options.parameter))
    throw InputError(setup.scene.path + ": [trace] parameter: '" + options.parameter +
                     "' is the unknown of a [[trim]]; trace another parameter, or leave out the trim");
  for (const int unused : setup.model->description().unused_parameters) {
    if (unused == setup.traced() && purpose != Purpose::operating_point)
      throw unused_error(setup.scene, unused);
  }
  return setup;
}

TraceSetup prepare_trace(Scene scene, const OptionTexts& overrides, const ModelMaker& make_model) {
  TraceSetup setup{std::move(scene), {}, nullptr};
  std::set<int> used;
  setup.options = read_trace_options(setup.scene, overrides, used);
  setup.model = make_model(setup.scene.parameters, setup.options);
  return setup;
}

OptionTexts describe_options(const TraceOptions& options) {
  OptionTexts texts;
  const auto describe = [&texts](const char* key, const char*, const auto& value) {
    using T = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<T, std::string>) {
      texts.emplace_back(key, value);
    } else if constexpr (std::is_same_v<T, bool>) {
      texts.emplace_back(key, value ? "true" : "false");
    } else if constexpr (std::is_same_v<T, std::vector<int>>) {
      texts.emplace_back(
          key, value.empty() ? "auto" : joined(value, ", ", [](int item) { return std::to_string(item); }));
    } else if constexpr (std::is_same_v<T, std::vector<std::string>>) {
      texts.emplace_back(key, value.empty() ? "none" : joined(value));
    } else if constexpr (std::is_same_v<T, std::optional<int>>) {
      texts.emplace_back(key, value ? std::to_string(*value) : "auto");
    } else if constexpr (std::is_same_v<T, ModeChoice>) {
      texts.emplace_back(key, text_of(value));
    } else if constexpr (std::is_same_v<T, std::optional<double>>) {
      texts.emplace_back(key, value ? exact_text(*value) : "auto");
    } else if constexpr (std::is_same_v<T, int>) {
      texts.emplace_back(key, std::to_string(value));
    } else {
      texts.emplace_back(key, exact_text(value));
    }
  };
  TraceOptions::fields(options, describe);
  return texts;
}

}  // namespace eigentrail
