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
#include "eigentrail/core/types.hpp"

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

  /// Whether an operation takes two operands.
  static constexpr bool is_binary(Op op) {
    return op == Op::add || op == Op::subtract || op == Op::multiply || op == Op::divide || op == Op::power;
  }

  /// The parameter with this index.
  static Expression of_parameter(int index) {
    Expression result;
    result.code_ = {{Op::parameter, 0.0, index}};
    result.parameters_ = {index};
    return result;
  }

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

  /// The same for numbers; a constant needs none.
  double value(const Vector& si = {}) const {
    return evaluate(std::span<const double>(si.data(), static_cast<std::size_t>(si.size())));
  }

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
  friend Expression operator+(const Expression& a, const Expression& b) {
    if (a.is(0.0)) return b;
    return b.is(0.0) ? a : compose(Op::add, a, b);
  }
  friend Expression operator-(const Expression& a, const Expression& b) {
    if (a.is(0.0)) return -b;
    return b.is(0.0) ? a : compose(Op::subtract, a, b);
  }
  friend Expression operator*(const Expression& a, const Expression& b) {
    if (a.is(0.0) || b.is(0.0)) return {0.0};
    if (a.is(1.0)) return b;
    return b.is(1.0) ? a : compose(Op::multiply, a, b);
  }
  friend Expression operator/(const Expression& a, const Expression& b) {
    if (a.is(0.0)) return {0.0};
    return b.is(1.0) ? a : compose(Op::divide, a, b);
  }
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
  using Op = Expression::Op;
  if (op == Op::negate) return -x;
  if (op == Op::sqrt) return sqrt(x);
  if (op == Op::sin) return sin(x);
  if (op == Op::cos) return cos(x);
  if (op == Op::tan) return tan(x);
  if (op == Op::asin) return asin(x);
  if (op == Op::acos) return acos(x);
  if (op == Op::atan) return atan(x);
  if (op == Op::sinh) return sinh(x);
  if (op == Op::cosh) return cosh(x);
  if (op == Op::tanh) return tanh(x);
  if (op == Op::exp) return exp(x);
  return log(x);
}

template <class Scalar>
Scalar apply(Expression::Op op, const Scalar& a, const Scalar& b) {
  using std::pow;
  using Op = Expression::Op;
  if (op == Op::add) return a + b;
  if (op == Op::subtract) return a - b;
  if (op == Op::multiply) return a * b;
  if (op == Op::divide) return a / b;
  return pow(a, b);
}

}  // namespace detail

template <class Scalar, class MakeNumber>
Scalar Expression::evaluate(std::span<const Scalar> parameters, MakeNumber number) const {
  if (is_constant() && code_.size() == 1) return number(code_[0].number);
  std::array<Scalar, max_stack> stack{};
  int top = -1;
  for (const Instruction& i : code_) {
    if (i.op == Op::number) {
      stack[++top] = number(i.number);
    } else if (i.op == Op::parameter) {
      stack[++top] = parameters[i.parameter];
    } else if (i.op == Op::integer_power) {
      stack[top] = integer_power(stack[top], static_cast<int>(i.number));
    } else if (is_binary(i.op)) {
      --top;
      stack[top] = detail::apply(i.op, stack[top], stack[top + 1]);
    } else {
      stack[top] = detail::apply(i.op, stack[top]);
    }
  }
  return stack[0];
}

}  // namespace eigentrail
