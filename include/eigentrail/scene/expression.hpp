// Arithmetic expressions of the scene's parameters. They can be evaluated with any scalar type (numbers,
// series, nested series).
//
// Grammar:  sum     = product { ("+" | "-") product }
//           product = signed { ("*" | "/") signed }
//           signed  = [ "+" | "-" ] signed | power
//           power   = primary [ "^" signed ]                 right-associative, binds tighter than the sign
//           primary = number | "pi" | parameter | function "(" sum ")" | "(" sum ")"
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "eigentrail/core/series.hpp"

namespace eigentrail {

/// A text that is not a valid expression: what is wrong, and the offset of the character (from 0) in the
/// text.
class ExpressionError : public std::runtime_error {
 public:
  ExpressionError(const std::string& message, std::size_t at) : std::runtime_error(message), offset(at) {}
  std::size_t offset;
};

class Expression {
 public:
  enum class Op {
    number,
    parameter,
    add,
    subtract,
    multiply,
    divide,
    negate,
    power,
    integer_power,
    sqrt,
    sin,
    cos,
    tan,
    asin,
    acos,
    atan,
    sinh,
    cosh,
    tanh,
    exp,
    log
  };
  struct Instruction {
    Op op = Op::number;
    double number = 0.0;  ///< value of a number, or exponent of an integer power
    int parameter = -1;   ///< index of a parameter

    bool operator==(const Instruction&) const = default;
  };

  /// Size of the evaluation stack; `parse` rejects expressions that need more.
  static constexpr int max_stack = 64;

  Expression(double constant = 0.0) : code_{{Op::number, constant}} {}  // NOLINT: numbers are expressions

  /// Whether both are the same sequence of operations, not whether they are equal as functions.
  bool operator==(const Expression& other) const { return code_ == other.code_; }

  /// The parameter with this index.
  static Expression of_parameter(int index);

  /// Compiles `text`; a name in it denotes the parameter at the same index of `names`. Throws ExpressionError
  /// with the offset of the fault.
  static Expression parse(std::string_view text, const std::vector<std::string>& names);

  /// Makes scalars of the numbers of an expression.
  template <class Scalar>
  struct Number {
    Scalar operator()(double value) const { return Scalar(value); }
  };

  /// Value for given parameter values (SI), one for each name that `parse` got.
  template <class Scalar, class MakeNumber = Number<Scalar>>
  Scalar evaluate(std::span<const Scalar> parameters, MakeNumber number = {}) const;

  bool is_constant() const { return parameters_.empty(); }

  /// Its instructions in postfix notation: operands before their operation.
  const std::vector<Instruction>& code() const { return code_; }

  /// Number of its instructions: numbers, parameters and operations.
  std::size_t size() const { return code_.size(); }

  /// Indices of the parameters that occur, each once, in increasing order.
  const std::vector<int>& parameters() const { return parameters_; }

  // Composition. Constant results are computed at once, and sums with zero and products with zero or one
  // produce no instructions. All throw ExpressionError if the result needs a deeper stack than `max_stack`,
  // or has more than limits::expression_operations instructions.
  friend Expression operator+(const Expression& a, const Expression& b);
  friend Expression operator-(const Expression& a, const Expression& b);
  friend Expression operator*(const Expression& a, const Expression& b);
  friend Expression operator/(const Expression& a, const Expression& b);
  friend Expression operator-(const Expression& a) { return compose(Op::negate, a); }
  friend Expression sin(const Expression& a) { return compose(Op::sin, a); }
  friend Expression cos(const Expression& a) { return compose(Op::cos, a); }
  friend Expression sqrt(const Expression& a) { return compose(Op::sqrt, a); }

 private:
  friend class ExpressionParser;
  bool is(double number) const { return is_constant() && code_.size() == 1 && code_[0].number == number; }
  Expression folded() const;
  static Expression compose(Op op, const Expression& a);
  static Expression compose(Op op, const Expression& a, const Expression& b);

  std::vector<Instruction> code_;  ///< in postfix notation
  std::vector<int> parameters_;
};

namespace detail {

template <class Scalar>
Scalar apply(Expression::Op op, const Scalar& x) {
  // Standard functions for numbers; argument-dependent lookup finds those for series.
  using std::acos, std::asin, std::atan, std::cos, std::cosh, std::exp, std::log, std::sin, std::sinh,
      std::sqrt, std::tan, std::tanh;
  switch (op) {
    case Expression::Op::negate:
      return -x;
    case Expression::Op::sqrt:
      return sqrt(x);
    case Expression::Op::sin:
      return sin(x);
    case Expression::Op::cos:
      return cos(x);
    case Expression::Op::tan:
      return tan(x);
    case Expression::Op::asin:
      return asin(x);
    case Expression::Op::acos:
      return acos(x);
    case Expression::Op::atan:
      return atan(x);
    case Expression::Op::sinh:
      return sinh(x);
    case Expression::Op::cosh:
      return cosh(x);
    case Expression::Op::tanh:
      return tanh(x);
    case Expression::Op::exp:
      return exp(x);
    default:
      return log(x);
  }
}

template <class Scalar>
Scalar apply(Expression::Op op, const Scalar& a, const Scalar& b) {
  using std::pow;
  switch (op) {
    case Expression::Op::add:
      return a + b;
    case Expression::Op::subtract:
      return a - b;
    case Expression::Op::multiply:
      return a * b;
    case Expression::Op::divide:
      return a / b;
    default:
      return pow(a, b);
  }
}

}  // namespace detail

template <class Scalar, class MakeNumber>
Scalar Expression::evaluate(std::span<const Scalar> parameters, MakeNumber number) const {
  if (is_constant() && code_.size() == 1) return number(code_[0].number);
  std::array<Scalar, max_stack> stack{};
  int top = -1;
  for (const Instruction& i : code_) {
    switch (i.op) {
      case Op::number:
        stack[++top] = number(i.number);
        break;
      case Op::parameter:
        stack[++top] = parameters[i.parameter];
        break;
      case Op::integer_power:
        stack[top] = integer_power(stack[top], static_cast<int>(i.number));
        break;
      case Op::add:
      case Op::subtract:
      case Op::multiply:
      case Op::divide:
      case Op::power:
        --top;
        stack[top] = detail::apply(i.op, stack[top], stack[top + 1]);
        break;
      default:
        stack[top] = detail::apply(i.op, stack[top]);
    }
  }
  return stack[0];
}

}  // namespace eigentrail
