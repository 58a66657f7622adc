// Stability by energy: what it must not call stable, and what rounding must not hide.
#include "modes/energy_stability.hpp"

#include <gtest/gtest.h>

namespace eigentrail::test::energy_stability_test {
namespace {

/// Two freedoms in a frame that rotates; the first has damping c, the second has none, so that only rounding
/// is left in its row of C + C^T. `units`: ratio of the units of both.
ReducedPencil rotating(double c, double units) {
  constexpr double gyroscopic = 2.6, rounding = 3e-16;
  const Matrix D = Vector{{1.0, units}}.asDiagonal();
  const auto in_units = [&](const Matrix& A) { return MatrixSeries{D * A * D}; };
  return {in_units(Matrix::Identity(2, 2)), in_units(Matrix{{c, -gyroscopic}, {gyroscopic + rounding, 0.0}}),
          in_units(Matrix{{1.0, 0.1}, {0.1, 4.0}})};
}

constexpr Structure symmetric{.symmetric_mass = true, .damped = true};

TEST(StabilityByEnergy, SeesUndampedCoordinatesBesideGyroscopicForces) {
  for (const double units : {1.0, 1e-5, 1e7})
    EXPECT_TRUE(is_stable_by_energy(rotating(0.02, units), symmetric));
}

TEST(StabilityByEnergy, ShowsNothingWhereDampingIsNegative) {
  for (const double units : {1.0, 1e-5, 1e7}) {
    EXPECT_FALSE(is_stable_by_energy(rotating(-0.02, units), symmetric));
    EXPECT_FALSE(is_stable_by_energy(rotating(-1e-9, units), symmetric));
  }
}

TEST(StabilityByEnergy, ShowsNothingWithoutPositiveStiffnessOrPotential) {
  ReducedPencil pencil = rotating(0.02, 1.0);
  Structure circulatory = symmetric;
  circulatory.circulatory = true;
  EXPECT_FALSE(is_stable_by_energy(pencil, circulatory));
  pencil.K[0](1, 1) = 0.01;
  EXPECT_FALSE(is_stable_by_energy(pencil, symmetric));
}

}  // namespace
}  // namespace eigentrail::test::energy_stability_test
