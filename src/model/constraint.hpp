// Ideal constraints as data. Every row is the scalar product of two vectors that are linear in the
// coordinates,
//
//     c = (a1 - a2) . (b1 - b2) - offset,
//
// or one component of such a vector, c = (a1 - a2)_i - offset. Lengths, right angles and coinciding places
// have this form. With points and directors as coordinates, all joints consist of such rows. A is then linear
// in x and (A^T lambda)_/x is constant in x; both are formed without differentiation.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/element.hpp"

namespace eigentrail {

/// first - second, or only first.
struct Difference {
  Place first;
  std::optional<Place> second;

  bool moves() const { return first.moves() || (second && second->moves()); }
};

struct ConstraintRow {
  Difference a;
  std::optional<Difference> b;  ///< if absent, the row is component `axis` of a
  int axis = 0;
  Quantity offset;
};

/// A constraint of the scene: its rows, with one multiplier each.
struct Constraint {
  int kind = 0;  ///< index into constraint_kinds()
  std::string label;
  std::vector<ConstraintRow> rows;
  int first_row = 0;
};

}  // namespace eigentrail
