#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "steady/trims.hpp"

namespace eigentrail::test::equilibrium_test {
namespace {

constexpr double tolerance = 1e-12;

Setting pendulum() {
  return pushed_pendulum({.mass = 2.0, .length = 1.5, .guess = 0.01});
}

TEST(Equilibrium, PushedPendulumStandsWhereSineEqualsTheForce) {
  for (const double p : {0.0, 0.3, 0.7, 0.95}) {
    const Equilibrium found = at_rest(pendulum(), {{"p", p}});
    ASSERT_EQ(found.status, SteadyStatus::converged) << found.report.message;
    EXPECT_NEAR(std::abs(found.x[0]), 1.5 * p, tolerance * 10);
    EXPECT_NEAR(found.x[2], -1.5 * std::sqrt(1.0 - p * p), tolerance * 10);
  }
}

TEST(Equilibrium, NoEquilibriumBeyondTheFoldIsReportedWithTheWorstEquation) {
  const Equilibrium found = at_rest(pendulum(), {{"p", 1.2}});  // the fold is at 1
  EXPECT_EQ(found.status, SteadyStatus::not_converged);
  EXPECT_NE(found.report.message.find("KINSOL"), std::string::npos);
  EXPECT_NE(found.report.message.find(found.report.worst_equation), std::string::npos);
  EXPECT_GT(found.report.residual, 1e-3);
}

TEST(Equilibrium, SeriesHaveTheirOrder) {
  expect_orders_of_series(pendulum(), "p", 0.6, 0.04);
}

/// Rotating mass in other units: the same solution, scaled.
struct Units {
  std::string name;
  double length;  ///< how many of the new unit make a metre
  double time;    ///< how many of the new unit make a second
};

class EquilibriumUnits : public testing::TestWithParam<Units> {};

TEST_P(EquilibriumUnits, ChangeNothingButTheScale) {
  const double L = GetParam().length;
  const double T = GetParam().time;
  const auto text = [](double value) {
    std::ostringstream stream;
    stream.precision(17);
    stream << std::scientific << value;
    return stream.str();
  };
  const Setting original = scene_setting("rotating_mass", {{"from", "40"}, {"to", "30"}});
  const Setting scaled = scene_setting("rotating_mass", {{"from", text(40.0 / T)}, {"to", text(30.0 / T)}},
                                       {{"40.0", text(40.0 / T)},
                                        {"value = 5.0", "value = " + text(5.0 * L)},
                                        {"value = 1.0", "value = " + text(L)},
                                        {"value = 2.0", "value = " + text(2.0 / T)},
                                        {"-100.0", text(-100.0 / T / T)},
                                        {"1000.0", text(1000.0 / T / T)}});
  RunCounts counts;
  const PathPoint a = point_from_guess(original.problem(), 40.0, counts);
  const PathPoint b = point_from_guess(scaled.problem(), 40.0 / T, counts);
  EXPECT_LT((a.equilibrium.x * L - b.equilibrium.x).norm(), tolerance * L * 6.0);
  for (std::size_t i = 0; i < 2; ++i) {
    const Complex expected = a.pairs[i].eigenvalue() / T;
    EXPECT_LT(std::abs(b.pairs[i].eigenvalue() - expected), tolerance * std::abs(expected)) << "mode " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Scales, EquilibriumUnits,
                         testing::Values(Units{"Micrometre", 1e6, 1.0}, Units{"Kilometre", 1e-3, 1.0},
                                         Units{"Nanosecond", 1.0, 1e9},
                                         Units{"MicrometreAndNanosecond", 1e6, 1e9},
                                         Units{"KilometreAndHour", 1e-3, 1.0 / 3600.0}),
                         [](const auto& tested) { return tested.param.name; });

/// Redundant and nearly parallel constraints.
const std::string plain_pendulum = R"(
parameters = { length = 1.5 }
trace = { parameter = "length", from = 1, to = 2 }
gravity = { acceleration = [0, 0, -9.81] }
point = [{ name = "bob", mass = 2, position = [0.1, 0, "-length"] }]
[[rod]]
from = [0, 0, 0]
to = "bob"
length = "length"
)";
const std::string in_plane = "[[fixed]]\npoint = \"bob\"\ncoordinate = \"y\"\n";
const std::string second_rod = "[[rod]]\nfrom = [0, 0, 0]\nto = \"bob\"\nlength = \"length\"\n";

/// A rod from a place beside the hinge, so that the rods enclose the given angle.
std::string rod_at_angle(double angle) {
  std::ostringstream text;
  text.precision(17);
  text << "[[rod]]\nfrom = [0, \"" << std::tan(angle) << " * length\", 0]\nto = \"bob\"\nlength = \"length / "
       << std::cos(angle) << "\"\n";
  return text.str();
}

constexpr double redundancy_tolerance = 1e-9;

/// The bob swings with one mode, whose frequency is that of its length.
void expect_swing(const std::string& rods) {
  const RecordedTrace recorded = completed_trace(make_setting(plain_pendulum + rods));
  ASSERT_EQ(recorded.result.n_modes, 1);
  for (const PathNode& node : recorded.nodes) {
    const double expected = std::sqrt(9.81 / node.p);
    EXPECT_NEAR(node.s(0, 0).imag(), expected, redundancy_tolerance * expected) << "at " << node.p;
    EXPECT_NEAR(node.s(0, 1).imag(), -0.5 * expected / node.p, redundancy_tolerance * expected / node.p);
  }
}

TEST(Equilibrium, RodWrittenTwiceChangesNoEigenvalue) {
  expect_swing(in_plane);
  expect_swing(in_plane + second_rod);
}

class RodsAtAnAngle : public testing::TestWithParam<double> {};

TEST_P(RodsAtAnAngle, LeaveTheSwingInTheirCommonPlaneUnchanged) {
  // Both rods hinge on the y axis, so the bob swings about it with the same length. The second rod takes away
  // the freedom along y, whatever the angle.
  expect_swing(rod_at_angle(GetParam()));
}

TEST_P(RodsAtAnAngle, AreOneConstraintTooManyInAPlane) {
  expect_swing(in_plane + rod_at_angle(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Angles, RodsAtAnAngle,
                         testing::Values(1e-2, 1e-4, 1e-6, 1e-7, 3e-8, 1e-8, 3e-9, 1e-9, 1e-10));

/// Rounding of the rods' lengths moves the bob along y by 1e-16 / angle. Corrections of that size must not
/// count as a failure to converge, at any length.
TEST(Equilibrium, BetweenNearlyParallelRodsIsFoundAtEveryLength) {
  for (const double angle : {1e-7, 1e-8, 1e-9}) {
    const Setting setting = make_setting(plain_pendulum + rod_at_angle(angle));
    for (int i = 0; i < 200; ++i) {
      const double length = 0.5 + 0.0173 * i;
      const Equilibrium found = at_rest(setting, {{"length", length}});
      ASSERT_EQ(found.status, SteadyStatus::converged)
          << angle << ' ' << length << ' ' << found.report.message;
      EXPECT_NEAR(found.x[2], -length, 1e-12);
      EXPECT_NEAR(found.x[1], 0.0, 1e-15 * length / angle);
    }
  }
}

}  // namespace
}  // namespace eigentrail::test::equilibrium_test
