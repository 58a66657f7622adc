#include "model/model_readers.hpp"

#include <algorithm>
#include <numbers>

#include "core/texts.hpp"
#include "eigentrail/core/text.hpp"
#include "model/affine_factor.hpp"
#include "model/rotor/rotor_draft.hpp"

namespace eigentrail {
namespace {

struct DiscInertia {
  Expression mass, diametral, polar;
};

/// m = rho pi (Do^2 - Di^2) w / 4, Ip = m (Do^2 + Di^2) / 8, Id = Ip / 2 + m w^2 / 12.
DiscInertia inertia_of_cylinder(const Draft& draft, TableReader& table) {
  const Expression outer = draft.read_number(table, "outer", "m", Range::positive);
  const Expression inner = draft.read_number(table, "inner", "m", Range::non_negative, 0.0);
  const Expression width = draft.read_number(table, "width", "m", Range::positive);
  const Expression density = draft.read_number(table, "density", "kg/m^3", Range::positive);
  const std::vector<double> outside = draft.check_values(outer), inside = draft.check_values(inner);
  for (std::size_t i = 0; i < outside.size(); ++i) {
    if (!(inside[i] < outside[i]))
      table.fail("inner", "must be less than the outer diameter, " + exact_text(outside[i]) + " m; found " +
                              exact_text(inside[i]) + " m" + Draft::where_on_trace(i));
  }
  const Expression squares = outer * outer, holes = inner * inner;
  const Expression mass = Expression(std::numbers::pi / 4.0) * density * (squares - holes) * width;
  const Expression polar = mass * (squares + holes) / Expression(8.0);
  return {mass, polar / Expression(2.0) + mass * width * width / Expression(12.0), polar};
}

DiscInertia inertia_of_numbers(const Draft& draft, TableReader& table) {
  for (const char* key : {"outer", "inner", "width", "density"}) {
    if (table.has(key))
      table.fail(key, "the mass is given already; a disc has mass, Id and Ip, or outer, width and density");
  }
  const DiscInertia disc{draft.read_number(table, "mass", "kg", Range::non_negative),
                         draft.read_number(table, "Id", "kg m^2", Range::non_negative, 0.0),
                         draft.read_number(table, "Ip", "kg m^2", Range::non_negative, 0.0)};
  const std::vector<double> diametral = draft.check_values(disc.diametral);
  const std::vector<double> polar = draft.check_values(disc.polar);
  constexpr double rounding = 1e-9;  // of a thin disc whose Id and Ip = 2 Id are given with few digits less
  for (std::size_t i = 0; i < polar.size(); ++i) {
    if (polar[i] > 2.0 * diametral[i] * (1.0 + rounding))
      table.fail("Ip", "no disc has more than 2 Id, here " + exact_text(2.0 * diametral[i]) +
                           " kg m^2 (thin disc: Ip = 2 Id); found " + exact_text(polar[i]) +
                           Draft::where_on_trace(i));
  }
  return disc;
}

void add_disc(RotorDraft& rotor, const NodePlace& place, const DiscInertia& disc) {
  const NodeCoordinates& at = rotor.at(place);
  const Expression& speed = rotor.shafts[place.shaft].speed;
  MatrixSum& inertia = rotor.sum(RotorEffect::disc).M;
  for (const NodeFreedom freedom : {along_x, along_y, along_z})
    inertia.add(at[freedom], at[freedom], disc.mass);
  for (const NodeFreedom freedom : {about_x, about_y}) inertia.add(at[freedom], at[freedom], disc.diametral);
  inertia.add(at[about_z], at[about_z], disc.polar);
  MatrixSum& gyroscopic = rotor.sum(RotorEffect::gyroscopic).C;
  gyroscopic.add_product(at[about_x], at[about_y], speed, disc.polar, 1.0);
  gyroscopic.add_product(at[about_y], at[about_x], speed, disc.polar, -1.0);
  rotor.count(RotorEffect::disc);
  rotor.count(RotorEffect::gyroscopic);
}

/// Reads the [[disc]] tables, rigid discs on nodes of shafts, and adds their matrices.
void read_discs(RotorDraft& rotor) {
  rotor.draft.for_each_table("disc", [&](TableReader& table, std::size_t i) {
    const std::vector<NodePlace> places = rotor.read_nodes(table, "node");
    const DiscInertia disc = table.has("mass") || !table.has("outer")
                                 ? inertia_of_numbers(rotor.draft, table)
                                 : inertia_of_cylinder(rotor.draft, table);
    if (table.has("name")) (void)table.text("name");
    table.finish();
    for (const NodePlace& place : places) add_disc(rotor, place, disc);
    const auto name_of = [&](const NodePlace& place) { return rotor.name_of(place); };
    rotor.draft.notes.emplace_back(
        "disc " + std::to_string(i + 1),
        short_text(rotor.first_value(disc.mass), 6) + " kg at " + joined(places, ", ", name_of));
  });
}

struct EffectWords {
  const char* name;
  const char* description;
};

/// In the order of RotorEffect.
constexpr std::array<EffectWords, rotor_effect_count> words = {{
    {"shaft", "elastic forces of the shaft's elements"},
    {"shaft_mass", "inertia of the shaft's elements"},
    {"disc", "inertia of the discs"},
    {"gyroscopic", "gyroscopic moments of shafts and discs"},
    {"shaft_damping", "damping of shafts that does not rotate: alpha, beta"},
    {"internal_damping", "damping that rotates with the shaft"},
    {"bearing", "stiffness and damping of the bearings"},
    {"seal", "stiffness, damping and mass of bearings with added mass"},
    {"support", "freedoms that do not move"},
}};

bool is_empty(const PencilSum& sum) {
  return sum.M.empty() && sum.C.empty() && sum.K.empty();
}

Contribution contribution_of(const PencilSum& sum, Eigen::Index n) {
  const auto M = sum.M.terms<SparseMatrix>(n), C = sum.C.terms<SparseMatrix>(n),
             K = sum.K.terms<SparseMatrix>(n);
  const bool symmetric = all_equal_transposes(C, 1.0);
  return {.inertia = !M.empty(),
          .conservative = !K.empty(),
          .circulatory = !all_equal_transposes(K, 1.0),
          .dissipative = !C.empty() && (symmetric || !all_equal_transposes(C, -1.0)),
          .gyroscopic = !symmetric};
}

/// Throws InputError if an effect that the request leaves out is not in the scene, or cannot be left out.
void check_rotor_without(const RotorDraft& rotor) {
  std::vector<std::string> can;
  for (std::size_t i = 0; i < rotor_effect_count; ++i) {
    if (!is_empty(rotor.sums[i]) && i != static_cast<std::size_t>(RotorEffect::shaft))
      can.emplace_back(words[i].name);
  }
  for (const std::string& name : rotor.draft.request.without) {
    if (std::find(can.begin(), can.end(), name) != can.end()) continue;
    std::string why = "is no effect of this rotor; ";
    if (name == "shaft") why = "cannot be left out: without its elastic forces there is no rotor; ";
    if (name == "support") why = "cannot be left out: it holds freedoms; remove its table; ";
    throw without_error(rotor.draft.scene, name, why + suggestion(name, can));
  }
}

/// The effects of the scene, in order, with what each of them contributes to n x n matrices.
std::vector<Effect> rotor_effects(const RotorDraft& rotor, Eigen::Index n) {
  std::vector<Effect> effects;
  for (std::size_t i = 0; i < rotor_effect_count; ++i) {
    Effect& effect = effects.emplace_back(Effect{words[i].name, words[i].description, 0, {}});
    if (i == static_cast<std::size_t>(RotorEffect::support)) {
      effect.count = rotor.counts[i];
      effect.contribution.constraint = true;
    } else if (!is_empty(rotor.sums[i]) && !rotor.draft.is_left_out(words[i].name)) {
      effect.count = rotor.counts[i];
      effect.contribution = contribution_of(rotor.sums[i], n);
    }
  }
  return effects;
}

/// The sum of all effects that are not left out. Each is multiplied by its strength, if strengths are asked
/// for.
PencilSum sum_of_effects(RotorDraft& rotor) {
  PencilSum all;
  for (std::size_t i = 0; i < rotor_effect_count; ++i) {
    if (is_empty(rotor.sums[i]) || rotor.draft.is_left_out(words[i].name)) continue;
    const Quantity strength = rotor.draft.strength(words[i].name);
    const Expression factor = rotor.draft.request.strengths ? strength.expression : Expression(1.0);
    all.M.add(rotor.sums[i].M, factor);
    all.C.add(rotor.sums[i].C, factor);
    all.K.add(rotor.sums[i].K, factor);
  }
  return all;
}

/// Up to this size matrices are dense, so that structure that all of them share is found: independent planes
/// of a symmetric rotor. Larger ones are sparse, and projected where some modes are asked for.
constexpr std::size_t largest_dense_rotor = 150;

/// Reads the [[support]] tables: freedoms of nodes that do not move.
void read_supports(RotorDraft& rotor) {
  rotor.draft.for_each_table("support", [&](TableReader& table, std::size_t) {
    const std::vector<NodePlace> places = rotor.read_nodes(table, "node");
    rotor.count(RotorEffect::support);
    const std::vector<std::string> holds =
        table.has("holds") ? table.texts("holds") : std::vector<std::string>{"x", "y"};
    if (table.has("name")) (void)table.text("name");
    table.finish();
    for (const std::string& held : holds) {
      const auto found = std::find(freedom_names.begin(), freedom_names.end(), held);
      if (found == freedom_names.end())
        table.fail("holds", "'" + held + "' is no freedom of a node; " +
                                suggestion(held, {freedom_names.begin(), freedom_names.end()}));
      for (const NodePlace& place : places)
        rotor.shafts[place.shaft].held[place.node][static_cast<std::size_t>(found - freedom_names.begin())] =
            true;
    }
  });
}

/// Adds a coordinate, and returns its index.
Eigen::Index new_coordinate(RotorDraft& rotor, const std::string& of, const char* freedom) {
  rotor.coordinate_names.push_back(of + ": " + freedom);
  rotor.coordinate_units.emplace_back(freedom[0] == 'r' ? "rad" : "m");
  return static_cast<Eigen::Index>(rotor.coordinate_names.size()) - 1;
}

/// Numbers the freedoms that are left, node by node, each element's inner ones behind its first node.
void number_freedoms(RotorDraft& rotor) {
  for (ShaftDraft& shaft : rotor.shafts) {
    for (std::size_t node = 0; node < shaft.held.size(); ++node) {
      NodeCoordinates& coordinates = shaft.nodes.emplace_back();
      coordinates.fill(-1);
      for (std::size_t freedom = 0; freedom < freedom_names.size(); ++freedom) {
        if (!shaft.held[node][freedom])
          coordinates[freedom] = new_coordinate(rotor, shaft.node_name(node), freedom_names[freedom]);
      }
      if (!shaft.refined || node + 1 == shaft.held.size()) continue;
      InnerCoordinates& inner = shaft.inner.emplace_back();
      for (std::size_t freedom = 0; freedom < inner.size(); ++freedom)
        inner[freedom] = new_coordinate(rotor, shaft.element_name(node), freedom_names[freedom]);
    }
  }
}

/// The nodes of a shaft and its rotation, for orbits.
SpinningShaft spinning_shaft(const RotorDraft& rotor, const ShaftDraft& shaft) {
  SpinningShaft result{shaft.name, shaft.speed, {rotor.first_value(shaft.position)}, {}};
  for (const ShaftSegment& segment : shaft.segments) {
    const double step = rotor.first_value(segment.length) / segment.elements;
    for (int i = 0; i < segment.elements; ++i) result.places.push_back(result.places.back() + step);
  }
  for (const NodeCoordinates& node : shaft.nodes) result.nodes.push_back({node[along_x], node[along_y]});
  return result;
}

/// Length, elements and mass of a shaft, in words.
std::string shaft_in_words(const RotorDraft& rotor, const ShaftDraft& shaft) {
  double length = 0.0, mass = 0.0;
  for (const ShaftSegment& segment : shaft.segments) {
    const ShaftPiece piece{segment.length, segment.outer, segment.inner, {}, {}, {}, {}};
    length += rotor.first_value(segment.length);
    mass += rotor.first_value(shaft.density * piece.area() * segment.length);
  }
  return short_text(length, 6) + " m, " + short_text(mass, 6) + " kg, " +
         std::to_string(shaft.nodes.size() - 1) + (shaft.nodes.size() == 2 ? " element, " : " elements, ") +
         "nodes 1 to " + std::to_string(shaft.nodes.size());
}

ModelDescription describe(RotorDraft& rotor) {
  ModelDescription description;
  for (const ShaftDraft& shaft : rotor.shafts) {
    description.shafts.push_back(spinning_shaft(rotor, shaft));
    description.data.emplace_back(shaft.name.empty() ? "shaft" : "shaft " + shaft.name,
                                  shaft_in_words(rotor, shaft));
  }
  description.data.insert(description.data.end(), rotor.draft.notes.begin(), rotor.draft.notes.end());
  description.coordinate_names = std::move(rotor.coordinate_names);
  description.coordinate_units = std::move(rotor.coordinate_units);
  description.effects = rotor_effects(rotor, static_cast<Eigen::Index>(description.coordinate_names.size()));
  description.parameters = rotor.draft.parameters();
  description.unused_parameters = unused_parameters(rotor.draft.scene, rotor.draft.used);
  return description;
}

template <class Storage>
std::unique_ptr<Model> family_of(RotorDraft& rotor) {
  const auto n = static_cast<Eigen::Index>(rotor.coordinate_names.size());
  const PencilSum all = sum_of_effects(rotor);
  AffinePencil<Storage> pencil{all.M.terms<Storage>(n), all.C.terms<Storage>(n), all.K.terms<Storage>(n)};
  return std::make_unique<AffineFamily<Storage>>(describe(rotor), std::move(pencil));
}

}  // namespace

std::unique_ptr<Model> read_rotor(const Scene& scene, const ModelRequest& request) {
  RotorDraft rotor(scene, request);
  try {
    read_shafts(rotor);
    read_supports(rotor);
    number_freedoms(rotor);
    if (rotor.coordinate_names.empty())
      throw scene_error(scene, tables(scene, "support").front()->where,
                        "[[support]]: the supports hold all freedoms; nothing can move");
    assemble_shafts(rotor);
    read_discs(rotor);
    read_bearings(rotor);
    check_rotor_without(rotor);
    if (rotor.coordinate_names.size() > largest_dense_rotor) return family_of<SparseMatrix>(rotor);
    return family_of<Matrix>(rotor);
  } catch (const ExpressionError& error) {
    throw scene_error(scene, rotor.draft.begun_where, rotor.draft.begun + ": " + error.what());
  }
}

}  // namespace eigentrail
