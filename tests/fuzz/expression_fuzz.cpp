// Bytes as an expression, evaluated on numbers and on series, and as a unit.
#include <array>
#include <span>

#include "eigentrail/scene/expression.hpp"
#include "eigentrail/scene/units.hpp"
#include "fuzz/entry.hpp"

using namespace eigentrail;

namespace {

template <class Scalar>
void evaluate(const Expression& expression) {
  const std::array<Scalar, 3> values = {Scalar(0.0), Scalar(-1.5), Scalar(1e3)};
  (void)expression.evaluate(std::span<const Scalar>(values));
}

}  // namespace

EIGENTRAIL_FUZZ(expression) {
  (void)unit_factor(bytes);
  try {
    const Expression expression = Expression::parse(bytes, {"a", "b_1", "omega"});
    evaluate<double>(expression);
    evaluate<Series<double, 3>>(expression);
    evaluate<double>(sqrt(expression * expression + sin(expression)) / (expression - 1.0));
  } catch (const ExpressionError&) {
  }
}
