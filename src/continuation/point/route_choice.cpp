#include "eigentrail/continuation/route_choice.hpp"

#include <cmath>
#include <limits>

namespace eigentrail {
namespace {

// Time of a multiplication relative to one of a back-substitution, measured with OpenBLAS at n = 20 ... 200.
constexpr double in_product = 0.25;
constexpr double in_factorization = 0.4;

// Measured on the matrix families of the performance suite. The values affect only the choice of the route,
// and so the cost of a trace.
constexpr double attempts = 1.4;                  ///< computed points per accepted step
constexpr double corrections = 4.0;               ///< per mode and attempt
constexpr double refinements = 3.0;               ///< solves per coefficient of a series, one mode
constexpr double refinements_of_all_modes = 1.5;  ///< the same for all modes at once

/// Work on one mode: LU, corrections and series. Complex multiplications count as 4 real ones.
double of_one_mode(double n, double coefficients) {
  const double lu = in_factorization * 4.0 / 3.0 * n * n * n;
  const double solve = 10.0 * n * n;  // 4 n^2 for back-substitution, 6 n^2 for the residual
  return lu + (corrections + refinements * coefficients) * solve;
}

/// Work on all modes in state space: two bases of size 2n, and for every correction and coefficient the
/// residuals of all modes (three products of a real matrix with n complex columns, 6 n^3) and a solution (two
/// products of size 2n x n, 8 n^3).
double of_state_space(double n, double coefficients) {
  const double cube = in_product * n * n * n;
  return 2.0 * 8.0 * cube + (corrections + refinements_of_all_modes * coefficients) * (6.0 + 8.0) * cube;
}

/// Work on all modes by the symmetric route: real products of size n (four per correction or coefficient), no
/// factorization.
double of_symmetric(double n, double coefficients) {
  return (corrections + coefficients) * 4.0 * in_product * n * n * n;
}

}  // namespace

double route_work(ModeRoute route, const Structure& structure, const ModeWork& work) {
  const auto n = static_cast<double>(work.freedoms);
  const double coefficients = work.order + 1.0;
  const bool is_symmetric =
      structure.symmetric_mass && !structure.damped && !structure.gyroscopic && !structure.circulatory;
  if (route == ModeRoute::one_by_one)
    return attempts * static_cast<double>(work.modes) * of_one_mode(n, coefficients);
  if (!work.all || (route == ModeRoute::symmetric && !is_symmetric))
    return std::numeric_limits<double>::infinity();
  return attempts *
         (route == ModeRoute::symmetric ? of_symmetric(n, coefficients) : of_state_space(n, coefficients));
}

ModeRoute cheapest_route(const Structure& structure, const ModeWork& work) {
  ModeRoute best = ModeRoute::one_by_one;
  for (const ModeRoute route : {ModeRoute::state_space, ModeRoute::symmetric}) {
    if (route_work(route, structure, work) < route_work(best, structure, work)) best = route;
  }
  return best;
}

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

/// Multiplications of real numbers per mode and point, with dense output of order q, 1 to 4.
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

}  // namespace

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
