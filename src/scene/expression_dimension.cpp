#include "eigentrail/scene/expression_dimension.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "eigentrail/scene/units.hpp"

namespace eigentrail {
namespace {

using Op = Expression::Op;
using Kind = ExpressionDimension::Kind;

constexpr double no_product = std::numeric_limits<double>::quiet_NaN();

/// A subexpression. Where it is a product, the numbers in it, and the factors by which angles and speeds in
/// it are converted to radians.
struct Part {
  Kind kind = Kind::number;
  Dimension dimension = {};
  double number = 1.0;      ///< product of the literals; not a number if the part is no product
  double conversion = 1.0;  ///< product of the factors of rev, rpm, Hz, deg
  double turns = 0.0;       ///< power of angles in these units
  int angle = -1;           ///< index of a parameter in one of them
};

std::string name_of(const Part& part) {
  return si_unit(part.dimension);
}

class DimensionWalk {
 public:
  explicit DimensionWalk(std::span<const Parameter> parameters) : parameters_(parameters) {}

  Part walk(const Expression& expression) {
    for (const Expression::Instruction& i : expression.code()) {
      if (i.op == Op::number) {
        push({Kind::number, {}, i.number});
      } else if (i.op == Op::parameter) {
        push(parameter(i.parameter));
      } else if (i.op == Op::negate) {
        stack_.back().number = -stack_.back().number;
      } else if (i.op == Op::integer_power || i.op == Op::sqrt) {
        push(power(pop(), i.op == Op::sqrt ? 0.5 : i.number));
      } else if (Expression::is_binary(i.op)) {
        binary(i.op);
      } else {
        function();
      }
    }
    return pop();
  }

 private:
  void push(const Part& part) { stack_.push_back(part); }
  Part pop() {
    const Part part = stack_.back();
    stack_.pop_back();
    return part;
  }

  Part parameter(int index) const {
    const Parameter& parameter = parameters_[static_cast<std::size_t>(index)];
    if (!parameter.dimension) return {Kind::unknown, {}};
    Part part{Kind::known, *parameter.dimension};
    if (parameter.is_angle) {
      part.conversion = parameter.factor;
      part.turns = 1.0;
      part.angle = index;
    }
    return part;
  }

  void binary(Op op) {
    const Part b = pop();
    const Part a = pop();
    if (op == Op::power) {
      push(general_power(a, b));
    } else if (op == Op::add || op == Op::subtract) {
      push(sum(a, b, op));
    } else {
      push(op == Op::multiply ? product(a, b) : product(a, power(b, -1.0)));
    }
  }

  static Part sum(const Part& a, const Part& b, Op op) {
    if (a.kind == Kind::known && b.kind == Kind::known && !(a.dimension == b.dimension)) {
      const std::string both = name_of(a) + " and " + name_of(b);
      throw DimensionError(op == Op::add ? "adds " + both : "subtracts " + both);
    }
    const Part& known = a.kind == Kind::known || b.kind == Kind::number ? a : b;
    return {known.kind, known.dimension, no_product};
  }

  Part product(const Part& a, const Part& b) const {
    Part result;
    const bool unknown = a.kind == Kind::unknown || b.kind == Kind::unknown;
    const bool known = a.kind == Kind::known || b.kind == Kind::known;
    result.kind = unknown ? Kind::unknown : known ? Kind::known : Kind::number;
    result.dimension = a.dimension * b.dimension;
    result.number = a.number * b.number;
    result.conversion = a.conversion * b.conversion;
    result.turns = a.turns + b.turns;
    result.angle = a.angle >= 0 ? a.angle : b.angle;
    refuse_second_conversion(result);
    return result;
  }

  static Part power(Part part, double exponent) {
    part.dimension = pow(part.dimension, exponent);
    part.number = std::pow(part.number, exponent);
    part.conversion = std::pow(part.conversion, exponent);
    part.turns *= exponent;
    return part;
  }

  /// a^b with an exponent that is no literal integer.
  static Part general_power(const Part& a, const Part& b) {
    if (b.kind == Kind::known && !b.dimension.is_number())
      throw DimensionError("has an exponent in " + name_of(b) + "; exponents are numbers");
    if (a.kind == Kind::known && !a.dimension.is_number()) {
      if (b.kind != Kind::number || std::isnan(b.number))
        throw DimensionError("raises " + name_of(a) + " to a power that depends on parameters");
      return power(a, b.number);
    }
    return {a.kind, {}, no_product};
  }

  void function() {
    const Part argument = pop();
    if (argument.kind == Kind::known && !argument.dimension.is_number()) {
      throw DimensionError("has a function of " + name_of(argument) +
                           "; its argument must be an angle or a number without unit");
    }
    push({Kind::number, {}, no_product});
  }

  /// "2 * pi * f" with f in Hz: values are in radians already. The factor is recognized if it is exactly that
  /// of the unit, or 2 pi for each turn.
  void refuse_second_conversion(const Part& part) const {
    if (!(part.turns > 0.0)) return;
    const double turns = std::pow(2.0 * std::numbers::pi, part.turns);
    const auto equals = [&part](double factor) { return std::abs(part.number / factor - 1.0) < 1e-9; };
    if (!equals(part.conversion) && !equals(turns)) return;
    const Parameter& angle = parameters_[static_cast<std::size_t>(part.angle)];
    const std::string radians = angle.dimension->is_number() ? "radians" : "rad/s";
    throw DimensionError("converts " + angle.name + " to radians twice: expressions see a parameter in " +
                         angle.unit + " in " + radians + " already; leave out the factor, or the unit of " +
                         angle.name);
  }

  std::span<const Parameter> parameters_;
  std::vector<Part> stack_;
};

/// Whether an expression is one parameter alone.
const Parameter* single_parameter(const Expression& expression, std::span<const Parameter> parameters) {
  const auto& code = expression.code();
  return code.size() == 1 && code[0].op == Op::parameter
             ? &parameters[static_cast<std::size_t>(code[0].parameter)]
             : nullptr;
}

}  // namespace

ExpressionDimension dimension_of(const Expression& expression, std::span<const Parameter> parameters) {
  const Part part = DimensionWalk(parameters).walk(expression);
  return {part.kind, part.kind == Kind::known ? part.dimension : Dimension{}};
}

std::string dimension_fault(const Expression& expression, std::span<const Parameter> parameters,
                            std::string_view expected) {
  if (expression.is_constant()) return "";
  const ExpressionDimension found = dimension_of(expression, parameters);
  if (found.kind != Kind::known) return "";
  const std::string wanted = expected.empty() ? "a number without unit is" : std::string(expected) + " is";
  const Parameter* single = single_parameter(expression, parameters);
  const Dimension dimension = parse_unit(expected)->dimension;
  if (found.dimension == dimension) {
    // "1/min" may be meant as revolutions or as radians per minute.
    const bool rotation = expected == "rad/s" && single != nullptr;
    if (!rotation || single->is_angle || single->factor == 1.0 ||
        single->unit.find("rad") != std::string::npos)
      return "";
    return "is in " + single->unit + ", which does not say of what; write \"rpm\", \"rev/s\" or \"rad/s\"";
  }
  const std::string unit = single != nullptr ? single->unit : si_unit(found.dimension);
  const std::string remedy =
      single != nullptr ? ""
                        : "; a factor that stands for a quantity needs a name and a unit in [parameters]";
  return "is in " + unit + ", but " + wanted + " expected" + remedy;
}

}  // namespace eigentrail
