// Random families s^2 M + s C(p) + K(p) without any planted special point.
#pragma once

#include <cstdint>
#include <string>

#include "hard_cases/family.hpp"

namespace eigentrail::test {

enum class FamilyKind {
  light,           ///< symmetric, lightly damped; the damping may turn negative
  proportional,    ///< C close to a M + b K, from light to heavy
  heavy,           ///< symmetric, heavily damped
  gyroscopic,      ///< skew part in C
  circulatory,     ///< skew part in K
  mixed,           ///< some coordinates heavily damped, skew parts in C and K
  weakly_coupled,  ///< oscillators that hardly know of each other: narrow veerings, events beside events
};
inline constexpr int family_kinds = 7;
const char* name_of(FamilyKind kind);

/// M constant and near the identity, C and K polynomials of degree 1 to 4, two to fifteen coordinates.
struct RandomFamily {
  std::uint64_t seed = 0;
  FamilyKind kind = FamilyKind::light;
  double from = -1.0, to = 1.0;
  Family matrices;

  Eigen::Index size() const { return matrices.M[0].rows(); }
  std::string scene() const;
};

/// The family of a seed; always the same, with every standard library.
RandomFamily random_family(std::uint64_t seed);

}  // namespace eigentrail::test
