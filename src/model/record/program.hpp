// Instructions that evaluate a record: its values, and its derivatives in forward mode with only those
// directions on which an operation depends (Griewank & Walther, Evaluating Derivatives, 2nd ed., Ch. 3, 7).
//
// A record becomes instructions backwards from what is wanted, so what nothing wants is not computed. Rates
// and accelerations are zero at the steady state: products with them have no value, only derivatives. The
// derivatives of the forces F by components q = W x, x the local coordinates, are first formed by component
// and then give W^T F_/q W.
#pragma once

#include <cstdint>
#include <vector>

#include "model/record/record.hpp"

namespace eigentrail {

/// Computes a power series along the path from others, which are in slots. log, asin, acos and atan have
/// their derivative as operand b; sin and sinh, and functions, a second result: cos, cosh, the derivative.
struct Instruction {
  Operator op = Operator::constant;
  int out = -1;  ///< slot of the result
  int a = -1, b = -1, c = -1, d = -1;
  int second = -1;
  double constant = 0.0;
};

enum class Target : std::uint8_t { mass, damping, stiffness, constraints };

/// A derivative by local coordinates: d(force on `row`)/d(coordinate, rate or acceleration of `column`), or
/// of the residual of a constraint.
struct Entry {
  Target target;
  int row = 0, column = 0, slot = -1;
};

struct LocalValue {
  int index = 0, slot = -1;
};

struct Program {
  std::vector<Instruction> constants;     ///< the same for every element
  std::vector<Instruction> instructions;  ///< in this order
  int n_slots = 0;
  std::vector<LocalValue> numbers, coordinates;  ///< slots of the inputs that are used
  std::vector<LocalValue> forces;                ///< by local coordinate
  std::vector<LocalValue> values;                ///< by index in Record::values
  int residual = -1;                             ///< slot
  std::vector<Entry> entries;
  int n_directions = 0;  ///< of differentiation that something depends on
};

/// The forces by local coordinate, the residual and the wanted values.
Program value_program(const Record& record);

/// The derivatives of forces and residual.
Program derivative_program(const Record& record);

}  // namespace eigentrail
