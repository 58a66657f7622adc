// Intermediate data of reading a rotor: shafts with their nodes and freedoms, and the matrices as they grow.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "model/csv_table.hpp"
#include "model/draft.hpp"
#include "model/rotor/pencil_sum.hpp"
#include "model/rotor/shaft_element.hpp"

namespace eigentrail {

/// The effects that a rotor is made of: what `explain` lists, what a strength multiplies and what --without
/// leaves out.
enum class RotorEffect : std::size_t {
  shaft,             ///< elastic forces of shafts
  shaft_mass,        ///< inertia of shafts
  disc,              ///< inertia of discs
  gyroscopic,        ///< gyroscopic moments of shafts and discs
  shaft_damping,     ///< damping of shafts that does not rotate
  internal_damping,  ///< damping that rotates with the shaft
  bearing,
  seal,  ///< bearings with added mass
  support,
};
inline constexpr std::size_t rotor_effect_count = 9;

/// Freedoms of a node: displacements along x, y, z and rotations about them, right-handed; z is the axis.
enum NodeFreedom : std::size_t { along_x, along_y, about_x, about_y, along_z, about_z };
inline constexpr std::array<const char*, 6> freedom_names = {"x", "y", "rx", "ry", "z", "rz"};

/// Coordinate of each freedom; -1: not among those of the shaft, or held by a support.
using NodeCoordinates = std::array<Eigen::Index, 6>;

/// The coordinates of an element's inner freedoms, by x, y, rx and ry.
using InnerCoordinates = std::array<Eigen::Index, 4>;

/// A uniform piece of a shaft, as many elements of one length.
struct ShaftSegment {
  Expression length, outer, inner;
  int elements = 1;
};

struct ShaftDraft {
  std::string name;  ///< empty if the scene has one shaft without a name
  std::vector<ShaftSegment> segments;
  Expression position;  ///< of the first node along z, m
  Expression E, G, density, speed;
  Expression nu;                    ///< for the shear coefficient
  std::optional<Expression> shear;  ///< given shear coefficient
  Expression alpha, beta, internal;
  bool axial = false, torsion = false;
  bool refined = false;  ///< whether elements have inner freedoms
  std::vector<NodeCoordinates> nodes;
  std::vector<std::array<bool, 6>> held;
  std::vector<InnerCoordinates> inner;  ///< per element; empty unless refined

  /// "node 3" or "inner node 3" for the index 2.
  std::string node_name(std::size_t node) const;
  /// "element 3" or "inner element 3".
  std::string element_name(std::size_t element) const;
};

/// A node: indices from 0.
struct NodePlace {
  std::size_t shaft = 0, node = 0;
};

struct RotorDraft {
  RotorDraft(const Scene& scene, const ModelRequest& request) : draft(scene, request) {}

  Draft draft;
  std::vector<ShaftDraft> shafts;
  std::array<PencilSum, rotor_effect_count> sums;  ///< of each effect
  std::array<int, rotor_effect_count> counts{};    ///< how many tables or nodes have it
  std::vector<std::string> coordinate_names, coordinate_units;

  PencilSum& sum(RotorEffect effect) { return sums[static_cast<std::size_t>(effect)]; }
  void count(RotorEffect effect) { ++counts[static_cast<std::size_t>(effect)]; }
  const NodeCoordinates& at(const NodePlace& place) const { return shafts[place.shaft].nodes[place.node]; }
  std::string name_of(const NodePlace& place) const { return shafts[place.shaft].node_name(place.node); }

  /// Reads a key with one node or a list of nodes: 3, "node 3" or "inner node 3", counted from 1.
  std::vector<NodePlace> read_nodes(TableReader& table, const std::string& key) const;

  /// The first of the values at which the scene is checked.
  double first_value(const Expression& expression) const;
};

/// Reads the [[shaft]] tables (read_shafts.cpp); without nodes' coordinates.
void read_shafts(RotorDraft& rotor);

/// Adds the matrices of the shafts, whose nodes have coordinates (assemble_shafts.cpp).
void assemble_shafts(RotorDraft& rotor);

/// Read the [[disc]] tables and the [[bearing]] tables, and add their matrices.
void read_discs(RotorDraft& rotor);
void read_bearings(RotorDraft& rotor);

/// Throws InputError if an effect that the request leaves out is not in the scene, or cannot be left out.
void check_rotor_without(const RotorDraft& rotor);

/// The effects of the scene, in order, with what each of them contributes to n x n matrices.
std::vector<Effect> rotor_effects(const RotorDraft& rotor, Eigen::Index n);

/// The sum of all effects that are not left out. Each is multiplied by its strength, if strengths are asked
/// for.
AffinePencil<SparseMatrix> pencil_of_effects(RotorDraft& rotor, Eigen::Index n);

}  // namespace eigentrail
