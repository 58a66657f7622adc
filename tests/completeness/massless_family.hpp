// Random families with massless freedoms whose stiffness passes zero: an eigenvalue there runs to infinity
// like 1 / sqrt(p - p0), or comes from it.
//
// With the massless freedoms y, M x'' + C x' + K_xx x + K_xy y = 0 and K_yx x + K_yy y = 0, so that
//
//     s^2 M + s C + K_xx - K_xy K_yy^-1 K_yx
//
// has the finite eigenvalues, all of them and no others. It is singular where det K_yy(p) = 0.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hard_cases/family.hpp"

namespace eigentrail::test {

/// Two to six coordinates, the last ones massless before a congruence with integer coefficients mixes them
/// (in half of the families).
struct MasslessFamily {
  std::uint64_t seed = 0;
  double from = -1.0, to = 1.0;
  Family matrices;  ///< as traced
  Family unmixed;   ///< the same with the massless freedoms last
  Eigen::Index massless = 1;

  Eigen::Index size() const { return unmixed.M[0].rows(); }
  std::string scene() const;
  /// All finite eigenvalues at p, by QZ of the pencil without the massless freedoms.
  std::vector<Complex> spectrum(double p) const;
  /// Where an eigenvalue is infinite, ascending.
  std::vector<double> places_of_infinity() const;
};

/// The family of a seed; always the same, with every standard library.
MasslessFamily massless_family(std::uint64_t seed);

/// Traces all modes, from `to` to `from` if `reversed`, and compares them with the spectrum at every point
/// and at six places in between. Eigenvalues more than 40 times as large as the largest one at the start may
/// be listed or not. Returns what is wrong, a line each.
std::vector<std::string> check_massless(const MasslessFamily& family, bool reversed);

}  // namespace eigentrail::test
