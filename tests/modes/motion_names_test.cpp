// Names of motions: velocities, and waves in multiblade coordinates.
#include "eigentrail/modes/participation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace eigentrail::test::motion_names_test {
namespace {

constexpr Complex i(0.0, 1.0);

TEST(MotionNames, VelocitiesBelongToTheirMotion) {
  const auto found = motion_shares({"plunge", "pitch", "plunge velocity", "lag state velocity"},
                                   Vector{{0.2, 0.3, 0.4, 0.1}}, ComplexVector{{1.0, i, 2.0, 0.5}});
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].name, "plunge");
  EXPECT_NEAR(found[0].share, 0.6, 1e-15);
  EXPECT_EQ(found[1].name, "pitch");
  EXPECT_EQ(found[2].name, "lag state velocity") << "without the position it is a motion of its own";
}

TEST(MotionNames, RatesBelongToTheirMotion) {
  const auto found = motion_shares({"plunge", "plunge rate", "yaw rate"}, Vector{{0.3, 0.3, 0.4}},
                                   ComplexVector{{1.0, i, 2.0}});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].name, "plunge");
  EXPECT_NEAR(found[0].share, 0.6, 1e-15);
  EXPECT_EQ(found[1].name, "yaw rate");
}

/// q_k = cos(psi_k - w t) turns with the rotor: c = cos(w t), s = sin(w t).
TEST(MotionNames, WavesTurnWithTheRotorOrAgainstIt) {
  const std::vector<std::string> names{"1st flap collective", "1st flap cosine", "1st flap sine"};
  const Vector shares{{0.0, 0.5, 0.5}};
  const auto with = motion_shares(names, shares, ComplexVector{{0.0, 1.0, -i}});
  EXPECT_EQ(with[0].name, "1st flap progressive");
  EXPECT_NEAR(with[0].share, 1.0, 1e-15);
  const auto against = motion_shares(names, shares, ComplexVector{{0.0, 1.0, i}});
  EXPECT_EQ(against[0].name, "1st flap regressive");
  EXPECT_NEAR(against[0].share, 1.0, 1e-15);
  // A tilting of the rotor disc without turning is both in equal parts.
  const auto tilting = motion_shares(names, Vector{{0.2, 0.8, 0.0}}, ComplexVector{{i, 1.0, 0.0}});
  EXPECT_NEAR(tilting[0].share, 0.4, 1e-15);
  EXPECT_NEAR(tilting[1].share, 0.4, 1e-15);
}

TEST(MotionNames, HigherHarmonicsKeepTheirNumber) {
  const auto found = motion_shares({"edge cosine 2", "edge sine 2", "edge cosine 2 velocity"},
                                   Vector{{0.3, 0.5, 0.2}}, ComplexVector{{1.0, i, 0.1}});
  EXPECT_EQ(found[0].name, "edge regressive 2");
  EXPECT_NEAR(found[0].share, 1.0, 1e-15);
}

TEST(MotionNames, NothingTurnsInARealMode) {
  const auto found = motion_shares({"flap cosine", "flap sine"}, Vector{{0.9, 0.1}},
                                   ComplexVector{{Complex(0.6, 0.8), Complex(-0.3, -0.4)}});
  EXPECT_EQ(found[0].name, "flap cosine");
  EXPECT_EQ(found[1].name, "flap sine");
}

TEST(MotionNames, WithoutItsPartnerAComponentStaysAlone) {
  const auto found = motion_shares({"flap cosine", "x"}, Vector{{0.9, 0.1}}, ComplexVector{{1.0, i}});
  EXPECT_EQ(found[0].name, "flap cosine");
}

}  // namespace
}  // namespace eigentrail::test::motion_names_test
