#include "eigentrail/continuation/operating_point.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/scenes.hpp"

namespace eigentrail::test::operating_point_test {
namespace {

TEST(OperatingPoint, AgreesWithTheTraceOfTheRotatingMass) {
  const Setting setting = scene_setting("rotating_mass");
  const std::vector<OperatingPoint> points = operating_points(setting, {40.0, 10.0});
  ASSERT_EQ(points.size(), 2u);
  for (const OperatingPoint& point : points) {
    ASSERT_TRUE(point.fault.empty()) << point.fault;
    ASSERT_EQ(point.modes.size(), 2u);
    EXPECT_EQ(point.modes[0].what_moves, "lag");
    EXPECT_EQ(point.modes[1].what_moves, "flap");
    EXPECT_LT(point.modes[0].backward_error, 1e-12);
  }
  const RecordedTrace traced = record_trace(setting);
  const ComplexVector s = traced.eigenvalues_at(40.0);
  for (Eigen::Index i = 0; i < 2; ++i)
    EXPECT_LT(std::abs(points[0].modes[static_cast<std::size_t>(i)].s - s[i]), 1e-7 * std::abs(s[i]));
}

TEST(OperatingPoint, OscillatorHasKnownFrequencyDampingAndCondition) {
  const Setting setting = make_setting(
      "[trace]\nparameter = \"p\"\nfrom = 1\nto = 2\nmodes = { count = 1, near = 2 }\n"
      "[matrix_family]\nM = [ [[1, 0], [0, 1]] ]\nC = [ [[0.4, 0], [0, 0.1]] ]\n"
      "K = [ [[4, 0], [0, 0]], [[0, 0], [0, 100]] ]\nstate_names = [\"slow\", \"fast\"]\n");
  const OperatingPoint point = operating_points(setting, {1.0}).front();
  ASSERT_EQ(point.modes.size(), 1u);
  const OperatingMode& mode = point.modes.front();
  EXPECT_NEAR(std::abs(mode.s), 2.0, 1e-14);
  EXPECT_NEAR(-mode.s.real() / std::abs(mode.s), 0.1, 1e-14);
  EXPECT_NEAR(mode.s.imag(), std::sqrt(4.0 - 0.04), 1e-14);
  EXPECT_EQ(mode.what_moves, "slow 100 %");
}

TEST(OperatingPoint, RigidBodyMotionsAreExactlyZeroAndDefective) {
  const Setting setting = make_setting(
      "[trace]\nparameter = \"p\"\nfrom = 1\nto = 2\n[matrix_family]\nM = [ [[1, 0], [0, 2]] ]\n"
      "K = [ [[0, 0], [0, 0]], [[0, 0], [0, 5]] ]\n");
  const OperatingPoint point = operating_points(setting, {1.3}).front();
  ASSERT_EQ(point.modes.size(), 3u);
  EXPECT_EQ(point.modes[0].s, Complex(0.0));
  EXPECT_EQ(point.modes[1].s, Complex(0.0));
  EXPECT_TRUE(std::isinf(point.modes[0].condition));
  EXPECT_NEAR(point.modes[2].s.imag(), std::sqrt(2.5 * 1.3), 1e-14);
}

TEST(OperatingPoint, ASingularPencilIsAFault) {
  const Setting setting = make_setting(
      "[trace]\nparameter = \"p\"\nfrom = 1\nto = 2\n[matrix_family]\nM = [ [[1, 0], [0, 0]] ]\n"
      "K = [ [[1, 0], [0, 0]], [[1, 0], [0, 0]] ]\n");
  const OperatingPoint point = operating_points(setting, {1.0}).front();
  EXPECT_TRUE(point.modes.empty());
  EXPECT_NE(point.fault.find("singular"), std::string::npos);
}

TEST(OperatingPoint, TheModelMayBeTheSameForAllValues) {
  const TraceSetup setup = prepare_trace(
      parse_scene(
          "[trace]\nparameter = \"p\"\nfrom = 0\nto = 1\n[matrix_family]\nA = [ [[0, 1], [-1, -1]] ]\n",
          "scene.toml"),
      {}, Purpose::operating_point);
  const OperatingPoint point = operating_points(setup, {0.0}).front();
  ASSERT_EQ(point.modes.size(), 1u);
  EXPECT_LT(std::abs(point.modes[0].s - Complex(-0.5, std::sqrt(0.75))), 1e-14);
}

}  // namespace
}  // namespace eigentrail::test::operating_point_test
