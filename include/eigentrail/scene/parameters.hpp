// The scene's parameters: named numbers with a unit, or expressions of other parameters.
#pragma once

#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/types.hpp"
#include "eigentrail/scene/expression.hpp"

namespace eigentrail {

struct Parameter {
  std::string name;
  double value = 0.0;   ///< in `unit`; of a derived parameter: not used
  std::string unit;     ///< as written; empty: SI or dimensionless
  double factor = 1.0;  ///< SI value = factor * value
  std::optional<Expression> definition =
      {};  ///< derived parameter: its value, in `unit`, from SI values of the others
  SourceLocation where = {};
};

/// Parameters that define each other; the message names the cycle.
class ParameterCycle : public std::invalid_argument {
 public:
  ParameterCycle(const std::string& message, int index) : std::invalid_argument(message), parameter(index) {}
  int parameter;  ///< index of one of them
};

/// Immutable after construction; derived parameters are resolved in an order without forward references.
class Parameters {
 public:
  Parameters() = default;

  /// Orders the derived parameters. Throws ParameterCycle when they define each other.
  explicit Parameters(std::vector<Parameter> list);

  std::size_t size() const { return list_.size(); }
  const Parameter& operator[](std::size_t i) const { return list_[i]; }
  const std::vector<std::string>& names() const { return names_; }
  std::optional<int> index(std::string_view name) const;

  /// The parameter of that name; throws std::out_of_range when there is none.
  const Parameter& at(std::string_view name) const;

  /// Values as the scene declares them, in declared units; derived ones are filled in.
  Vector declared_values() const;

  /// Turns declared values into SI in place and computes the derived ones (whatever stood in their entries).
  template <class Scalar>
  void to_si(std::span<Scalar> values) const {
    for (std::size_t i = 0; i < list_.size(); ++i) values[i] = values[i] * list_[i].factor;
    for (const int i : derived_order_) {
      values[i] = list_[i].definition->evaluate(std::span<const Scalar>(values)) * list_[i].factor;
    }
  }

  /// Whether `parameter` is `traced` or is derived from it, directly or through others.
  bool depends_on(int parameter, int traced) const;

  /// The given parameters and all that their definitions use, directly or through others.
  std::set<int> with_definitions(const std::set<int>& parameters) const;

  /// The same for an expression.
  bool depends_on(const Expression& expression, int traced) const;

 private:
  std::vector<Parameter> list_;
  std::vector<std::string> names_;
  std::vector<int> derived_order_;
};

}  // namespace eigentrail
