#include "model/read_beams.hpp"

#include <algorithm>
#include <cmath>

#include "eigentrail/core/text.hpp"
#include "model/beam_axis.hpp"
#include "model/gauss_points.hpp"

namespace eigentrail {
namespace {

constexpr int most_elements = 200;
/// Points per element and station at which the mass is integrated: exact for products of quadratic shape
/// functions with mass that is linear between stations, if elements are straight.
constexpr int mass_points = 2;

/// An end of a beam: where it is and what holds it.
struct End {
  std::string key;  ///< "from" or "to"
  Place place;
  Carrier carrier;
  ExpressionVector position;  ///< in the frame, at the starting guess
  bool clamped = false;
};

bool is_zero(const Expression& e) {
  return e.is_constant() && e.evaluate(std::span<const double>()) == 0.0;
}

/// Position of a place at the starting guess.
ExpressionVector position_of(const Draft& draft, const Place& place) {
  ExpressionVector sum;
  if (!place.moves()) {
    for (std::size_t i = 0; i < 3; ++i) sum[i] = place.fixed[i].expression;
    return sum;
  }
  for (const Term& term : place.terms) {
    const std::size_t first = 3 * static_cast<std::size_t>(term.triple);
    const ExpressionVector triple = {draft.guess[first], draft.guess[first + 1], draft.guess[first + 2]};
    sum = sum + (term.weight.slot < 0 ? Expression(1.0) : term.weight.expression) * triple;
  }
  return sum;
}

class BeamReader {
 public:
  BeamReader(Draft& draft, TableReader& table, std::string name)
      : draft_(draft), table_(table), name_(std::move(name)) {}

  void read() {
    std::array<End, 2> ends = {read_end("from"), read_end("to")};
    read_holds(ends);
    check_apart(ends);
    const int elements = whole_number("elements", 10, most_elements);
    const int degree = whole_number("degree", 2, 2);
    const ExpressionVector y =
        draft_.read_vector(table_, "y_axis", any_unit, Range::positive, unit_vector(1));
    check_across(ends, y);
    properties_ = read_beam_table(draft_, table_);
    table_.finish();
    axis_ = beam_axis(properties_, elements, degree, ends[0].position, ends[1].position, y);
    first_body_ = draft_.bodies.size();
    add_nodes();
    add_sections();
    hold(ends[0], first_body_);
    hold(ends[1], draft_.bodies.size() - 1);
  }

 private:
  End read_end(const std::string& key) {
    End end;
    end.key = key;
    end.place = draft_.read_place(table_, key, &end.carrier);
    if (end.carrier.point >= 0)
      table_.fail(key, "a point has no orientation; a beam needs a body or a fixed place");
    end.position = position_of(draft_, end.place);
    return end;
  }

  /// By default a beam is welded to bodies, clamped in the frame where it begins, and free where it ends.
  void read_holds(std::array<End, 2>& ends) {
    for (End& end : ends) end.clamped = end.key == "from" || !end.carrier.is_frame();
    if (!table_.has("ends")) return;
    const std::vector<std::string> holds = table_.texts("ends");
    if (holds.size() != 2) table_.fail("ends", "expected two texts, for from and to");
    for (std::size_t i = 0; i < 2; ++i) {
      if (holds[i] != "clamped" && holds[i] != "free")
        table_.fail("ends", "expected \"clamped\" or \"free\", found \"" + holds[i] + "\"");
      ends[i].clamped = holds[i] == "clamped";
    }
  }

  int whole_number(const std::string& key, int otherwise, int most) {
    const Expression e = table_.expression_or(key, otherwise);
    const double n = e.is_constant() ? e.evaluate(std::span<const double>()) : 0.0;
    if (!(n >= 1.0) || n > most || n != std::floor(n))
      table_.fail(key, "expected a whole number from 1 to " + std::to_string(most));
    return static_cast<int>(n);
  }

  void check_apart(const std::array<End, 2>& ends) {
    for (std::size_t i = 0; i < draft_.check_at.size(); ++i) {
      if (draft_.vector_at(ends[1].position - ends[0].position, i).norm() > 0.0) continue;
      table_.fail("to", "must be apart from `from`; both are at the same place" + Draft::where_on_trace(i));
    }
  }

  void check_across(const std::array<End, 2>& ends, const ExpressionVector& y) {
    const ExpressionVector chord = ends[1].position - ends[0].position;
    for (std::size_t i = 0; i < draft_.check_at.size(); ++i) {
      const Eigen::Vector3d a = draft_.vector_at(chord, i);
      const Eigen::Vector3d b = draft_.vector_at(y, i);
      if (a.cross(b).norm() > 1e-9 * a.norm() * b.norm()) continue;
      table_.fail("y_axis", "must not be parallel to the beam; it is" + Draft::where_on_trace(i) +
                                ". It is the direction of the y axis of the sections, [0, 1, 0] by default");
    }
  }

  std::string node_name(int i) const {
    if (i == 0) return name_ + ".root";
    return name_ + "." + (i == axis_.nodes() - 1 ? "tip" : std::to_string(i));
  }

  void add_nodes() {
    const std::vector<BeamTable::Mass> mass = nodal_masses();
    for (int i = 0; i < axis_.nodes(); ++i) {
      const auto index = static_cast<std::size_t>(i);
      const auto& taken = draft_.mass_names;
      if (std::find(taken.begin(), taken.end(), node_name(i)) != taken.end())
        table_.fail("name",
                    "a body or point is called '" + node_name(i) + "' already, like a node of this beam");
      const int triple = static_cast<int>(draft_.guess.size()) / 3;
      for (const Expression& e : axis_.position[index]) draft_.guess.push_back(e);
      for (const ExpressionVector& director : axis_.rotation[index]) {
        for (const Expression& e : director) draft_.guess.push_back(e);
      }
      draft_.mass_names.push_back(node_name(i));
      draft_.bodies.push_back({node_name(i), triple, axis_.position[index], axis_.rotation[index], {}});
      draft_.masses.push_back(mass_distribution(triple, mass[index]));
      add_directors(draft_, static_cast<int>(draft_.bodies.size()) - 1);
    }
  }

  MassDistribution mass_distribution(int triple, const BeamTable::Mass& moments) {
    MassDistribution masses;
    masses.size = 4;
    for (int i = 0; i < 4; ++i) masses.carriers[static_cast<std::size_t>(i)] = draft_.point_place(triple + i);
    masses.mass = draft_.quantity(moments[0]);
    const Quantity none = draft_.quantity(0.0);
    masses.first = {none, draft_.quantity(moments[1]), draft_.quantity(moments[2])};
    masses.second = {none, draft_.quantity(moments[3]), draft_.quantity(moments[4]), none,
                     none, draft_.quantity(moments[5])};
    return masses;
  }

  /// Every node has the integral of its shape function over the mass: the mass matrix is lumped. The errors
  /// of eigenvalues are of order 2 degree, as with the full matrix, since the nodes are those of
  /// Gauss-Lobatto quadrature (Fried & Malkus 1975).
  std::vector<BeamTable::Mass> nodal_masses() const {
    std::vector<std::vector<double>> share(static_cast<std::size_t>(axis_.nodes()),
                                           std::vector<double>(properties_.span.size(), 0.0));
    std::vector<BeamTable::Mass> result(static_cast<std::size_t>(axis_.nodes()));
    for (int e = 0; e < axis_.elements; ++e) {
      for_each_mass_point(e, [&](double xi, double weight) {
        const ShapeFunctions shape = shape_functions(axis_.degree, xi);
        const Expression stretch = axis_.straight ? Expression(1.0) : axis_.stretch(e, shape);
        for (std::size_t a = 0; a < shape.value.size(); ++a) {
          for (const auto& [station, part] : properties_.shares((e + xi) / axis_.elements)) {
            const double w = weight * shape.value[a] * part;
            if (axis_.straight)
              share[axis_.node(e, a)][station] += w;
            else
              add(result[axis_.node(e, a)], Expression(w) * stretch, properties_.mass[station]);
          }
        }
      });
    }
    if (!axis_.straight) return result;
    const Expression length = Expression(1.0 / axis_.elements) * axis_.length;
    for (std::size_t i = 0; i < result.size(); ++i) {
      for (std::size_t k = 0; k < share[i].size(); ++k)
        add(result[i], Expression(share[i][k]) * length, properties_.mass[k]);
    }
    return result;
  }

  static void add(BeamTable::Mass& sum, const Expression& weight, const BeamTable::Mass& moments) {
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = sum[i] + weight * moments[i];
  }

  /// Calls visit(xi, weight) for the points of the parts of an element between stations.
  template <class Visit>
  void for_each_mass_point(int e, Visit visit) const {
    std::vector<double> ends = {0.0};
    for (const double s : properties_.span) {
      const double xi = s * axis_.elements - e;
      if (xi > 1e-9 && xi < 1.0 - 1e-9) ends.push_back(xi);
    }
    ends.push_back(1.0);
    for (std::size_t i = 1; i < ends.size(); ++i) {
      const double width = ends[i] - ends[i - 1];
      for (const auto& [at, weight] : gauss_points(mass_points))
        visit(ends[i - 1] + at * width, weight * width);
    }
  }

  /// One fewer quadrature points than nodes: the lowest number that leaves no deformation without strain. The
  /// interpolation then has as many constraints as it can meet when the beam is slender, and does not lock
  /// (Noor & Peters 1981).
  void add_sections() {
    const auto n_nodes = static_cast<std::size_t>(axis_.nodes());
    draft_.beams.push_back({name_, draft_.masses.size() - n_nodes, n_nodes, draft_.beam_sections.size(), 0});
    for (int e = 0; e < axis_.elements; ++e) {
      for (const auto& [xi, weight] : gauss_points(axis_.degree)) add_section(e, xi, weight);
    }
    draft_.beams.back().n_sections = draft_.beam_sections.size() - draft_.beams.back().first_section;
  }

  void add_section(int e, double xi, double weight) {
    const ShapeFunctions shape = shape_functions(axis_.degree, xi);
    const Expression stretch = axis_.stretch(e, shape);
    std::vector<Expression> values(shape.value.begin(), shape.value.end());
    std::vector<Expression> slopes;
    for (const double slope : shape.slope) slopes.push_back(Expression(slope) / stretch);
    BeamSection section;
    const std::vector<Quantity> value_weights = quantities(values);
    const std::vector<Quantity> slope_weights = quantities(slopes);
    section.slope = interpolated(e, slope_weights, 0);
    for (int i = 0; i < 3; ++i) {
      section.directors[static_cast<std::size_t>(i)] = interpolated(e, value_weights, i + 1);
      section.rates[static_cast<std::size_t>(i)] = interpolated(e, slope_weights, i + 1);
    }
    section.width = draft_.quantity(Expression(weight) * stretch);
    set_stiffness(section, (e + xi) / axis_.elements);
    set_unloaded(section, e, values, slopes);
    draft_.beam_sections.push_back(std::move(section));
  }

  std::vector<Quantity> quantities(const std::vector<Expression>& expressions) {
    std::vector<Quantity> result;
    for (const Expression& e : expressions) result.push_back(draft_.quantity(e));
    return result;
  }

  /// Sum over the nodes of an element of weights times one of their four triples.
  Place interpolated(int e, const std::vector<Quantity>& weights, int triple) const {
    Place place;
    for (std::size_t a = 0; a < weights.size(); ++a)
      place.terms.push_back({draft_.bodies[first_body_ + axis_.node(e, a)].triple + triple, weights[a]});
    return place;
  }

  void set_stiffness(BeamSection& section, double s) {
    BeamTable::Stiffness S;
    for (const auto& [station, part] : properties_.shares(s)) {
      for (std::size_t i = 0; i < section_entries; ++i)
        S[i] = S[i] + Expression(part) * properties_.stiffness[station][i];
    }
    for (std::size_t i = 0; i < section_entries; ++i) {
      if (!is_zero(S[i])) section.stiffness[i] = draft_.quantity(S[i]);
    }
  }

  /// Strains of the nodes where the scene gives them, so that the beam there is free of stress.
  void set_unloaded(BeamSection& section, int e, const std::vector<Expression>& values,
                    const std::vector<Expression>& slopes) {
    if (axis_.straight && !axis_.twisted) {
      section.unloaded[0] = draft_.quantity(1.0);
      return;
    }
    ExpressionVector along;
    ExpressionRotation directors, rates;
    for (std::size_t a = 0; a < values.size(); ++a) {
      along = along + slopes[a] * axis_.local_position[axis_.node(e, a)];
      for (std::size_t i = 0; i < 3; ++i) {
        directors[i] = directors[i] + values[a] * axis_.local_rotation[axis_.node(e, a)][i];
        rates[i] = rates[i] + slopes[a] * axis_.local_rotation[axis_.node(e, a)][i];
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      section.unloaded[i] = draft_.quantity(dot(directors[i], along));
      section.unloaded[3 + i] =
          draft_.quantity(Expression(0.5) * (dot(directors[k], rates[j]) - dot(directors[j], rates[k])));
    }
  }

  /// Welds a node to what holds the end.
  void hold(const End& end, std::size_t node) {
    if (!end.clamped) return;
    const BodyDraft& body = draft_.bodies[node];
    const Place origin = draft_.point_place(body.triple);
    std::vector<ConstraintRow> rows;
    for (int i = 0; i < 3; ++i) rows.push_back({{origin, end.place}, {}, i, draft_.quantity(0.0)});
    const ExpressionRotation axes = body.rotation;
    for (std::size_t i = 0; i < 3; ++i) {
      const Place fixed = draft_.direction_on(end.carrier, draft_.in_axes_of(end.carrier, axes[i]));
      const Place next = draft_.point_place(body.triple + 1 + static_cast<int>((i + 1) % 3));
      rows.push_back({{next, {}}, Difference{fixed, {}}, 0, draft_.quantity(0.0)});
    }
    draft_.add_constraint("weld", body.name + " weld", std::move(rows));
  }

  Draft& draft_;
  TableReader& table_;
  std::string name_;
  BeamTable properties_;
  BeamAxis axis_;
  std::size_t first_body_ = 0;
};

std::string section_label(const BeamDraft& beam, std::size_t i) {
  return beam.name + ", quadrature point " + std::to_string(i + 1);
}

}  // namespace

void read_beams(Draft& draft) {
  const std::vector<const Table*> all = tables(draft.scene, std::string(BeamSection::name));
  for (std::size_t i = 0; i < all.size(); ++i) {
    TableReader table = draft.reader(*all[i], "[[beam]] " + std::to_string(i + 1));
    const std::string name = table.text("name");
    if (name.empty()) table.fail("name", "must not be empty");
    const auto is_beam = [&](const BeamDraft& beam) { return beam.name == name; };
    const auto& taken = draft.mass_names;
    if (std::find(taken.begin(), taken.end(), name) != taken.end() ||
        std::any_of(draft.beams.begin(), draft.beams.end(), is_beam))
      table.fail("name", "another beam, body or point is called '" + name + "' already");
    BeamReader(draft, table, name).read();
  }
}

std::vector<std::pair<BeamSection, std::string>> labelled_sections(const Draft& draft) {
  std::vector<std::pair<BeamSection, std::string>> result;
  for (const BeamDraft& beam : draft.beams) {
    for (std::size_t i = 0; i < beam.n_sections; ++i)
      result.emplace_back(draft.beam_sections[beam.first_section + i], section_label(beam, i));
  }
  return result;
}

std::vector<std::pair<BeamDamping, std::string>> read_beam_damping(Draft& draft) {
  std::vector<std::pair<BeamDamping, std::string>> result;
  const std::vector<const Table*> all = tables(draft.scene, std::string(BeamDamping::name));
  for (std::size_t i = 0; i < all.size(); ++i) {
    TableReader table = draft.reader(*all[i], "[[beam_damping]] " + std::to_string(i + 1));
    const std::string name = table.text("beam");
    std::vector<std::string> names;
    for (const BeamDraft& beam : draft.beams) names.push_back(beam.name);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
      table.fail("beam", "no beam is called '" + name + "'; " + suggestion(name, names));
    const Quantity time = draft.quantity(draft.read_number(table, "time", "s", Range::non_negative));
    table.finish();
    const BeamDraft& beam = draft.beams[static_cast<std::size_t>(found - names.begin())];
    for (std::size_t k = 0; k < beam.n_sections; ++k) {
      BeamDamping damping{draft.beam_sections[beam.first_section + k], time};
      result.emplace_back(std::move(damping), section_label(beam, k));
    }
  }
  return result;
}

std::vector<FieldHelp> beam_fields() {
  std::vector<FieldHelp> fields = {
      {"name", "text", "its nodes are the bodies NAME.root, NAME.1, NAME.2, ..., NAME.tip"},
      {"from", "place", "where it begins; welded to the body, or clamped in the frame"},
      {"to", "place", "where it ends; welded to the body, or free if a position is given"},
      {"ends", "two texts", "\"clamped\" or \"free\", for from and to", "as said there"},
      {"elements", "", "number of elements, 1 to 200", "10"},
      {"degree", "", "2: three nodes per element, errors of fourth order; 1: two nodes, second order", "2"},
      {"y_axis", "[x, y, z]", "direction of the y axis of the sections, as far as it is normal to the beam",
       "[0, 1, 0]"}};
  for (FieldHelp& field : beam_table_fields()) fields.push_back(std::move(field));
  return fields;
}

std::vector<FieldHelp> beam_damping_fields() {
  return {{"beam", "name of a beam", "the beam"},
          {"time", "s", "stresses are the stiffness times this times the rates of the strains"}};
}

}  // namespace eigentrail
