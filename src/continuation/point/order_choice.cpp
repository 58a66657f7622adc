#include "eigentrail/continuation/order_choice.hpp"

#include <cmath>
#include <limits>

#include "eigentrail/core/types.hpp"

namespace eigentrail {
namespace {

constexpr double factorizations = 1.9;  ///< steps tried again included
constexpr double certificate_factorizations = 1.1;
constexpr double corrections = 6.75;  ///< solves with a residual each
constexpr double refinements = 4.5;   ///< the same, per coefficient of a series
constexpr double products = 0.1;      ///< of two coefficients, per refinement of one
/// Points that no order saves, in units of L / R.
constexpr double least_points = 3.0;

}  // namespace

double work_per_point(const TraceSize& size, int order) {
  const auto n = static_cast<double>(size.freedoms);
  const double lu = 4.0 / 3.0 * n * n * n;
  const double solve = 10.0 * n * n;  // with the residual that it is for
  const double coefficients = order + 1.0;
  return (factorizations + (size.certify ? certificate_factorizations : 0.0)) * lu +
         (corrections + refinements * coefficients * (1.0 + products * coefficients)) * solve;
}

double relative_points(int order, double tolerance) {
  return least_points + std::pow(tolerance, -1.0 / (2.0 * order + 2.0));
}

int cheapest_order(const TraceSize& size, double tolerance) {
  int best = 1;
  double least = std::numeric_limits<double>::infinity();
  for (int order = 1; order < max_order; ++order) {
    const double work = work_per_point(size, order) * relative_points(order, tolerance);
    if (work >= least) continue;
    least = work;
    best = order;
  }
  return best;
}

}  // namespace eigentrail
