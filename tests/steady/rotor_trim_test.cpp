// Trimmed parameters of a rotor of equal blades: thrust of all blades, loads of one blade, loads of the
// support.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "eigentrail/modes/spectrum.hpp"
#include "scene/input_error.hpp"
#include "steady/trims.hpp"

namespace eigentrail::test::rotor_trim_test {
namespace {

constexpr double blades = 4.0, density = 1.2, chord = 0.3, slope = 5.7, root = 0.7, tip = 4.2, hinge = 0.2,
                 stiffness = 1e5, omega = 30.0;

const std::string parameters = R"(
[parameters]
pitch = { value = 0.08, unit = "rad" }
omega = { value = 30, unit = "rad/s" }
weight = { value = 2000, unit = "N" }
torque = { value = 0.1, unit = "N m" }
rise = { value = 0.01, unit = "m" }
coning = { value = 0.03, unit = "rad" }
push = { value = 0.0, unit = "N" }
arm = { value = 1.0, unit = "m" }
spring = { value = 1e4, unit = "N m/rad" }
radian = { value = 1.0, unit = "rad" }
[frame]
angular_velocity = [0, 0, "omega"]
)";

/// The blade flaps on a spring if `held` is empty.
std::string blade(const std::string& held) {
  return R"(
[[body]]
name = "hub"
mass = 10
inertia = [1, 1, 1]
position = [0, 0, 0]
markers = { hinge = [0.2, 0, 0] }
[[body]]
name = "blade"
mass = 20
centre = [2, 0, 0]
inertia = [1, 20, 20]
position = [0.2, 0, 0]
[[revolute]]
name = "flap"
from = "hub.hinge"
to = "blade"
axis = [0, -1, 0]
)" + held +
         R"(
[[torsional_spring]]
name = "spring"
joint = "flap"
stiffness = "spring"
[[strips]]
name = "air"
on = "blade"
root = [0.5, 0, 0]
tip = [4, 0, 0]
chord = 0.3
incidence = "pitch"
lift_slope = 5.7
density = 1.2
)";
}

const std::string held = "angle = 0\n";

/// Four blades on a hub that moves along its axis on a spring, which a mount carries.
std::string rotor(const std::string& of_blade = held) {
  return parameters + R"(
[rotor]
blades = 4
hub = "hub"
support = ["mount"]
)" + blade(of_blade) +
         R"(
[[body]]
name = "mount"
mass = 5
inertia = [1, 1, 1]
position = [0, 0, -1]
[[weld]]
name = "foot"
from = [0, 0, -1]
to = "mount"
[[prismatic]]
name = "mast"
from = "mount"
to = "hub"
axis = [0, 0, 1]
[[spring]]
from = "mount"
to = "hub"
stiffness = 1e5
free_length = 1
)";
}

std::string traced(const std::string& parameter, double from, double to) {
  return "[trace]\nparameter = \"" + parameter + "\"\nfrom = " + std::to_string(from) +
         "\nto = " + std::to_string(to) + "\ntolerance = 1e-9\n";
}

/// Of the air on a stiff blade per sin(pitch): 1/2 rho c a times the integral of (omega r)^2.
double lift(double speed = omega) {
  return 0.5 * density * chord * slope * speed * speed * (std::pow(tip, 3) - std::pow(root, 3)) / 3.0;
}

/// Its moment about the hinge.
double lift_moment() {
  const double first = (std::pow(tip, 4) - std::pow(root, 4)) / 4.0;
  return 0.5 * density * chord * slope * omega * omega * first - hinge * lift();
}

/// The thrust is that of all blades, the loads of the blade are those of one, and the support carries all.
TEST(RotorTrim, LoadsOfBladesAndSupportHaveTheirClosedForms) {
  struct Case {
    const char* condition;
    double sine;  ///< of the pitch for a weight of 2000 N and a rise of 0.02 m
  };
  for (const Case& c :
       {Case{"thrust(air) = weight", 2000.0 / (blades * lift())},
        Case{"force(air, z) = weight", 2000.0 / lift()}, Case{"force(flap, z) = -weight", 2000.0 / lift()},
        Case{"force(foot, z) = -weight", 2000.0 / (blades * lift())},
        Case{"position(hub, z) = rise", 0.02 * stiffness / (blades * lift())},
        Case{"moment(flap, y) = weight * arm", 2000.0 / lift_moment()},
        Case{"position(blade, z) = rise", 0.02 * stiffness / (blades * lift())}}) {
    const bool rises = std::string(c.condition).find("rise") != std::string::npos;
    const std::string parameter = rises ? "rise" : "weight";
    const Setting setting =
        make_setting(rotor() + traced(parameter, 0.01, 3000) + trim("pitch", c.condition));
    const Solved found = solve(setting, parameter, rises ? 0.02 : 2000.0);
    ASSERT_EQ(found.at.status, SteadyStatus::converged) << c.condition << ": " << found.at.report.message;
    EXPECT_NEAR(std::sin(found.unknowns[0]), c.sine, 1e-11 * c.sine) << c.condition;
  }
}

/// Several conditions, of the support and of blades in turn, come back in the order of the scene.
TEST(RotorTrim, UnknownsKeepTheOrderOfTheScene) {
  const Setting setting =
      make_setting(rotor() + traced("weight", 1000, 3000) + trim("rise", "position(hub, z) = rise") +
                   trim("pitch", "thrust(air) = weight"));
  const Solved both = solve(setting, "weight", 1600.0);
  ASSERT_EQ(both.at.status, SteadyStatus::converged) << both.at.report.message;
  EXPECT_NEAR(both.unknowns[0], 1600.0 / stiffness, 1e-13);
  EXPECT_NEAR(std::sin(both.unknowns[1]), 1600.0 / (blades * lift()), 1e-12);
}

/// The angle of a hinge and the moment of its spring are those of every blade.
TEST(RotorTrim, ConingIsThatOfEveryBlade) {
  for (const char* condition : {"angle(flap) = coning", "moment(spring) = -coning * spring"}) {
    const Setting setting = make_setting(rotor("") + traced("coning", 0.01, 0.06) + trim("pitch", condition));
    const Solved found = solve(setting, "coning", 0.04);
    ASSERT_EQ(found.at.status, SteadyStatus::converged) << condition << ": " << found.at.report.message;
    const auto& names = setting.model->description().coordinate_names;
    const auto at = std::find(names.begin(), names.end(), "blade.x_axis.z collective") - names.begin();
    ASSERT_LT(at, static_cast<std::ptrdiff_t>(names.size()));
    EXPECT_NEAR(found.at.x[at], std::sin(0.04), 1e-12) << condition;
  }
}

/// Eigenvalues along a trim are those of the rotor whose pitch, or speed, is a number. The speed enters the
/// equations in multiblade coordinates on its own.
TEST(RotorTrim, LociAreThoseWithTheUnknownsAsNumbers) {
  for (const char* unknown : {"pitch", "omega"}) {
    const Setting setting =
        make_setting(rotor("") + traced("weight", 1000, 3000) + trim(unknown, "thrust(air) = weight"));
    const RecordedTrace recorded = completed_trace(setting);
    for (const double weight : {1350.0, 2710.0}) {
      const Solved there = solve(setting, "weight", weight);
      ASSERT_EQ(there.at.status, SteadyStatus::converged) << there.at.report.message;
      const Setting fixed = make_setting(rotor("") + traced(unknown, 0.0, 100.0));
      RunCounts counts;
      const PathPoint point = point_from_guess(fixed.problem(), there.unknowns[0], counts);
      ASSERT_EQ(point.status, PointStatus::computed);
      const Spectrum all = compute_spectrum(point.pencil.M[0], point.pencil.C[0], point.pencil.K[0]);
      const ComplexVector found = recorded.eigenvalues_at(weight);
      ASSERT_GT(found.size(), 3);
      for (const Complex& s : found) {
        double nearest = INFINITY;
        for (const StartingMode& mode : all.modes) nearest = std::min(nearest, std::abs(mode.s - s));
        EXPECT_LT(nearest, 4e-9 * std::abs(s)) << unknown << " at " << weight << ": " << s;
      }
    }
  }
}

TEST(RotorTrim, SeriesHaveTheirOrder) {
  const Setting setting =
      make_setting(rotor("") + traced("weight", 1000, 3000) + trim("pitch", "thrust(air) = weight") +
                   trim("omega", "moment(spring) = -(1 + pitch / radian) * 200 * spring * radian / 1e4"));
  expect_orders_of_series(setting, "weight", 2000.0, 400.0, 0.4);
}

/// The rows and columns that the solver uses, by central differences. The hub stays on its axis, which other
/// conditions of a rotor call for.
TEST(RotorTrim, DerivativesAgreeWithDifferences) {
  const Setting setting =
      make_setting(rotor("") + "[[force]]\npoint = \"blade\"\ncomponents = [\"push\", \"push\", 0]\n" +
                   traced("spring", 1e4, 2e4) + trim("pitch", "thrust(air) = weight") +
                   trim("omega", "moment(flap, x) = torque") + trim("weight", "force(foot, z) = push") +
                   trim("torque", "moment(spring) = 2 * torque") + trim("push", "force(flap, y) = 3 * push") +
                   trim("coning", "angle(flap) = coning"));
  const Model& model = *setting.model;
  EvaluationCounts counts = model.new_counts();
  const Vector all = setting.scene.parameters.declared_values();
  const auto& names = model.description().coordinate_names;
  const std::set<std::string> on_axis = {"hub.x", "hub.y", "hub.z_axis.x", "hub.z_axis.y"};
  Vector x = model.initial_guess(all);
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    if (!on_axis.contains(names[static_cast<std::size_t>(j)]))
      x[j] += 0.05 * std::sin(1.3 * static_cast<double>(j));
  }
  Vector lambda = Vector::LinSpaced(model.n_multipliers(), 0.7, -1.1);
  lambda.tail(model.n_trims()) = model.first_multipliers(all).tail(model.n_trims());
  TrimDerivatives exact;
  ASSERT_FALSE(model.trim_derivatives({all, x, lambda}, exact, counts));
  const Eigen::Index n = x.size(), m = model.n_constraints(), k = model.n_trims();
  const auto residual = [&](const Vector& at_x, const Vector& at_lambda) {
    SteadyResidual result;
    EXPECT_FALSE(model.residual({all, at_x, at_lambda}, 0, result, counts));
    return result;
  };
  constexpr double h = 1e-5;
  const auto difference = [&](const Vector& dx, const Vector& dl) {
    const SteadyResidual ahead = residual(x + h * dx, lambda + h * dl);
    const SteadyResidual back = residual(x - h * dx, lambda - h * dl);
    return SteadyResidual{(ahead.force - back.force) / (2.0 * h),
                          (ahead.constraint - back.constraint) / (2.0 * h)};
  };
  const double large = blades * lift();
  for (Eigen::Index j = 0; j < n; ++j) {
    if (on_axis.contains(names[static_cast<std::size_t>(j)])) continue;
    const SteadyResidual slopes = difference(Vector::Unit(n, j), Vector::Zero(m + k));
    EXPECT_LT((slopes.constraint.col(0).tail(k) - exact.x.col(j)).norm(), 1e-8 * large)
        << names[static_cast<std::size_t>(j)];
  }
  for (Eigen::Index j = 0; j < m + k; ++j) {
    const SteadyResidual slopes = difference(Vector::Zero(n), Vector::Unit(m + k, j));
    const Vector expected = j < m ? Vector(exact.lambda.col(j)) : Vector(exact.trim.col(j - m));
    EXPECT_LT((slopes.constraint.col(0).tail(k) - expected).norm(), 1e-8 * large) << j;
    if (j < m) continue;
    EXPECT_LT((slopes.force.col(0) - exact.force.col(j - m)).norm(), 1e-8 * large) << j;
    EXPECT_LT((slopes.constraint.col(0).head(m) - exact.constraint.col(j - m)).norm(), 1e-8 * large) << j;
  }
}

/// The rounding of double is in the condition, not in its value with 113 bits.
TEST(RotorTrim, ExtendedResidualHasTheConditions) {
  const Setting setting =
      make_setting(rotor("") + traced("weight", 1000, 3000) + trim("pitch", "thrust(air) = weight"));
  const Model& model = *setting.model;
  const Vector all = setting.scene.parameters.declared_values();
  const Solved found = solve(setting, "weight", all[setting.parameter("weight")]);
  ASSERT_EQ(found.at.status, SteadyStatus::converged) << found.at.report.message;
  BasicPath<Extended> path{all.cast<Extended>(), found.at.x.cast<Extended>(),
                           found.at.lambda.cast<Extended>()};
  BasicSteadyResidual<Extended> residual;
  ASSERT_FALSE(model.extended_residual(path, residual));
  ASSERT_EQ(residual.constraint.rows(), model.n_multipliers());
  EXPECT_LT(std::abs(static_cast<double>(residual.constraint(model.n_constraints(), 0))), 1e-9);
  path.lambda(model.n_constraints(), 0) += Extended(0.01);
  ASSERT_FALSE(model.extended_residual(path, residual));
  EXPECT_NEAR(static_cast<double>(residual.constraint(model.n_constraints(), 0)), 0.01 * blades * lift(),
              0.01 * blades * lift());
}

/// The forces of the blades across the axis cancel, so no condition there on the support determines anything.
TEST(RotorTrim, ForceOfTheSupportAcrossTheAxisIsSingular) {
  const Setting setting =
      make_setting(rotor() + traced("weight", 1000, 3000) + trim("pitch", "force(foot, y) = weight"));
  const Solved found = solve(setting, "weight", 2000.0);
  EXPECT_EQ(found.at.status, SteadyStatus::not_converged);
  EXPECT_NE(found.at.report.message.find("force(foot, y) = weight"), std::string::npos)
      << found.at.report.message;
  EXPECT_NE(found.at.report.message.find("'pitch'"), std::string::npos) << found.at.report.message;
}

TEST(RotorTrim, MistakesAreNamed) {
  struct Case {
    std::string more, condition, message;
  };
  const std::string of_mount =
      "[[strips]]\nname = \"mount air\"\non = \"mount\"\nroot = [0, 0, 0]\ntip = [1, 0, 0]\nleading = [0, 1, "
      "0]\nchord = 0.1\n";
  for (const Case& c : {Case{"", "thrust(hub) = weight", "no strips or inflow is called 'hub'; known: air"},
                        Case{of_mount, "thrust(mount air) = weight",
                             "are not on the blade of [rotor]; expected force(mount air, z)"},
                        Case{"", "thrust(air, z) = weight", "expected one name in the brackets"},
                        Case{"", "thrust(air) = torque", "N m, but N is expected"}}) {
    const std::string message = input_error([&] {
      (void)make_setting(rotor() + c.more + traced("weight", 1000, 3000) + trim("pitch", c.condition));
    });
    EXPECT_TRUE(contains(message, c.message)) << message;
  }
}

}  // namespace
}  // namespace eigentrail::test::rotor_trim_test
