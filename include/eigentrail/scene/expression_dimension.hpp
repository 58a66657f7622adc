// The dimension of an expression of parameters, some of which have units.
//
//   kind     of                                       in sums                 in products
//   number   literals, values of functions            fit any dimension       are factors without dimension
//   known    parameters with a unit                   must agree              multiply
//   unknown  parameters without a unit                fit any dimension       make the product unknown
//
// So "2 * m" has the dimension of m, "m + 0.5" too, and "c * m" with a parameter c that has no unit may be
// anything.
#pragma once

#include <span>
#include <stdexcept>
#include <string>

#include "eigentrail/scene/dimension.hpp"
#include "eigentrail/scene/parameters.hpp"

namespace eigentrail {

/// An expression whose dimensions cannot be right: "adds kg to m".
class DimensionError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct ExpressionDimension {
  enum class Kind { number, known, unknown };
  Kind kind = Kind::number;
  Dimension dimension = {};  ///< if it is known
};

/// Throws DimensionError if quantities of different dimensions are added, if a function needs a number and
/// its argument has a dimension, or if an angle or a speed is converted to radians a second time, as in
/// "2 * pi * f" with f in Hz. `parameters`: those that the expression was parsed with.
ExpressionDimension dimension_of(const Expression& expression, std::span<const Parameter> parameters);

/// What is wrong with an expression that stands where the unit `expected` is wanted: "is in kN, but kg are
/// expected". Empty if its dimension fits, or is not known. "" expects a number without dimension. Throws
/// DimensionError.
std::string dimension_fault(const Expression& expression, std::span<const Parameter> parameters,
                            std::string_view expected);

}  // namespace eigentrail
