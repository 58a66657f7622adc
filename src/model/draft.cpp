#include "model/draft.hpp"

#include <algorithm>
#include <cmath>

#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/limits.hpp"

namespace eigentrail {

std::size_t index_of(const std::string& name, const std::vector<std::string>& known, const TableReader& table,
                     const std::string& key, const std::string& what) {
  const auto found = std::find(known.begin(), known.end(), name);
  if (found != known.end()) return static_cast<std::size_t>(found - known.begin());
  table.fail(key, "no " + what + " is called '" + name + "'; " + suggestion(name, known));
}

void check_is_new(const TableReader& table, const std::string& what, const std::string& name,
                  const std::vector<std::string>& taken) {
  if (std::find(taken.begin(), taken.end(), name) != taken.end())
    table.fail("name", "another " + what + " is called '" + name + "' already");
}

std::string read_name(TableReader& table, const std::string& what, const std::vector<std::string>& taken) {
  std::string name = table.text("name");
  if (name.empty()) table.fail("name", "must not be empty");
  check_is_new(table, what, name, taken);
  return name;
}

std::string numbered(std::string_view name, std::size_t index) {
  return std::string(name) + " " + std::to_string(index + 1);
}

std::string label_of(TableReader& table, std::string_view kind, std::size_t index) {
  return table.has("name") ? printable(table.text("name")) : numbered(kind, index);
}

Draft::Draft(const Scene& of, const ModelRequest& asked)
    : scene(of), request(asked), check_at(asked.check_at), used(asked.used_elsewhere) {
  for (Vector& values : check_at) values = scene.parameters.in_si(std::move(values));
}

TableReader Draft::reader(const Table& table, const std::string& label) {
  begun = label;
  begun_where = table.where;
  return {scene, table, label, used};
}

Quantity Draft::quantity(const Expression& expression) {
  operations += expression.size();
  if (operations > limits::scene_operations) {
    throw ExpressionError("the expressions made of this scene take too much memory; " +
                              std::string("give parts of those in its orientations a name in [parameters]"),
                          0);
  }
  data.quantities.push_back(expression);
  return {expression, static_cast<int>(data.quantities.size()) - 1};
}

bool Draft::is_left_out(std::string_view effect) const {
  return std::find(request.without.begin(), request.without.end(), effect) != request.without.end();
}

Quantity Draft::strength(const std::string& effect) {
  if (!request.strengths) return {};
  for (const auto& [known, strength] : strengths) {
    if (known == effect) return strength;
  }
  const int index = static_cast<int>(scene.parameters.size() + strengths.size());
  return strengths.emplace_back(effect, quantity(Expression::of_parameter(index))).second;
}

Parameters Draft::parameters() const {
  std::vector<Parameter> list = scene.parameters.list();
  for (const auto& [effect, strength] : strengths) {
    Parameter& added = list.emplace_back();
    added.name = strength_parameter(effect);
    added.value = 1.0;
  }
  return Parameters(std::move(list));
}

Combination Draft::on_directors(int body, const ExpressionVector& along) const {
  const int first = bodies[static_cast<std::size_t>(body)].triple + 1;
  return {{first, along[0]}, {first + 1, along[1]}, {first + 2, along[2]}};
}

Place Draft::place_of(const Combination& combination) {
  Place place;
  for (const auto& [triple, weight] : combination) {
    if (is_number(weight, 0.0)) continue;
    place.terms.push_back({triple, is_number(weight, 1.0) ? Quantity() : quantity(weight)});
  }
  return place;
}

Place Draft::on_body(int body, const ExpressionVector& at) {
  Combination position = on_directors(body, at);
  position.emplace(position.begin(), bodies[static_cast<std::size_t>(body)].triple, 1.0);
  return place_of(position);
}

ExpressionVector Draft::at_guess(const Place& place) const {
  ExpressionVector sum{0.0, 0.0, 0.0};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!place.moves()) sum[i] = place.fixed[i].expression;
    for (const Term& term : place.terms) {
      const Expression& component = guess[3 * static_cast<std::size_t>(term.triple) + i];
      sum[i] = sum[i] + (term.weight.slot < 0 ? Expression(1.0) : term.weight.expression) * component;
    }
  }
  return sum;
}

std::array<Place, 3> Draft::directors(int body) const {
  const int origin = bodies[static_cast<std::size_t>(body)].triple;
  return {point_place(origin + 1), point_place(origin + 2), point_place(origin + 3)};
}

std::vector<std::string> Draft::place_names() const {
  std::vector<std::string> names = points;
  for (const BodyDraft& body : bodies) {
    names.push_back(body.name);
    for (const auto& [marker, at] : body.markers) names.push_back(body.name + "." + marker);
  }
  return names;
}

Place Draft::named_place(TableReader& table, const std::string& key, const std::string& name,
                         Carrier* carrier) {
  const auto point = std::find(points.begin(), points.end(), name);
  if (point != points.end()) {
    const int index = static_cast<int>(point - points.begin());
    if (carrier != nullptr) *carrier = {-1, index};
    return point_place(index);
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const int body = static_cast<int>(i);
    if (carrier != nullptr) *carrier = {body, -1};
    if (bodies[i].name == name) return on_body(body, {});
    if (name.rfind(bodies[i].name + ".", 0) != 0) continue;
    const auto marker = bodies[i].markers.find(name.substr(bodies[i].name.size() + 1));
    if (marker != bodies[i].markers.end()) return on_body(body, marker->second);
  }
  const std::string what = bodies.empty() ? "no point is called '" : "no point, body or marker is called '";
  table.fail(key, what + name + "'; " + suggestion(name, place_names()));
}

Place Draft::read_place(TableReader& table, const std::string& key, Carrier* carrier) {
  if (table.is_table(key)) {
    TableReader on = table.table(key);
    const int body = read_body(on, "body");
    const ExpressionVector at = read_vector(on, "at", "m", Range::any);
    on.finish();
    if (carrier != nullptr) *carrier = {body, -1};
    return on_body(body, at);
  }
  const NameOrPosition value = table.name_or_position(key, "m");
  if (const auto* name = std::get_if<std::string>(&value)) return named_place(table, key, *name, carrier);
  if (carrier != nullptr) *carrier = {};
  const ExpressionVector& at = std::get<ExpressionVector>(value);
  check_range(table, key, at, Range::any);
  return fixed_place(at);
}

Place Draft::read_moving_place(TableReader& table, const std::string& key) {
  return table.is_table(key) ? read_place(table, key) : named_place(table, key, table.text(key));
}

int Draft::read_body(TableReader& table, const std::string& key) {
  const std::string name = table.text(key);
  if (bodies.empty()) table.fail(key, "no body is called '" + name + "': the scene has no [[body]]");
  return static_cast<int>(index_of(name, names_of(bodies), table, key, "body"));
}

std::vector<std::string> Draft::joints_with_angles(std::size_t most) const {
  std::vector<std::string> labels;
  for (const auto& [label, motions] : joints) {
    if (!motions.angles.empty() && motions.angles.size() <= most) labels.push_back(label);
  }
  return labels;
}

ExpressionVector Draft::read_direction(TableReader& table, const std::string& key, Carrier& carrier) {
  ExpressionVector along;
  carrier = {};
  if (table.is_table(key)) {
    TableReader on = table.table(key);
    carrier.body = read_body(on, "body");
    along = on.vector("along");
    on.finish();
  } else {
    const NameOrPosition value = table.name_or_position(key);
    if (const auto* name = std::get_if<std::string>(&value)) {
      std::vector<std::string> axes;
      for (std::size_t i = 0; i < bodies.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
          axes.push_back(bodies[i].name + "." + "xyz"[k]);
          if (axes.back() == *name) {
            carrier.body = static_cast<int>(i);
            along = unit_vector(k);
          }
        }
      }
      if (carrier.body < 0) {
        table.fail(key, "expected [x, y, z], or an axis of a body such as \"blade.x\", found \"" + *name +
                            "\"" + (axes.empty() ? "" : "; " + suggestion(*name, axes)));
      }
    } else {
      along = std::get<ExpressionVector>(value);
    }
  }
  check_range(table, key, along, Range::positive);
  return normalized(along);
}

void Draft::add_constraint(std::string_view kind, const std::string& label, std::vector<ConstraintRow> rows) {
  const auto& kinds = constraint_kinds();
  const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const auto& k) { return k.name == kind; });
  for (std::size_t i = 0; i < rows.size(); ++i) {
    constraint_names.push_back(label + (rows.size() > 1 ? "[" + std::to_string(i) + "]" : ""));
  }
  const int first = data.n_constraints;
  data.n_constraints += static_cast<int>(rows.size());
  data.constraints.push_back({static_cast<int>(found - kinds.begin()), label, std::move(rows), first});
}

Expression Draft::read_number(TableReader& table, const std::string& key, WantedUnit unit, Range range,
                              std::optional<double> otherwise) const {
  const Expression expression =
      otherwise ? table.expression_or(key, *otherwise, unit) : table.expression(key, unit);
  check_range(table, key, expression, range);
  return expression;
}

ExpressionVector Draft::read_vector(TableReader& table, const std::string& key, WantedUnit unit, Range range,
                                    std::optional<ExpressionVector> otherwise) const {
  const ExpressionVector vector = otherwise && !table.has(key) ? *otherwise : table.vector(key, unit);
  check_range(table, key, vector, range);
  return vector;
}

ExpressionVector Draft::read_guess(TableReader& table, const std::string& key) const {
  const ExpressionVector found = table.vector(key, "m");
  for (const Expression& e : found) {
    const std::vector<double> values = check_values(e);
    if (!values.empty() && !std::isfinite(values[0]))
      table.fail(key, "is not a finite number; found " + exact_text(values[0]) + where_on_trace(0));
  }
  return found;
}

std::vector<double> Draft::check_values(const Expression& expression) const {
  std::vector<double> values;
  for (const Vector& si : check_at) values.push_back(expression.value(si));
  return values;
}

void Draft::check_range(const TableReader& reader, const std::string& key, const Expression& expression,
                        Range range) const {
  const std::vector<double> values = check_values(expression);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string found = "; found " + exact_text(values[i]) + where_on_trace(i);
    if (!std::isfinite(values[i])) reader.fail(key, "is not a finite number" + found);
    if (range == Range::positive && !(values[i] > 0.0)) reader.fail(key, "must be positive" + found);
    if (range == Range::non_negative && values[i] < 0.0) reader.fail(key, "must not be negative" + found);
  }
}

void Draft::check_range(const TableReader& reader, const std::string& key, const ExpressionVector& vector,
                        Range range) const {
  for (const Expression& e : vector) check_range(reader, key, e, Range::any);
  if (range == Range::any) return;
  require(reader, key, "must not be the zero vector; it is",
          [&](std::size_t i) { return vector_at(vector, i).norm() > 0.0; });
}

std::string Draft::where_on_trace(std::size_t i) {
  if (i == 0) return " where the trace begins";
  return i == 1 ? " where the trace ends" : " within the range of the trace";
}

}  // namespace eigentrail
