#include "model/model_readers.hpp"

#include <algorithm>

#include "core/texts.hpp"
#include "eigentrail/model/affine_family.hpp"
#include "model/rotor/rotor_draft.hpp"

namespace eigentrail {
namespace {

/// Up to this size matrices are dense, so that structure that all of them share is found: independent planes
/// of a symmetric rotor. Larger ones are sparse, and projected where some modes are asked for.
constexpr Eigen::Index largest_dense_rotor = 150;

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

std::vector<AffineTerm<Matrix>> dense(const std::vector<AffineTerm<SparseMatrix>>& terms) {
  std::vector<AffineTerm<Matrix>> result;
  for (const AffineTerm<SparseMatrix>& term : terms) {
    auto& one = result.emplace_back(term.factor, Matrix(term.matrix), term.name);
    one.table = term.table;
    one.scale = term.scale;
  }
  return result;
}

std::unique_ptr<Model> family_of(RotorDraft& rotor) {
  const auto n = static_cast<Eigen::Index>(rotor.coordinate_names.size());
  check_rotor_without(rotor);
  AffinePencil<SparseMatrix> pencil = pencil_of_effects(rotor, n);
  ModelDescription description = describe(rotor);
  if (n > largest_dense_rotor)
    return std::make_unique<SparseFamily>(std::move(description), std::move(pencil));
  return std::make_unique<AffineFamily<Matrix>>(
      std::move(description), AffinePencil<Matrix>{dense(pencil.M), dense(pencil.C), dense(pencil.K)});
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
    return family_of(rotor);
  } catch (const ExpressionError& error) {
    throw scene_error(scene, rotor.draft.begun_where, rotor.draft.begun + ": " + error.what());
  }
}

}  // namespace eigentrail
