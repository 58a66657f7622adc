#include "model/read_multibody.hpp"

#include <algorithm>
#include <cmath>

#include "eigentrail/core/text.hpp"
#include "model/multibody.hpp"

namespace eigentrail {
namespace {

/// What one scene is read into, and what its tables may refer to.
struct Draft {
  const Scene& scene;
  const std::vector<Vector>& check_at;
  std::set<int> used;
  MultibodyData data;
  std::vector<std::string> points;
  std::vector<Expression> guess;
  std::vector<std::string> constraint_names;

  TableReader reader(const Table& table, const std::string& label) { return {scene, table, label, used}; }

  Quantity quantity(const Expression& expression) {
    data.quantities.push_back(expression);
    return {expression, static_cast<int>(data.quantities.size()) - 1};
  }
  std::array<Quantity, 3> vector(const std::array<Expression, 3>& e) {
    return {quantity(e[0]), quantity(e[1]), quantity(e[2])};
  }

  /// Values of an expression at the checked points of the trace, its ends first.
  std::vector<double> check_values(const Expression& expression) const {
    std::vector<double> values;
    for (const Vector& declared : check_at) {
      Vector si = declared;
      const std::span<double> span(si.data(), static_cast<std::size_t>(si.size()));
      scene.parameters.to_si(span);
      values.push_back(expression.evaluate(std::span<const double>(span)));
    }
    return values;
  }

  void check_range(const TableReader& reader, const std::string& key, const Expression& expression,
                   Range range) const {
    const std::vector<double> values = check_values(expression);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::string found = "; found " + exact_text(values[i]) + where_on_trace(i);
      if (!std::isfinite(values[i])) reader.fail(key, "is not a finite number" + found);
      if (range == Range::positive && !(values[i] > 0.0)) reader.fail(key, "must be positive" + found);
      if (range == Range::non_negative && values[i] < 0.0) reader.fail(key, "must not be negative" + found);
    }
  }

  /// A vector of finite components; of non-zero length where `range` asks for more than any value.
  void check_range(const TableReader& reader, const std::string& key, const std::array<Expression, 3>& vector,
                   Range range) const {
    for (const Expression& e : vector) check_range(reader, key, e, Range::any);
    for (std::size_t i = 0; range != Range::any && i < check_at.size(); ++i) {
      if (vector_at(vector, i).norm() > 0.0) continue;
      reader.fail(key, "must not be the zero vector; it is" + where_on_trace(i));
    }
  }

  Eigen::Vector3d vector_at(const std::array<Expression, 3>& v, std::size_t i) const {
    return {check_values(v[0])[i], check_values(v[1])[i], check_values(v[2])[i]};
  }

  static std::string where_on_trace(std::size_t i) {
    if (i == 0) return " where the trace begins";
    return i == 1 ? " where the trace ends" : " within the range of the trace";
  }

  int point_index(const TableReader& reader, const std::string& key, const std::string& name) const {
    const auto found = std::find(points.begin(), points.end(), name);
    if (found == points.end())
      reader.fail(key, "no point is called '" + name + "'; " + suggestion(name, points));
    return static_cast<int>(found - points.begin());
  }
};

/// Fills an element's fields from its table.
class FieldReader {
 public:
  FieldReader(Draft& draft, TableReader& table) : draft_(draft), table_(table) {}

  void place(std::string_view key_view, Place& place, std::string_view) {
    const std::string key(key_view);
    const NameOrPosition value = table_.name_or_position(key);
    if (const auto* name = std::get_if<std::string>(&value)) {
      place.point = draft_.point_index(table_, key, *name);
    } else {
      place.fixed = draft_.vector(std::get<1>(value));
    }
  }

  void point(std::string_view key_view, Place& place, std::string_view) {
    const std::string key(key_view);
    place.point = draft_.point_index(table_, key, table_.text(key));
  }

  void quantity(const QuantityField& field, Quantity& quantity) {
    const std::string key(field.key);
    const Expression expression =
        field.otherwise ? table_.expression(key, *field.otherwise) : table_.expression(key);
    draft_.check_range(table_, key, expression, field.range);
    quantity = draft_.quantity(expression);
  }

  void vector(const QuantityField& field, std::array<Quantity, 3>& vector) {
    const std::string key(field.key);
    std::array<Expression, 3> components{0.0, 0.0, field.otherwise.value_or(0.0)};
    if (!field.otherwise || table_.has(key)) components = table_.vector(key);
    draft_.check_range(table_, key, components, field.range);
    vector = draft_.vector(components);
  }

  void axis(std::string_view key_view, Axis& axis, std::string_view) {
    const std::string key(key_view);
    const std::string name = table_.text(key);
    const std::size_t index = std::string_view("xyz").find(name);
    if (name.size() != 1 || index == std::string_view::npos) {
      table_.fail(key, "expected \"x\", \"y\" or \"z\", found \"" + name + "\"");
    }
    axis.index = static_cast<int>(index);
  }

 private:
  Draft& draft_;
  TableReader& table_;
};

/// The moving points among an element's places.
class PointCollector {
 public:
  explicit PointCollector(std::vector<int>& points) : points_(points) {}
  void place(std::string_view, const Place& place, std::string_view) {
    const bool known = std::find(points_.begin(), points_.end(), place.point) != points_.end();
    if (place.point >= 0 && !known) points_.push_back(place.point);
  }
  void point(std::string_view key, const Place& point, std::string_view help) { place(key, point, help); }
  void quantity(const QuantityField&, const Quantity&) {}
  void vector(const QuantityField&, const std::array<Quantity, 3>&) {}
  void axis(std::string_view, const Axis&, std::string_view) {}

 private:
  std::vector<int>& points_;
};

template <class Element>
void add_element(Draft& draft, std::vector<Placed<Element>>& list, Element element, std::string label) {
  Placed<Element> placed{std::move(element), std::move(label), {}, draft.data.n_constraints};
  PointCollector collector(placed.points);
  Element::fields(placed.element, collector);
  if constexpr (HasConstraint<Element>) {
    for (int row = 0; row < Element::constraint_count; ++row) {
      const std::string suffix = Element::constraint_count > 1 ? "[" + std::to_string(row) + "]" : "";
      draft.constraint_names.push_back(placed.label + suffix);
    }
    draft.data.n_constraints += Element::constraint_count;
  }
  list.push_back(std::move(placed));
}

std::string numbered(std::string_view name, std::size_t index) {
  return std::string(name) + " " + std::to_string(index + 1);
}

/// Reads every [[name]] table of an element kind.
template <class Element>
void read_elements(Draft& draft, std::vector<Placed<Element>>& list) {
  const std::vector<const Table*> all = tables(draft.scene, std::string(Element::name));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string number = numbered(Element::name, i);
    TableReader table =
        draft.reader(*all[i], "[[" + std::string(Element::name) + "]] " + std::to_string(i + 1));
    Element element;
    FieldReader fields(draft, table);
    Element::fields(element, fields);
    const std::string label = table.has("name") ? printable(table.text("name")) : number;
    table.finish();
    add_element(draft, list, std::move(element), label);
    if (list.back().points.empty()) {
      throw scene_error(draft.scene, all[i]->where,
                        table.label() + ": joins no moving point; name one in it");
    }
  }
}

/// Points come first: everything else refers to them.
void read_points(Draft& draft, std::vector<Quantity>& masses) {
  const std::vector<const Table*> all = tables(draft.scene, "point");
  if (all.empty()) {
    throw InputError(draft.scene.path + ": a scene needs at least one [[point]], or a [matrix_family]");
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    TableReader table = draft.reader(*all[i], "[[point]] " + std::to_string(i + 1));
    const std::string name = table.text("name");
    if (name.empty()) table.fail("name", "must not be empty");
    if (std::find(draft.points.begin(), draft.points.end(), name) != draft.points.end()) {
      table.fail("name", "another point is called '" + name + "' already");
    }
    const Expression mass = table.expression("mass");
    draft.check_range(table, "mass", mass, Range::non_negative);
    for (const Expression& e : table.vector("position")) draft.guess.push_back(e);
    table.finish();
    draft.points.push_back(name);
    masses.push_back(draft.quantity(mass));
  }
  auto& list = std::get<std::vector<Placed<PointMass>>>(draft.data.elements.lists);
  for (std::size_t i = 0; i < all.size(); ++i) {
    add_element(draft, list, PointMass{{static_cast<int>(i), {}}, masses[i]}, draft.points[i]);
  }
}

/// [frame] or [gravity]: one vector that acts on every mass. Returns it, or nothing when the scene has none.
template <class Element>
std::optional<std::array<Expression, 3>> read_field(Draft& draft, const std::string& key,
                                                    const std::vector<Quantity>& masses) {
  const std::vector<const Table*> found = tables(draft.scene, std::string(Element::name));
  if (found.empty()) return std::nullopt;
  const std::string label = "[" + std::string(Element::name) + "]";
  if (found.size() > 1)
    throw scene_error(draft.scene, found[1]->where, label + ": a scene has one of these at most");
  TableReader table = draft.reader(*found[0], label);
  const std::array<Expression, 3> field = table.vector(key);
  draft.check_range(table, key, field, Range::any);
  table.finish();
  const std::array<Quantity, 3> quantities = draft.vector(field);
  auto& list = std::get<std::vector<Placed<Element>>>(draft.data.elements.lists);
  for (std::size_t i = 0; i < masses.size(); ++i) {
    add_element(draft, list, Element{{static_cast<int>(i), {}}, masses[i], quantities},
                std::string(Element::name) + " on " + draft.points[i]);
  }
  return field;
}

/// A frame that turns about another axis than gravity's direction would see gravity turn: no steady state.
void check_gravity(const Draft& draft, const std::array<Expression, 3>& rotation,
                   const std::array<Expression, 3>& gravity) {
  for (std::size_t i = 0; i < draft.check_at.size(); ++i) {
    const Eigen::Vector3d w = draft.vector_at(rotation, i);
    const Eigen::Vector3d g = draft.vector_at(gravity, i);
    if (w.cross(g).norm() <= 1e-12 * w.norm() * g.norm()) continue;
    throw scene_error(
        draft.scene, tables(draft.scene, "gravity")[0]->find("acceleration")->where,
        "[gravity] acceleration: must be parallel to [frame] angular_velocity, or it turns in the frame "
        "and there is no steady state");
  }
}

ModelDescription describe(const Draft& draft) {
  ModelDescription description;
  for (const std::string& point : draft.points) {
    for (const char* axis : {".x", ".y", ".z"}) {
      description.coordinate_names.push_back(point + axis);
      description.coordinate_units.emplace_back("m");
    }
  }
  description.constraint_names = draft.constraint_names;
  description.parameters = draft.scene.parameters;
  draft.data.elements.for_each([&]<class Element>(const std::vector<Placed<Element>>& list, std::size_t) {
    description.effects.push_back({std::string(Element::name), std::string(Element::description),
                                   static_cast<int>(list.size()), Element::contribution});
  });
  return description;
}

/// Collects an element's keys for the reference.
class HelpCollector {
 public:
  explicit HelpCollector(std::vector<FieldHelp>& fields) : fields_(fields) {}
  void place(std::string_view key, const Place&, std::string_view help) {
    fields_.push_back({std::string(key), "name or [x, y, z]", std::string(help)});
  }
  void point(std::string_view key, const Place&, std::string_view help) {
    fields_.push_back({std::string(key), "name", std::string(help)});
  }
  void quantity(const QuantityField& field, const Quantity&) { add(field, ""); }
  void vector(const QuantityField& field, const std::array<Quantity, 3>&) { add(field, "[x, y, z] "); }
  void axis(std::string_view key, const Axis&, std::string_view help) {
    fields_.push_back({std::string(key), "axis", std::string(help)});
  }

 private:
  void add(const QuantityField& field, const std::string& shape) {
    fields_.push_back({std::string(field.key), shape + std::string(field.unit), std::string(field.help)});
  }
  std::vector<FieldHelp>& fields_;
};

}  // namespace

std::unique_ptr<Model> read_multibody(const Scene& scene, const std::vector<Vector>& check_at,
                                      const std::set<int>& used_elsewhere) {
  Draft draft{scene, check_at, used_elsewhere, {}, {}, {}, {}};
  std::vector<Quantity> masses;
  read_points(draft, masses);
  const auto rotation = read_field<RotatingFrame>(draft, "angular_velocity", masses);
  const auto gravity = read_field<Gravity>(draft, "acceleration", masses);
  if (rotation && gravity) check_gravity(draft, *rotation, *gravity);
  draft.data.elements.for_each([&]<class Element>(std::vector<Placed<Element>>& list, std::size_t) {
    if constexpr (has_own_table<Element>) read_elements(draft, list);
  });
  reject_unused_parameters(scene, draft.used);
  draft.data.parameters = scene.parameters;
  draft.data.n_coordinates = 3 * static_cast<int>(draft.points.size());
  return std::make_unique<Multibody>(describe(draft), std::move(draft.data), std::move(draft.guess));
}

std::vector<EffectHelp> effect_reference() {
  std::vector<EffectHelp> reference;
  Elements().for_each([&]<class Element>(const std::vector<Placed<Element>>&, std::size_t) {
    EffectHelp& help = reference.emplace_back();
    help.name = Element::name;
    help.description = Element::description;
    HelpCollector collector(help.fields);
    const Element element;
    Element::fields(element, collector);
  });
  return reference;
}

}  // namespace eigentrail
