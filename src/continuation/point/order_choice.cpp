#include "eigentrail/continuation/order_choice.hpp"

#include <cmath>
#include <limits>

#include "eigentrail/core/types.hpp"

namespace eigentrail {
namespace {

// Work per mode and point, measured on the traces in docs/developers/accuracy.md. The values affect the
// choice of the order, and so the cost of a trace.
constexpr double factorizations = 1.9;              ///< complex LU, rejected steps included
constexpr double certificate_factorizations = 1.1;  ///< the same for the certificate
constexpr double order_corrections = 6.75;          ///< solves, each with a residual, for the correction
constexpr double order_refinements = 4.5;           ///< the same, per coefficient of a series
constexpr double products = 0.1;  ///< cost of a product of two coefficients relative to such a solve
/// Points that no order saves (ends of the range, special points), in units of L / R. With a larger value
/// lower orders are chosen.
constexpr double least_points = 3.0;

}  // namespace

double work_per_point(const TraceSize& size, int order) {
  const auto n = static_cast<double>(size.freedoms);
  // A complex multiplication counts as 4 real ones: LU n^3 / 3, back-substitution n^2 complex ones. The
  // residual multiplies three real matrices by a complex vector, 6 n^2.
  const double lu = 4.0 / 3.0 * n * n * n;
  const double solve = 10.0 * n * n;
  const double coefficients = order + 1.0;
  return (factorizations + (size.certify ? certificate_factorizations : 0.0)) * lu +
         (order_corrections + order_refinements * coefficients * (1.0 + products * coefficients)) * solve;
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
