#include "eigentrail/scene/scene.hpp"

#include <algorithm>
#include <cmath>

#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/expression_dimension.hpp"
#include "eigentrail/scene/limits.hpp"
#include "eigentrail/scene/traced_parameter.hpp"
#include "scene/read_parameters.hpp"

namespace eigentrail {
namespace {

std::string at(SourceLocation where) {
  return where.line <= 0 ? ": "
                         : ":" + std::to_string(where.line) + ":" + std::to_string(where.column) + ": ";
}

/// The traced parameter of a scene with a family of matrices, still without a value.
std::optional<Parameter> family_variable(const Table& root) {
  const auto* trace = entry_as<Table>(root, "trace");
  const bool family = root.find("matrix_family") != nullptr || root.find("sampled_family") != nullptr;
  if (trace == nullptr || !family) return std::nullopt;
  const auto* name = entry_as<std::string>(*trace, "parameter");
  if (name == nullptr || !is_parameter_name(*name)) return std::nullopt;
  Parameter parameter;
  parameter.name = *name;
  parameter.where = trace->find("parameter")->where;
  return parameter;
}

/// Sets an undeclared traced parameter to the value at which the trace begins. Traces of other parameters use
/// this value.
void set_start_of_trace(Scene& scene, const std::string& name) {
  const Table& trace = *tables(scene, "trace").front();
  if (trace.find("from") == nullptr) return;
  std::set<int> used;
  const Expression from = TableReader(scene, trace, "[trace]", used).expression("from");
  std::vector<Parameter> list = scene.parameters.list();
  list[static_cast<std::size_t>(*scene.parameters.index(name))].value =
      from.value(scene.parameters.in_si(scene.parameters.declared_values()));
  scene.parameters = Parameters(std::move(list));
}

/// A value of this type. Throws InputError: "expected a text, found a number".
template <class T>
const T& as(const TableReader& reader, const Value& value, const std::string& key,
            const std::string& expected) {
  if (const T* found = std::get_if<T>(&value.data)) return *found;
  reader.fail(key, "expected " + expected + ", found " + value.kind());
}

/// The items of a list that is not too long, or a single value, each as what `make` makes of it.
auto items_of(const TableReader& reader, const Value& value, const std::string& key, const char* what,
              const auto& make) {
  const auto* array = std::get_if<Array>(&value.data);
  std::vector<std::decay_t<decltype(make(value))>> result;
  if (array == nullptr) {
    result.push_back(make(value));
    return result;
  }
  if (array->size() > limits::list_length)
    reader.fail(key, "expected at most " + std::to_string(limits::list_length) + " " + what + ", found " +
                         std::to_string(array->size()));
  for (const Value& item : *array) result.push_back(make(item));
  return result;
}

}  // namespace

InputError scene_error(const Scene& scene, SourceLocation where, const std::string& message) {
  return InputError(scene.path + at(scene.generated ? SourceLocation{} : where) + printable(message));
}

Scene parse_scene(std::string text, const std::string& path, bool generated) {
  Scene scene;
  scene.path = path;
  scene.generated = generated;
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
  scene.parameters = read_parameters(scene, *table, implied);
  if (implied && table->find(implied->name) == nullptr) set_start_of_trace(scene, implied->name);
  return scene;
}

const Value* TableReader::find(const std::string& key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
  return table_.find(key);
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
  const SourceLocation where = value != nullptr ? value->where : table_.where;
  const std::string name = label_ + " " + key;
  if (where == given_as_option) {
    std::string option = name.substr(name.find(' ') + 1);  // without [trace]
    std::ranges::replace(option, '_', '-');
    throw InputError("--" + option + ": " + printable(message));
  }
  throw scene_error(scene_, where, name + ": " + message);
}

Expression TableReader::to_expression(const Value& value, const std::string& key, WantedUnit unit) {
  if (const auto* number = std::get_if<double>(&value.data)) {
    if (!std::isfinite(*number)) fail(key, "expected a finite number");
    return {*number};
  }
  const auto& text = as<std::string>(*this, value, key, "a number or an expression");
  try {
    Expression expression = Expression::parse(text, scene_.parameters.names());
    used_.insert(expression.parameters().begin(), expression.parameters().end());
    check_dimension(expression, key, text, unit);
    return expression;
  } catch (const ExpressionError& error) {
    fail(key, "in \"" + text + "\" at character " + std::to_string(error.offset + 1) + ": " + error.what());
  }
}

void TableReader::check_dimension(const Expression& expression, const std::string& key,
                                  const std::string& text, WantedUnit unit) const {
  const std::vector<Parameter>& parameters = scene_.parameters.list();
  try {
    if (!unit) {
      (void)dimension_of(expression, parameters);
    } else if (const std::string fault = dimension_fault(expression, parameters, *unit); !fault.empty()) {
      fail(key, "\"" + text + "\" " + fault);
    }
  } catch (const DimensionError& error) {
    fail(key, "\"" + text + "\" " + error.what());
  }
}

Expression TableReader::expression_or(const std::string& key, double otherwise, WantedUnit unit) {
  const Value* value = find(key);
  return value == nullptr ? Expression(otherwise) : to_expression(*value, key, unit);
}

std::array<Expression, 3> TableReader::to_vector(const Value& value, const std::string& key,
                                                 WantedUnit unit) {
  const auto* items = std::get_if<Array>(&value.data);
  if (items == nullptr || items->size() != 3) {
    fail(key, "expected three numbers or expressions [x, y, z], found " +
                  (items == nullptr ? value.kind() : std::to_string(items->size()) + " of them"));
  }
  return {to_expression((*items)[0], key, unit), to_expression((*items)[1], key, unit),
          to_expression((*items)[2], key, unit)};
}

NameOrPosition TableReader::name_or_position(const std::string& key, WantedUnit unit) {
  const Value& value = require(key, "the name of a point, or a fixed place [x, y, z]");
  if (const auto* name = std::get_if<std::string>(&value.data)) return *name;
  return to_vector(value, key, unit);
}

std::string TableReader::text(const std::string& key) {
  return as<std::string>(*this, require(key, "a text"), key, "a text");
}

std::vector<std::string> TableReader::texts(const std::string& key) {
  const Value& value = require(key, "a text, or a list of texts");
  return items_of(*this, value, key, "texts", [&](const Value& item) {
    if (const auto* number = std::get_if<double>(&item.data)) return exact_text(*number);
    return as<std::string>(*this, item, key, "a text or a number");
  });
}

bool TableReader::flag(const std::string& key) {
  return as<bool>(*this, require(key, "true or false"), key, "true or false");
}

int TableReader::whole_number(const std::string& key, int least, int most) {
  const Expression found = expression(key);
  const double value = found.is_constant() ? found.value() : NAN;
  if (!(value >= least && value <= most) || value != std::floor(value))
    fail(key, "expected a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  return static_cast<int>(value);
}

std::vector<Expression> TableReader::list(const std::string& key, WantedUnit unit) {
  const Value& value = require(key, "a number or a list of numbers");
  return items_of(*this, value, key, "numbers",
                  [&](const Value& item) { return to_expression(item, key, unit); });
}

const Array& TableReader::items(const Value& value, const std::string& key, const std::string& expected) {
  const auto* array = std::get_if<Array>(&value.data);
  if (array == nullptr) fail(key, "expected " + expected + "; found " + value.kind());
  return *array;
}

std::vector<std::vector<Expression>> TableReader::matrix(const std::string& key, WantedUnit unit) {
  const std::string expected = "a list of numbers, or a list of rows of them";
  const Array& rows = items(require(key, expected), key, expected);
  if (rows.empty() || std::get_if<Array>(&rows.front().data) == nullptr) return {list(key, unit)};
  std::vector<std::vector<Expression>> result;
  for (const Value& row : rows) {
    auto& entries = result.emplace_back();
    for (const Value& entry : items(row, key, expected)) entries.push_back(to_expression(entry, key, unit));
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
      for (const Value& entry : items(row, key, expected)) entries.push_back(to_expression(entry, key, {}));
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
  return {scene_, as<Table>(*this, value, key, "a table { ... }"), label_ + " " + key, used_};
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

InputError unused_error(const Scene& scene, int parameter) {
  const Parameter& unused = scene.parameters[static_cast<std::size_t>(parameter)];
  return scene_error(
      scene, unused.where,
      "[parameters] " + unused.name + ": nothing in the scene uses this parameter; remove it or use it");
}

std::vector<int> unused_parameters(const Scene& scene, const std::set<int>& used) {
  const std::set<int> reached = scene.parameters.with_definitions(used);
  const int n = static_cast<int>(scene.parameters.size());
  std::vector<int> unused;
  for (int i = 0; i < n; ++i) {
    if (reached.contains(i)) continue;
    unused.push_back(i);
    const Parameter& parameter = scene.parameters[static_cast<std::size_t>(i)];
    for (const int other : reached) {
      const std::string& known = scene.parameters[static_cast<std::size_t>(other)].name;
      if (!is_misprint(parameter.name, known)) continue;
      throw scene_error(scene, parameter.where,
                        "[parameters] " + parameter.name +
                            ": nothing in the scene uses this parameter; did you mean '" + known + "'?");
    }
  }
  return unused;
}

std::string traced_parameter(const Scene& scene) {
  for (const Table* trace : tables(scene, "trace")) {
    if (const auto* name = entry_as<std::string>(*trace, "parameter")) return *name;
  }
  return "";
}

std::vector<std::string> trimmed_parameters(const Scene& scene) {
  std::vector<std::string> names;
  for (const Table* trim : tables(scene, "trim")) {
    if (const auto* name = entry_as<std::string>(*trim, "unknown")) names.push_back(*name);
  }
  return names;
}

bool is_trimmed(const Scene& scene, const std::string& parameter) {
  const std::vector<std::string> names = trimmed_parameters(scene);
  return std::find(names.begin(), names.end(), parameter) != names.end();
}

}  // namespace eigentrail
