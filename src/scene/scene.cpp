#include "eigentrail/scene/scene.hpp"

#include <algorithm>

#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/limits.hpp"
#include "eigentrail/scene/units.hpp"

namespace eigentrail {
namespace {

std::string at(SourceLocation where) {
  return where.line == 0 ? ": "
                         : ":" + std::to_string(where.line) + ":" + std::to_string(where.column) + ": ";
}

bool is_name(std::string_view text) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  return !text.empty() && letter(text[0]) &&
         std::all_of(text.begin(), text.end(), [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
}

/// Reads [parameters]. A parameter is a number, an expression, or { value = ..., unit = "..." }.
class ParameterReader {
 public:
  ParameterReader(const Scene& scene, const Table& table) : scene_(scene), table_(table) {}

  /// `implied` is a parameter that is added if it is not declared.
  Parameters read(const std::optional<Parameter>& implied) {
    if (table_.entries.size() > limits::parameters) {
      const auto& [name, value] = table_.entries[limits::parameters];
      fail(value, name, "is one too many; a scene has at most " + std::to_string(limits::parameters));
    }
    for (const auto& [name, value] : table_.entries) names_.push_back(name);
    std::vector<Parameter> list;
    const bool add = implied && table_.find(implied->name) == nullptr;
    if (add) names_.push_back(implied->name);
    for (const auto& [name, value] : table_.entries) list.push_back(read_one(name, value));
    if (add) list.push_back(*implied);
    try {
      return Parameters(list);
    } catch (const ParameterCycle& cycle) {
      const Parameter& parameter = list[static_cast<std::size_t>(cycle.parameter)];
      throw scene_error(scene_, parameter.where, "[parameters] " + parameter.name + ": " + cycle.what());
    }
  }

 private:
  Parameter read_one(const std::string& name, const Value& entry) {
    Parameter parameter;
    parameter.name = name;
    parameter.where = entry.where;
    if (!is_name(name))
      fail(entry, name, "a parameter's name is letters, digits and '_', so that expressions can use it");
    const Value* value = &entry;
    if (const auto* fields = std::get_if<Table>(&entry.data)) {
      value = fields->find("value");
      if (value == nullptr) fail(entry, name, "expected value = ...");
      for (const auto& [key, field] : fields->entries) read_field(parameter, key, field);
    }
    set_value(parameter, *value);
    return parameter;
  }

  void read_field(Parameter& parameter, const std::string& key, const Value& field) {
    if (key == "value") return;
    if (key != "unit")
      fail(field, parameter.name, "unknown key '" + key + "'; " + suggestion(key, {"value", "unit"}));
    const auto* unit = std::get_if<std::string>(&field.data);
    if (unit == nullptr) fail(field, parameter.name, "unit: expected a text, found " + field.kind());
    const auto factor = unit_factor(*unit);
    if (!factor) {
      fail(field, parameter.name,
           "unit '" + *unit + "' is not known; write it like \"rad/s\", \"rpm\", \"mm\" or \"N m^-1\"");
    }
    parameter.unit = *unit;
    parameter.factor = *factor;
  }

  void set_value(Parameter& parameter, const Value& value) {
    if (const auto* number = std::get_if<double>(&value.data)) {
      if (!std::isfinite(*number)) fail(value, parameter.name, "expected a finite number");
      parameter.value = *number;
    } else if (const auto* text = std::get_if<std::string>(&value.data)) {
      try {
        parameter.definition = Expression::parse(*text, names_);
      } catch (const ExpressionError& error) {
        fail(value, parameter.name,
             "in \"" + *text + "\" at character " + std::to_string(error.offset + 1) + ": " + error.what());
      }
    } else {
      fail(value, parameter.name, "expected a number or an expression, found " + value.kind());
    }
  }

  [[noreturn]] void fail(const Value& value, const std::string& name, const std::string& message) const {
    throw scene_error(scene_, value.where, "[parameters] " + name + ": " + message);
  }

  const Scene& scene_;
  const Table& table_;
  std::vector<std::string> names_;
};

/// The traced parameter of a scene with a family of matrices, still without a value.
std::optional<Parameter> family_variable(const Table& root) {
  const Value* trace = root.find("trace");
  const bool family = root.find("matrix_family") != nullptr || root.find("sampled_family") != nullptr;
  if (trace == nullptr || !family) return std::nullopt;
  const auto* fields = std::get_if<Table>(&trace->data);
  if (fields == nullptr) return std::nullopt;
  const Value* value = fields->find("parameter");
  const auto* name = value == nullptr ? nullptr : std::get_if<std::string>(&value->data);
  if (name == nullptr || !is_name(*name)) return std::nullopt;
  Parameter parameter;
  parameter.name = *name;
  parameter.where = value->where;
  return parameter;
}

/// Sets an undeclared traced parameter to the value at which the trace begins. Traces of other parameters use
/// this value.
void set_start_of_trace(Scene& scene, const std::string& name) {
  const Table& trace = *tables(scene, "trace").front();
  if (trace.find("from") == nullptr) return;
  std::set<int> used;
  const Expression from = TableReader(scene, trace, "[trace]", used).expression("from");
  Vector values = scene.parameters.declared_values();
  scene.parameters.to_si(std::span<double>(values.data(), scene.parameters.size()));
  std::vector<Parameter> list;
  for (std::size_t i = 0; i < scene.parameters.size(); ++i) {
    list.push_back(scene.parameters[i]);
    if (list.back().name == name) {
      list.back().value = from.evaluate(std::span<const double>(values.data(), scene.parameters.size()));
    }
  }
  scene.parameters = Parameters(std::move(list));
}

}  // namespace

InputError scene_error(const Scene& scene, SourceLocation where, const std::string& message) {
  return InputError(scene.path + at(where) + printable(message));
}

Scene parse_scene(std::string text, const std::string& path) {
  Scene scene;
  scene.path = path;
  scene.text = std::move(text);
  scene.root = parse_toml(scene.text, path);
  if (const Value* title = scene.root.find("title")) {
    const auto* words = std::get_if<std::string>(&title->data);
    if (words == nullptr)
      throw scene_error(scene, title->where, "title: expected a text, found " + title->kind());
    scene.title = *words;
  }
  const Value* parameters = scene.root.find("parameters");
  const Table none;
  const Table* table = parameters == nullptr ? &none : std::get_if<Table>(&parameters->data);
  if (table == nullptr) {
    throw scene_error(scene, parameters->where, "parameters: expected a table, found " + parameters->kind());
  }
  const std::optional<Parameter> implied = family_variable(scene.root);
  scene.parameters = ParameterReader(scene, *table).read(implied);
  if (implied && table->find(implied->name) == nullptr) set_start_of_trace(scene, implied->name);
  return scene;
}

TableReader::TableReader(const Scene& scene, const Table& table, std::string label, std::set<int>& used)
    : scene_(scene), table_(table), label_(std::move(label)), used_(used) {}

const Value* TableReader::find(const std::string& key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
  return table_.find(key);
}

bool TableReader::has(const std::string& key) {
  return find(key) != nullptr;
}

const Value& TableReader::require(const std::string& key, const std::string& expected) {
  const Value* value = find(key);
  if (value != nullptr) return *value;
  for (const auto& [found, misspelt] : table_.entries) {
    const bool known = std::find(known_.begin(), known_.end(), found) != known_.end();
    if (!known && !nearest_name(found, {key}).empty())
      fail(found, "unknown key; did you mean '" + key + "'?");
  }
  fail(key, "is missing; expected " + expected);
}

void TableReader::fail(const std::string& key, const std::string& message) const {
  const Value* value = table_.find(key);
  throw scene_error(scene_, value != nullptr ? value->where : table_.where,
                    label_ + " " + key + ": " + message);
}

Expression TableReader::to_expression(const Value& value, const std::string& key) {
  if (const auto* number = std::get_if<double>(&value.data)) {
    if (!std::isfinite(*number)) fail(key, "expected a finite number");
    return {*number};
  }
  const auto* text = std::get_if<std::string>(&value.data);
  if (text == nullptr) fail(key, "expected a number or an expression, found " + value.kind());
  try {
    Expression expression = Expression::parse(*text, scene_.parameters.names());
    used_.insert(expression.parameters().begin(), expression.parameters().end());
    return expression;
  } catch (const ExpressionError& error) {
    fail(key, "in \"" + *text + "\" at character " + std::to_string(error.offset + 1) + ": " + error.what());
  }
}

Expression TableReader::expression(const std::string& key) {
  return to_expression(require(key, "a number or an expression"), key);
}

Expression TableReader::expression(const std::string& key, double otherwise) {
  const Value* value = find(key);
  return value == nullptr ? Expression(otherwise) : to_expression(*value, key);
}

std::array<Expression, 3> TableReader::to_vector(const Value& value, const std::string& key) {
  const auto* items = std::get_if<Array>(&value.data);
  if (items == nullptr || items->size() != 3) {
    fail(key, "expected three numbers or expressions [x, y, z], found " +
                  (items == nullptr ? value.kind() : std::to_string(items->size()) + " of them"));
  }
  return {to_expression((*items)[0], key), to_expression((*items)[1], key), to_expression((*items)[2], key)};
}

std::array<Expression, 3> TableReader::vector(const std::string& key) {
  return to_vector(require(key, "three numbers or expressions [x, y, z]"), key);
}

NameOrPosition TableReader::name_or_position(const std::string& key) {
  const Value& value = require(key, "the name of a point, or a fixed place [x, y, z]");
  if (const auto* name = std::get_if<std::string>(&value.data)) return *name;
  return to_vector(value, key);
}

std::string TableReader::text(const std::string& key) {
  const Value& value = require(key, "a text");
  const auto* text = std::get_if<std::string>(&value.data);
  if (text == nullptr) fail(key, "expected a text, found " + value.kind());
  return *text;
}

std::vector<std::string> TableReader::texts(const std::string& key) {
  const Value& value = require(key, "a text, or a list of texts");
  const auto to_text = [&](const Value& item) {
    if (const auto* number = std::get_if<double>(&item.data)) return exact_text(*number);
    const auto* text = std::get_if<std::string>(&item.data);
    if (text == nullptr) fail(key, "expected a text or a number, found " + item.kind());
    return *text;
  };
  const auto* array = std::get_if<Array>(&value.data);
  if (array == nullptr) return {to_text(value)};
  if (array->size() > limits::list_length)
    fail(key, "expected at most " + std::to_string(limits::list_length) + " texts, found " +
                  std::to_string(array->size()));
  std::vector<std::string> result;
  for (const Value& item : *array) result.push_back(to_text(item));
  return result;
}

bool TableReader::flag(const std::string& key) {
  const Value& value = require(key, "true or false");
  const auto* flag = std::get_if<bool>(&value.data);
  if (flag == nullptr) fail(key, "expected true or false, found " + value.kind());
  return *flag;
}

std::vector<Expression> TableReader::list(const std::string& key) {
  const Value& value = require(key, "a number or a list of numbers");
  const auto* array = std::get_if<Array>(&value.data);
  if (array == nullptr) return {to_expression(value, key)};
  if (array->size() > limits::list_length)
    fail(key, "expected at most " + std::to_string(limits::list_length) + " numbers, found " +
                  std::to_string(array->size()));
  std::vector<Expression> result;
  for (const Value& item : *array) result.push_back(to_expression(item, key));
  return result;
}

const Array& TableReader::items(const Value& value, const std::string& key, const std::string& expected) {
  const auto* array = std::get_if<Array>(&value.data);
  if (array == nullptr) fail(key, "expected " + expected + "; found " + value.kind());
  return *array;
}

std::vector<std::vector<Expression>> TableReader::matrix(const std::string& key) {
  const std::string expected = "a list of numbers, or a list of rows of them";
  const Array& rows = items(require(key, expected), key, expected);
  if (rows.empty() || std::get_if<Array>(&rows.front().data) == nullptr) return {list(key)};
  std::vector<std::vector<Expression>> result;
  for (const Value& row : rows) {
    auto& entries = result.emplace_back();
    for (const Value& entry : items(row, key, expected)) entries.push_back(to_expression(entry, key));
  }
  return result;
}

std::vector<std::vector<std::vector<Expression>>> TableReader::matrices(const std::string& key) {
  const std::string expected = "a list of matrices, each a list of rows, lowest power first";
  std::vector<std::vector<std::vector<Expression>>> result;
  for (const Value& matrix : items(require(key, expected), key, expected)) {
    auto& rows = result.emplace_back();
    for (const Value& row : items(matrix, key, expected)) {
      auto& entries = rows.emplace_back();
      for (const Value& entry : items(row, key, expected)) entries.push_back(to_expression(entry, key));
    }
  }
  return result;
}

bool TableReader::is_table(const std::string& key) {
  const Value* value = find(key);
  return value != nullptr && std::get_if<Table>(&value->data) != nullptr;
}

TableReader TableReader::table(const std::string& key) {
  const Value& value = require(key, "a table");
  const auto* table = std::get_if<Table>(&value.data);
  if (table == nullptr) fail(key, "expected a table { ... }, found " + value.kind());
  return {scene_, *table, label_ + " " + key, used_};
}

std::vector<std::string> TableReader::keys() const {
  std::vector<std::string> result;
  for (const auto& [key, value] : table_.entries) result.push_back(key);
  return result;
}

void TableReader::finish() const {
  for (const auto& [key, value] : table_.entries) {
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) {
      throw scene_error(scene_, value.where,
                        label_ + " " + key + ": unknown key; " + suggestion(key, known_));
    }
  }
}

std::vector<const Table*> tables(const Scene& scene, const std::string& key) {
  const Value* value = scene.root.find(key);
  if (value == nullptr) return {};
  if (const auto* table = std::get_if<Table>(&value->data)) return {table};
  const auto* array = std::get_if<Array>(&value->data);
  if (array == nullptr)
    throw scene_error(scene, value->where, key + ": expected a table [" + key + "], found " + value->kind());
  if (array->size() > limits::tables_of_a_kind) {
    throw scene_error(
        scene, (*array)[limits::tables_of_a_kind].where,
        key + ": a scene has at most " + std::to_string(limits::tables_of_a_kind) + " of these");
  }
  std::vector<const Table*> result;
  for (const Value& item : *array) {
    const auto* table = std::get_if<Table>(&item.data);
    if (table == nullptr) {
      const std::string expected = key + ": expected tables [[" + key + "]], found ";
      throw scene_error(scene, item.where, expected + item.kind());
    }
    result.push_back(table);
  }
  return result;
}

void reject_unused_parameters(const Scene& scene, const std::set<int>& used) {
  const std::set<int> reached = scene.parameters.with_definitions(used);
  const int n = static_cast<int>(scene.parameters.size());
  for (int i = 0; i < n; ++i) {
    if (!reached.contains(i)) {
      const Parameter& parameter = scene.parameters[static_cast<std::size_t>(i)];
      throw scene_error(scene, parameter.where,
                        "[parameters] " + parameter.name +
                            ": nothing in the scene uses this parameter; remove it or use it");
    }
  }
}

}  // namespace eigentrail
