// The scene's parameters: named numbers with a unit, or expressions of other parameters.
#pragma once

#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/types.hpp"
#include "eigentrail/scene/dimension.hpp"
#include "eigentrail/scene/expression.hpp"

namespace eigentrail {

struct Parameter {
  std::string name;
  double value = 0.0;   ///< in `unit`; not used if the parameter is derived
  std::string unit;     ///< as written; empty: SI or dimensionless
  double factor = 1.0;  ///< SI value = factor * value
  /// Of `unit`; absent if the parameter has no unit. Such a parameter fits anywhere.
  std::optional<Dimension> dimension = {};
  bool is_angle = false;  ///< whether `unit` contains rev, rpm, Hz or deg: see Unit::angle
  /// Derived parameter, from the SI values of the others: its value in `unit`, or its SI value.
  std::optional<Expression> definition = {};
  bool definition_is_si = false;
  SourceLocation where = {};
};

/// Thrown if parameters define each other in a cycle; the message names the cycle.
class ParameterCycle : public std::invalid_argument {
 public:
  ParameterCycle(const std::string& message, int index) : std::invalid_argument(message), parameter(index) {}
  int parameter;  ///< index of one parameter of the cycle
};

/// Immutable after construction. Derived parameters are evaluated in an order in which every definition uses
/// only parameters that are already known.
class Parameters {
 public:
  Parameters() = default;

  /// Determines the order of the derived parameters. Throws ParameterCycle if they define each other in a
  /// cycle.
  explicit Parameters(std::vector<Parameter> list);

  std::size_t size() const { return list_.size(); }
  const Parameter& operator[](std::size_t i) const { return list_[i]; }
  const std::vector<Parameter>& list() const { return list_; }
  const std::vector<std::string>& names() const { return names_; }
  std::optional<int> index(std::string_view name) const;

  /// The parameter with this name; throws std::out_of_range if there is none.
  const Parameter& at(std::string_view name) const;

  /// Values in declared units, with the derived parameters computed.
  Vector declared_values() const;

  /// Converts declared values to SI in place and computes the derived ones, whose entries are overwritten.
  template <class Scalar, class MakeNumber = Expression::Number<Scalar>>
  void to_si(std::span<Scalar> values, MakeNumber number = {}) const {
    for (std::size_t i = 0; i < list_.size(); ++i) values[i] = values[i] * list_[i].factor;
    for (const int i : derived_order_) {
      const double factor = list_[i].definition_is_si ? 1.0 : list_[i].factor;
      values[i] = list_[i].definition->evaluate(std::span<const Scalar>(values), number) * factor;
    }
  }

  /// Declared values of all parameters in SI units, with the derived ones computed.
  Vector in_si(Vector declared) const {
    to_si(std::span<double>(declared.data(), size()));
    return declared;
  }

  /// Whether `parameter` is `traced` or depends on it, directly or through others.
  bool depends_on(int parameter, int traced) const { return with_definitions({parameter}).contains(traced); }

  /// The given parameters and all parameters that their definitions use, directly or through others.
  std::set<int> with_definitions(const std::set<int>& parameters) const;

  /// The same as depends_on for an expression.
  bool depends_on(const Expression& expression, int traced) const;

 private:
  std::vector<Parameter> list_;
  std::vector<std::string> names_;
  std::vector<int> derived_order_;
};

}  // namespace eigentrail
