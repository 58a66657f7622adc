// A computation as a list of operations. It has no numbers but those of the source: what differs between
// elements of one structure (stiffness, weights, positions) are inputs, so they share one record.
//
// A *component* is a quantity by which the outputs are differentiated: a component of the position of a
// moving vector, or a state. It has a rate and an acceleration, which are zero at the steady state and serve
// as directions of differentiation only. Components are linear in the local coordinates of the element. This
// keeps the directions few: three for each vector, independent of the number of coordinates that form it.
#pragma once

#include <cstdint>
#include <vector>

namespace eigentrail {

class SmoothFunction;

enum class Operator : std::uint8_t {
  constant,
  number,        ///< input with index a
  coordinate,    ///< local coordinate with index a
  component,     ///< component b, of value a
  rate,          ///< of component b
  acceleration,  ///< of component b
  add,
  subtract,
  multiply,
  divide,
  negate,
  sqrt,
  exp,
  log,
  sin,
  cos,
  sinh,
  cosh,
  tanh,
  asin,
  acos,
  atan,
  power,
  min,
  max,
  step,
  leading_angle,  ///< atan2(a, b) of the leading values, a constant
  function,       ///< function with index b of a
  // Only in programs
  multiply_add,     ///< a b + c
  multiply_two,     ///< a b + c d
  multiply_behind,  ///< c - a b
  choose_min,       ///< c where a is the minimum of a and b, else d
  choose_max
};

/// `a` and `b` are indices of operations before this one, unless the operator says otherwise.
struct Operation {
  Operator op = Operator::constant;
  int a = -1, b = -1;
  double constant = 0.0;

  bool operator==(const Operation&) const = default;
};

/// A local coordinate of a component, and the operation that is its weight (-1: one).
struct Share {
  int coordinate = 0;
  int weight = -1;

  bool operator==(const Share&) const = default;
};

struct Record {
  std::vector<Operation> operations;
  std::vector<std::vector<Share>> components;  ///< what forms each of them
  std::vector<int> forces;                     ///< operation that is the force on each component; -1: none
  int residual = -1;  ///< operation that is the left side of an equation c = 0; -1: none
  int strength = -1;  ///< operation that multiplies all forces; -1: one
  int n_numbers = 0;  ///< inputs
  int n_coordinates = 0;
  int n_functions = 0;
  std::vector<int> values;  ///< operations whose values are wanted by themselves

  bool operator==(const Record&) const = default;
};

}  // namespace eigentrail
