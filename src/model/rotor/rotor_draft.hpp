// Intermediate data of reading a rotor: shafts with their nodes and freedoms, and the matrices as they grow.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "eigentrail/model/affine_family.hpp"
#include "model/csv_table.hpp"
#include "model/draft.hpp"
#include "model/rotor/shaft_element.hpp"

namespace eigentrail {

/// One of the matrices M, C and K as it is put together. What has the same factor is one matrix.
class MatrixSum {
 public:
  /// Adds `factor` * `value` at a row and a column; nothing where one of them is negative (a freedom that is
  /// held) or the value is zero. Constant factors are multiplied into the value. If there is a table, its
  /// function of `factor` takes the place of the factor.
  void add(Eigen::Index row, Eigen::Index column, const Expression& factor, double value = 1.0,
           const std::shared_ptr<const TabulatedFactor>& table = nullptr);
  /// Adds `factor` * `entry` * `value`; constant entries are multiplied into the value.
  void add_product(Eigen::Index row, Eigen::Index column, const Expression& factor, const Expression& entry,
                   double value);

  /// Adds all entries of another sum, times `strength`.
  void add(const MatrixSum& other, const Expression& strength);

  bool empty() const { return parts_.empty(); }

  /// The summands, n x n.
  template <class Storage>
  std::vector<AffineTerm<Storage>> terms(Eigen::Index n) const;

 private:
  struct Part {
    Expression factor;
    std::shared_ptr<const TabulatedFactor> table;
    Expression scale = 1.0;  ///< of the tabulated function
    std::map<std::pair<Eigen::Index, Eigen::Index>, double> entries = {};
  };

  Part& part(const Expression& factor, const std::shared_ptr<const TabulatedFactor>& table,
             const Expression& scale = 1.0);

  std::vector<Part> parts_;
};

/// M, C and K.
struct PencilSum {
  MatrixSum M, C, K;
};

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

/// Reads the [[bearing]] tables and adds their matrices.
void read_bearings(RotorDraft& rotor);

}  // namespace eigentrail
