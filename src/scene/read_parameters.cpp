#include "scene/read_parameters.hpp"

#include <algorithm>
#include <cmath>

#include "eigentrail/scene/expression_dimension.hpp"
#include "eigentrail/scene/limits.hpp"
#include "eigentrail/scene/units.hpp"

namespace eigentrail {

bool is_parameter_name(std::string_view text) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  return !text.empty() && letter(text[0]) &&
         std::ranges::all_of(text, [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
}

namespace {

/// Reads [parameters]. A parameter is a number, an expression, or { value = ..., unit = "..." }.
class ParameterReader {
 public:
  ParameterReader(const Scene& scene, const Table& table) : scene_(scene), table_(table) {}

  /// `implied` is a parameter that is added if it is not declared.
  Parameters read(const std::optional<Parameter>& implied) {
    if (table_.entries.size() > limits::parameters) {
      const auto& [name, value] = table_.entries[limits::parameters];
      fail(value.where, name, "is one too many; a scene has at most " + std::to_string(limits::parameters));
    }
    for (const auto& [name, value] : table_.entries) names_.push_back(name);
    std::vector<Parameter> list;
    const bool add = implied && table_.find(implied->name) == nullptr;
    if (add) names_.push_back(implied->name);
    for (const auto& [name, value] : table_.entries) list.push_back(read_one(name, value));
    if (add) list.push_back(*implied);
    for (Parameter& parameter : list) {
      if (parameter.definition) settle_definition(parameter, list);
    }
    try {
      return Parameters(list);
    } catch (const ParameterCycle& cycle) {
      const Parameter& parameter = list[static_cast<std::size_t>(cycle.parameter)];
      fail(parameter.where, parameter.name, cycle.what());
    }
  }

 private:
  Parameter read_one(const std::string& name, const Value& entry) {
    Parameter parameter;
    parameter.name = name;
    parameter.where = entry.where;
    if (!is_parameter_name(name))
      fail(entry.where, name,
           "a parameter's name is letters, digits and '_', so that expressions can use it");
    const Value* value = &entry;
    if (const auto* fields = std::get_if<Table>(&entry.data)) {
      value = fields->find("value");
      if (value == nullptr) fail(entry.where, name, "expected value = ...");
      for (const auto& [key, field] : fields->entries) read_field(parameter, key, field);
    }
    set_value(parameter, *value);
    return parameter;
  }

  void read_field(Parameter& parameter, const std::string& key, const Value& field) {
    if (key == "value") return;
    if (key != "unit")
      fail(field.where, parameter.name, "unknown key '" + key + "'; " + suggestion(key, {"value", "unit"}));
    const auto* unit = std::get_if<std::string>(&field.data);
    if (unit == nullptr) fail(field.where, parameter.name, "unit: expected a text, found " + field.kind());
    const auto known = parse_unit(*unit);
    if (!known)
      fail(field.where, parameter.name, "unit '" + *unit + "' is not known; " + unit_suggestion(*unit));
    parameter.unit = *unit;
    parameter.factor = known->factor;
    if (!unit->empty()) parameter.dimension = known->dimension;
    parameter.is_angle = known->angle;
  }

  void set_value(Parameter& parameter, const Value& value) {
    if (const auto* number = std::get_if<double>(&value.data)) {
      if (!std::isfinite(*number)) fail(value.where, parameter.name, "expected a finite number");
      parameter.value = *number;
    } else if (const auto* text = std::get_if<std::string>(&value.data)) {
      try {
        parameter.definition = Expression::parse(*text, names_);
      } catch (const ExpressionError& error) {
        fail(value.where, parameter.name,
             "in \"" + *text + "\" at character " + std::to_string(error.offset + 1) + ": " + error.what());
      }
    } else {
      fail(value.where, parameter.name, "expected a number or an expression, found " + value.kind());
    }
  }

  /// Checks the dimensions in a definition, and decides what its value is: one of known dimension is a
  /// quantity, any other is the number of the parameter's units.
  void settle_definition(Parameter& parameter, const std::vector<Parameter>& list) const {
    const auto fault = [&](const std::string& message) { fail(parameter.where, parameter.name, message); };
    try {
      const ExpressionDimension found = dimension_of(*parameter.definition, list);
      if (!parameter.dimension) return;
      if (found.kind == ExpressionDimension::Kind::known) {
        if (!(found.dimension == *parameter.dimension))
          fault("its value is in " + si_unit(found.dimension) + ", but its unit is " + parameter.unit);
        parameter.definition_is_si = true;
        return;
      }
      const auto& used = parameter.definition->parameters();
      const auto with_unit = std::ranges::find_if(
          used, [&list](int i) { return list[static_cast<std::size_t>(i)].dimension.has_value(); });
      if (with_unit == used.end() || parameter.factor == 1.0) return;
      fault("it is not known whether its value is in " + parameter.unit +
            " or in SI units: " + list[static_cast<std::size_t>(*with_unit)].name +
            " has a unit, another parameter in it has none; give all of them units, or leave out the unit " +
            parameter.unit + " (the value is in SI units then)");
    } catch (const DimensionError& error) {
      fault(error.what());
    }
  }

  [[noreturn]] void fail(SourceLocation where, const std::string& name, const std::string& message) const {
    throw scene_error(scene_, where, "[parameters] " + name + ": " + message);
  }

  const Scene& scene_;
  const Table& table_;
  std::vector<std::string> names_;
};

}  // namespace

Parameters read_parameters(const Scene& scene, const Table& table, const std::optional<Parameter>& implied) {
  return ParameterReader(scene, table).read(implied);
}

}  // namespace eigentrail
