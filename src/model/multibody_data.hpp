// What a multibody scene consists of.
#pragma once

#include <variant>
#include <vector>

#include "model/registry.hpp"

namespace eigentrail {

// Conditions at the equilibrium that determine trimmed parameters: quantity = target.
//
// Places and angles follow from the coordinates alone: such a condition is a row as those of constraints,
// whose offset is the target. A force or moment is the virtual work of some elements and constraints on a
// virtual motion w(x) of triples, a translation or rotation of unit amount:
//
//     quantity = w . (f - A^T lambda),   w = e at places in a translation along e,
//                                        w = e x (x - centre) at places, e x d at directions in a rotation
//
// so that it is known for every element and constraint that gives a force.

/// A virtual motion of unit amount.
struct VirtualMotion {
  Place axis;                   ///< direction e; may move
  std::optional<Place> about;   ///< rotation about the axis through this place; absent: translation along it
  std::vector<int> places;      ///< triples that are positions
  std::vector<int> directions;  ///< triples that are directions; a translation leaves them alone
  double factor = 1.0;          ///< of the quantity: -1 for the reverse, N for N equal blades
};

/// Force or moment of these elements and constraints.
struct TrimLoad {
  Elements elements;
  std::vector<Constraint> constraints;
  VirtualMotion motion;
};

struct TrimCondition {
  int parameter = -1;  ///< index of the unknown
  std::variant<TrimLoad, ConstraintRow> quantity;
  Quantity target;
  std::string text;  ///< the condition as the scene states it
};

/// The data of a multibody model. Counters of constraint kinds follow those of elements.
struct MultibodyData {
  Elements elements;
  std::vector<Constraint> constraints;
  std::vector<TrimCondition> trims;
  std::vector<Expression> quantities;  ///< by Quantity::slot
  Parameters parameters;
  int n_triples = 0;      ///< of points and bodies
  int n_coordinates = 0;  ///< 3 n_triples, and one for each state of an element
  int n_constraints = 0;
};

}  // namespace eigentrail
