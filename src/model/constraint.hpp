// Ideal constraints as data. Every row is the scalar product of two vectors that are linear in the
// coordinates,
//
//     c = (a1 - a2) . (b1 - b2) - offset,
//
// or one component of such a vector, c = (a1 - a2)_i - offset. Lengths, right angles and coinciding places
// have this form. With points and directors as coordinates, all joints consist of such rows: A is linear in x
// there. Motions of joints that are coupled, as by gears, have rows of their own.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/element.hpp"
#include "model/elements/torsion.hpp"

namespace eigentrail {

/// first - second, or only first.
struct Difference {
  Place first;
  std::optional<Place> second;

  bool moves() const { return first.moves() || (second && second->moves()); }
};

/// A ratio times the motion of a joint: its angle or, if it slides, axis . (to - from).
struct CoupledMotion {
  Quantity ratio;
  HingeAngle joint;
  bool slides = false;
};

struct ConstraintRow {
  Difference a;
  std::optional<Difference> b;  ///< if absent, the row is component `axis` of a
  int axis = 0;
  Quantity offset;
  std::vector<CoupledMotion> coupled = {};  ///< if there are such, the row is their sum - offset

  /// Calls visit(place) for all places.
  static void for_each_place(auto& self, const auto& visit) {
    for (auto& motion : self.coupled) {
      for (auto* place : {&motion.joint.axis, &motion.joint.from, &motion.joint.to}) visit(*place);
    }
    if (!self.coupled.empty()) return;
    for (auto* side : {&self.a, self.b ? &*self.b : nullptr}) {
      if (side == nullptr) continue;
      visit(side->first);
      if (side->second) visit(*side->second);
    }
  }
};

/// A constraint of the scene: its rows, with one multiplier each.
struct Constraint {
  int kind = 0;  ///< index into constraint_kinds()
  std::string label;
  std::vector<ConstraintRow> rows;
  int first_row = 0;
};

}  // namespace eigentrail
