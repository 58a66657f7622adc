#include "eigentrail/continuation/route_choice.hpp"

#include <limits>

namespace eigentrail {
namespace {

// Measured with OpenBLAS at n = 20 ... 200: what a multiplication costs beside one of a back-substitution.
constexpr double in_product = 0.25;
constexpr double in_factorization = 0.4;

// Measured on the families of the performance suite, steps tried again included.
constexpr double attempts = 1.4;
constexpr double corrections = 4.0;  ///< per mode and attempt
constexpr double refinements = 3.0;  ///< per coefficient of a series

/// LU, corrections and series of one mode; complex, 4 multiplications of reals each.
double of_one_mode(double n, double coefficients) {
  const double lu = in_factorization * 4.0 / 3.0 * n * n * n;
  const double solve = 10.0 * n * n;  // with the residual that it is for
  return lu + (corrections + refinements * coefficients) * solve;
}

/// Two bases of size 2n, and for every correction and coefficient the residuals of all modes (three products
/// of a real matrix with n complex columns) and a solution (two of size 2n x n).
double of_state_space(double n, double coefficients) {
  const double cube = in_product * n * n * n;
  return 2.0 * 8.0 * cube + (corrections + 1.5 * coefficients) * (6.0 + 8.0) * cube;
}

/// Real and of size n, without a factorization.
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

}  // namespace eigentrail
