// Trimmed parameters: unknowns of the equilibrium that conditions determine.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "eigentrail/steady/path_plane.hpp"
#include "scene/input_error.hpp"
#include "steady/trims.hpp"
#include "support/resumed.hpp"

namespace eigentrail::test::trim_test {
namespace {

constexpr double g = 9.81, mass = 2.0, arm = 0.7, inertia = 0.01, stiffness = 3.0;

/// A physical pendulum with a torsional spring, on which a torque acts.
std::string pendulum(const std::string& trace, const std::string& trims) {
  return R"(
[parameters]
torque = { value = 0.1, unit = "N m" }
push = { value = 0.0, unit = "N" }
angle = { value = 0.3, unit = "rad" }
reach = { value = 0.2, unit = "m" }
load = { value = 1.0, unit = "N" }
moment = { value = 1.0, unit = "N m" }
idle = { value = 1.0, unit = "N" }
[gravity]
acceleration = [0, 0, -9.81]
[[body]]
name = "bob"
mass = 2
centre = [0, 0, -0.7]
inertia = [0.01, 0.01, 0.01]
position = [0, 0, 0]
markers = { tip = [0, 0, -0.7] }
[[revolute]]
name = "hinge"
from = [0, 0, 0]
to = "bob"
axis = [0, -1, 0]
[[torsional_spring]]
name = "spring"
joint = "hinge"
stiffness = 3
[[moment]]
body = "bob"
along = [0, -1, 0]
magnitude = "torque"
[[force]]
point = "bob.tip"
components = ["push", 0, 0]
[trace]
tolerance = 1e-9
)" + trace +
         trims;
}

std::string along(const std::string& parameter, double from, double to) {
  return "parameter = \"" + parameter + "\"\nfrom = " + std::to_string(from) +
         "\nto = " + std::to_string(to) + "\n";
}

/// Frequency of the pendulum at an angle, with the torque held.
double frequency(double angle) {
  return std::sqrt((mass * g * arm * std::cos(angle) + stiffness) / (inertia + mass * arm * arm));
}

double holding_torque(double angle) {
  return mass * g * arm * std::sin(angle) + stiffness * angle;
}

/// The torque is constant in the motion: the frequency has the stiffness of gravity and spring alone, not
/// that of a condition that holds the angle.
TEST(Trim, LociFollowTheTrimmedStateWithTheUnknownsHeld) {
  const Setting setting =
      make_setting(pendulum(along("angle", 0.1, 1.2), trim("torque", "angle(hinge) = angle")));
  const RecordedTrace recorded = completed_trace(setting);
  for (int i = 0; i < 50; ++i) {
    const double angle = 0.1 + 1.1 * i / 50.0;
    const ComplexVector s = recorded.eigenvalues_at(angle);
    ASSERT_EQ(s.size(), 1);
    EXPECT_NEAR(s[0].imag(), frequency(angle), 4e-9 * frequency(angle));
  }
  const PathNode& last = recorded.nodes.back();
  const Eigen::Index row = setting.model->n_constraints();
  EXPECT_NEAR(last.path.lambda(row, 0), holding_torque(1.2), 1e-10);
  EXPECT_NEAR(last.path.lambda(row, 1), mass * g * arm * std::cos(1.2) + stiffness, 1e-9);
  // Each stored step has the series of the torque.
  ASSERT_EQ(recorded.steps.front().trimmed.size(), 1u);
  EXPECT_NEAR(recorded.steps.back().trimmed[0](1, 0), holding_torque(1.2), 1e-10);
}

/// A free hinge without gravity has no stiffness: only torque and condition together determine the angle.
TEST(Trim, ConditionDeterminesAFreedomThatNothingElseHolds) {
  std::string scene = pendulum(along("angle", 0.1, 1.2), trim("torque", "angle(hinge) = angle"));
  const auto replace = [&scene](const std::string& what, const std::string& with) {
    ASSERT_NE(scene.find(what), std::string::npos);
    scene.replace(scene.find(what), what.size(), with);
  };
  replace("-9.81", "-0.0");
  replace("stiffness = 3", "stiffness = 0");
  const Setting setting = make_setting(scene);
  const Solved found = solve(setting, "angle", 0.8);
  ASSERT_EQ(found.at.status, SteadyStatus::converged) << found.at.report.message;
  EXPECT_NEAR(found.unknowns[0], 0.0, 1e-12);
  EXPECT_NEAR(std::atan2(found.at.x[9], found.at.x[11]), -0.8, 1e-12);  // z axis of the bob
}

TEST(Trim, QuantitiesHaveTheirClosedForms) {
  struct Case {
    const char* unknown;
    const char* condition;
    double expected;  // of the unknown, with the other parameters as declared
  };
  // At the angle a, the hinge carries weight and push; a negative moment about the hinge opposes the torque.
  const double a = 0.4;
  const std::string hold = trim("torque", "angle(hinge) = 0.4");
  const double reach = arm * std::sin(a);
  for (const Case& c :
       {Case{"push", "force(hinge, x) = -load", 1.0}, Case{"push", "force(hinge, x) = 3 * load", -3.0}}) {
    const Setting setting = make_setting(pendulum(along("load", 1, 2), hold + trim(c.unknown, c.condition)));
    const Solved found = solve(setting, "load", 1.0);
    ASSERT_EQ(found.at.status, SteadyStatus::converged) << found.at.report.message;
    EXPECT_NEAR(found.unknowns[1], c.expected, 1e-11) << c.condition;
    EXPECT_NEAR(found.unknowns[0], holding_torque(a) - c.expected * arm * std::cos(a), 1e-11) << c.condition;
  }
  const Setting of_place =
      make_setting(pendulum(along("reach", 0.1, 0.3), trim("torque", "position(bob.tip, x) = reach")));
  const Solved placed = solve(of_place, "reach", reach);
  ASSERT_EQ(placed.at.status, SteadyStatus::converged) << placed.at.report.message;
  EXPECT_NEAR(placed.unknowns[0], holding_torque(a), 1e-11);
  const Setting of_spring =
      make_setting(pendulum(along("moment", -2, -1), trim("torque", "moment(spring) = moment")));
  const Solved sprung = solve(of_spring, "moment", -stiffness * a);
  ASSERT_EQ(sprung.at.status, SteadyStatus::converged) << sprung.at.report.message;
  EXPECT_NEAR(sprung.unknowns[0], holding_torque(a), 1e-11);
}

/// A joint that holds its angle has the moment of what it holds.
TEST(Trim, HingeMomentOfAHeldJoint) {
  std::string scene = pendulum(along("moment", 1, 2), trim("push", "moment(hinge, y) = moment"));
  scene.replace(scene.find("axis = [0, -1, 0]\n"), 18, "axis = [0, -1, 0]\nangle = \"angle\"\n");
  const Setting setting = make_setting(scene);
  const Solved found = solve(setting, "moment", 1.5);
  ASSERT_EQ(found.at.status, SteadyStatus::converged) << found.at.report.message;
  // About -y: torque - weight - spring + push arm cos - moment of the hinge (about y) = 0.
  const double a = 0.3;
  EXPECT_NEAR(found.unknowns[0], (1.5 + holding_torque(a) - 0.1) / (arm * std::cos(a)), 1e-10);
}

const std::string wing = R"(
trace = { parameter = "speed", from = 20, to = 60, tolerance = 1e-9 }
body = [{ name = "wing", mass = 10, inertia = [1, 1, 1], position = [0, 0, 0] }]
prismatic = [{ from = [0, 0, 0], to = "wing", axis = [0, 0, 1] }]
spring = [{ from = [0, 0, 10], to = "wing", stiffness = 100, free_length = 10 }]
trim = [{ unknown = "alpha", condition = "force(air, z) = weight" }]
[parameters]
speed = { value = 20.0, unit = "m/s" }
alpha = { value = 0.01, unit = "rad" }
weight = { value = 100, unit = "N" }
[[strips]]
name = "air"
on = "wing"
root = [0, -1, 0]
tip = [0, 1, 0]
leading = [-1, 0, 0]
incidence = "alpha"
chord = 0.4
lift_slope = 5.5
wind = ["speed", 0, 0]
density = 1.2
)";

TEST(Trim, LiftOfStripsCarriesAWeight) {
  const Setting setting = make_setting(wing);
  for (const double speed : {20.0, 35.0, 60.0}) {
    const Solved found = solve(setting, "speed", speed);
    ASSERT_EQ(found.at.status, SteadyStatus::converged) << found.at.report.message;
    EXPECT_NEAR(found.unknowns[0], std::asin(100.0 / (0.5 * 1.2 * speed * speed * 0.8 * 5.5)), 1e-12);
  }
}

TEST(Trim, SeriesHaveTheirOrder) {
  const Setting setting = make_setting(
      pendulum(along("reach", 0.1, 0.6), trim("torque", "position(bob.tip, x) = reach") +
                                             trim("push", "force(hinge, x) = -(1 + torque/moment) * load")));
  expect_orders_of_series(setting, "reach", 0.35, 0.04);
}

/// Sensitivities at an event take the factorization of the point there, which may have been solved for on a
/// plane across the path: it has the conditions of the trim as any other. `extra`: parts that change nothing
/// but make the system a sparse one.
void expect_same_slopes_on_a_plane(const std::string& extra) {
  const Setting setting =
      make_setting(extra + pendulum(along("angle", 0.1, 1.2), trim("torque", "angle(hinge) = angle")));
  EvaluationCounts counts = setting.model->new_counts();
  const Solved held = solve(setting, "angle", 0.7);
  ASSERT_EQ(held.at.status, SteadyStatus::converged) << held.at.report.message;
  Vector parameters = setting.scene.parameters.declared_values();
  double angle = 0.7;
  parameters[setting.parameter("angle")] = angle;
  PathPlane plane;
  plane.x = Vector::Zero(setting.model->n_coordinates());
  plane.u = Vector::Ones(1);
  const Equilibrium on_plane =
      solve_equilibrium_on(plane, *setting.model, parameters, setting.parameter("angle"), held.at.x,
                           held.at.lambda, {}, angle, counts);
  ASSERT_EQ(on_plane.status, SteadyStatus::converged) << on_plane.report.message;
  EXPECT_TRUE(on_plane.kkt.can_solve());
  VectorSeries direction = VectorSeries::Zero(parameters.size(), 2);
  direction.col(0) = parameters;
  direction(setting.parameter("push"), 1) = 1.0;
  Path expected, found;
  ASSERT_FALSE(differentiate_equilibrium(*setting.model, held.at, direction, 2, expected, counts));
  ASSERT_FALSE(differentiate_equilibrium(*setting.model, on_plane, direction, 2, found, counts));
  // The push is carried by the torque: push arm cos(angle).
  EXPECT_NEAR(std::abs(expected.lambda(expected.lambda.rows() - 1, 1)), arm * std::cos(angle), 1e-10);
  EXPECT_LT((found.x - expected.x).norm(), 1e-9);
  EXPECT_LT((found.lambda.bottomRows(1) - expected.lambda.bottomRows(1)).norm(), 1e-9);
}

TEST(Trim, SlopesOnAPlaneHaveTheConditions) {
  expect_same_slopes_on_a_plane("");
}

TEST(Trim, SlopesOnAPlaneHaveTheConditionsInASparseSystem) {
  std::string points;
  for (int i = 0; i < 120; ++i)
    points += "[[point]]\nname = \"p" + std::to_string(i) + "\"\nmass = 1\nposition = [" + std::to_string(i) +
              ", 0, 0]\n[[spring]]\nfrom = [" + std::to_string(i) + ", 0, 1]\nto = \"p" + std::to_string(i) +
              "\"\nstiffness = 100\nfree_length = 0.5\n";
  expect_same_slopes_on_a_plane(points);
}

/// The rows that the solver uses, by central differences of the conditions themselves. The joint between two
/// bodies moves, and so does the axis of the spring.
TEST(Trim, DerivativesOfConditionsAgreeWithDifferences) {
  const Setting setting = make_setting(R"(
trace = { parameter = "e", from = 1, to = 2 }
frame = { angular_velocity = [0, 0, "e"] }
body = [
  { name = "first", mass = 1, inertia = [1, 2, 3], position = [1, 0, 0] },
  { name = "second", mass = 1, inertia = [1, 2, 3], position = [2, 0, 0] },
]
torsional_spring = [{ joint = "middle", name = "spring", stiffness = 10, preload = "a" }]
moment = [{ body = "second", along = [1, 2, 3], magnitude = "b" }]
force = [{ point = "second", components = ["c", "c", "c"] }]
trim = [
  { unknown = "a", condition = "moment(spring) = b" },
  { unknown = "b", condition = "moment(middle, x) = 3 * a" },
  { unknown = "c", condition = "force(middle, y) = 2 * c" },
  { unknown = "d", condition = "force(air, z) = c" },
]
[parameters]
a = { value = 1.0, unit = "N m" }
b = { value = 1.0, unit = "N m" }
c = { value = 1.0, unit = "N" }
d = { value = 0.1, unit = "rad" }
e = { value = 1.0, unit = "rad/s" }
[[revolute]]
from = [0.5, 0, 0]
to = { body = "first", at = [-0.5, 0, 0] }
axis = [0, 0, 1]
name = "root"
[[revolute]]
name = "middle"
from = { body = "first", at = [0.5, 0, 0] }
to = { body = "second", at = [-0.5, 0, 0] }
axis = [0, 1, 0]
[[strips]]
name = "air"
on = "second"
root = [-0.5, 0, 0]
tip = [0.5, 0, 0]
incidence = "d"
chord = 0.2
)");
  const Model& model = *setting.model;
  EvaluationCounts counts = model.new_counts();
  const Vector parameters = setting.scene.parameters.declared_values();
  Vector x = model.initial_guess(parameters);
  x += 0.05 * Vector::LinSpaced(x.size(), -1.0, 1.3).array().sin().matrix();
  Vector lambda = Vector::LinSpaced(model.n_multipliers(), 0.7, -1.1);
  TrimDerivatives exact;
  ASSERT_FALSE(model.trim_derivatives({parameters, x, lambda}, exact, counts));
  const Eigen::Index n = x.size(), m = model.n_constraints(), k = model.n_trims();
  const auto conditions = [&](const Vector& at_x, const Vector& at_lambda) -> Vector {
    SteadyResidual residual;
    EXPECT_FALSE(model.residual({parameters, at_x, at_lambda}, 0, residual, counts));
    return residual.constraint.col(0).tail(k);
  };
  constexpr double h = 1e-5;
  for (Eigen::Index j = 0; j < n; ++j) {
    const Vector step = h * Vector::Unit(n, j);
    const Vector slope = (conditions(x + step, lambda) - conditions(x - step, lambda)) / (2.0 * h);
    EXPECT_LT((slope - exact.x.col(j)).norm(), 1e-7) << model.description().coordinate_names[j];
  }
  for (Eigen::Index j = 0; j < m + k; ++j) {
    const Vector step = h * Vector::Unit(m + k, j);
    const Vector slope = (conditions(x, lambda + step) - conditions(x, lambda - step)) / (2.0 * h);
    const Vector expected = j < m ? Vector(exact.lambda.col(j)) : Vector(exact.trim.col(j - m));
    EXPECT_LT((slope - expected).norm(), 1e-7) << j;
  }
}

/// position x = arm sin(angle) has its largest value where the pendulum stands level. The stiffness with the
/// torque held is that of the spring there, so no eigenvalue tells the fold.
TEST(Trim, PathTurnsBackWhereTheConditionHasAFold) {
  const Setting setting =
      make_setting(pendulum(along("reach", 0.3, 0.9), trim("torque", "position(bob.tip, x) = reach")));
  const RecordedTrace recorded = completed_trace(setting);
  EXPECT_NEAR(only_event(recorded.result, EventKind::fold).p, arm, 1e-9);
  // On the way back the angle is beyond a quarter turn.
  const std::vector<ComplexVector> both = recorded.all_eigenvalues_at(0.5);
  ASSERT_EQ(both.size(), 2u);
  const double angle = std::asin(0.5 / arm);
  EXPECT_NEAR(both[0][0].imag(), frequency(angle), 4e-9 * frequency(angle));
  const double square =
      (mass * g * arm * std::cos(std::numbers::pi - angle) + stiffness) / (inertia + mass * arm * arm);
  EXPECT_NEAR((both[1][0] * both[1][0]).real(), -square, 1e-8 * std::abs(square));
}

/// torque cos(lean) holds the pendulum at an angle while the torque falls: lean passes zero where the torque
/// is least, and nothing else moves. In any unit of lean, and whatever its guess.
TEST(Trim, PathTurnsBackWhereOnlyTheUnknownMoves) {
  struct Case {
    const char* lean;
    const char* cosine;
    double unit;
  };
  for (const Case& c : {Case{"{ value = 1.0, unit = \"rad\" }", "cos(lean)", 1.0},
                        Case{"{ value = 60.0, unit = \"deg\" }", "cos(lean)", std::numbers::pi / 180.0},
                        Case{"{ value = 1e-4, unit = \"rad\" }", "cos(1e4 * lean)", 1e4},
                        Case{"{ value = 1e4, unit = \"rad\" }", "cos(1e-4 * lean)", 1e-4}}) {
    const double least = holding_torque(0.3);
    std::string scene =
        pendulum(along("torque", 2.0 * least, 0.5 * least), trim("lean", "angle(hinge) = angle"));
    const auto replace = [&scene](const std::string& what, const std::string& with) {
      ASSERT_NE(scene.find(what), std::string::npos);
      scene.replace(scene.find(what), what.size(), with);
    };
    replace("magnitude = \"torque\"", "magnitude = \"torque * " + std::string(c.cosine) + "\"");
    replace("[gravity]", "lean = " + std::string(c.lean) + "\n[gravity]");
    const Setting setting = make_setting(scene);
    const RecordedTrace recorded = record_trace(setting);
    EXPECT_EQ(recorded.result.status, TraceStatus::completed) << c.lean << ": " << recorded.result.message;
    EXPECT_NEAR(only_event(recorded.result, EventKind::fold).p, least, 1e-9 * least) << c.lean;
    const PathNode& last = recorded.nodes.back();
    EXPECT_EQ(last.p, recorded.nodes.front().p) << c.lean;
    EXPECT_NEAR(last.path.lambda(setting.model->n_constraints(), 0) * c.unit, -std::numbers::pi / 3.0, 1e-8)
        << c.lean;
    EXPECT_EQ(first_resumed_difference(*setting.model, setting.options, 3), "") << c.lean;
  }
}

/// lean (lean - offset) = 0: the path lean = 0 crosses lean = offset where offset is zero, in the unknown
/// alone, at a regular stiffness.
TEST(Trim, CrossingOfTrimmedPathsIsABranchPoint) {
  std::string scene = pendulum(along("offset", -0.37, 0.6),
                               trim("torque", "angle(hinge) = angle") +
                                   trim("lean", "position(bob.tip, y) = reach * lean * (lean - offset)"));
  scene.replace(scene.find("[gravity]"), 0, "lean = 0.0\noffset = -0.37\n");
  const Setting setting = make_setting(scene);
  const RecordedTrace recorded = completed_trace(setting);
  std::vector<double> places;
  for (const Event& event : recorded.result.events) {
    EXPECT_NE(event.kind, EventKind::fold);
    if (event.kind == EventKind::branch_point) places.push_back(event.p);
  }
  ASSERT_EQ(places.size(), 1u);
  EXPECT_NEAR(places[0], 0.0, 1e-9);
  const auto& notes = recorded.result.notes;
  EXPECT_TRUE(std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
    return note.starts_with("another trimmed path crosses at offset = ");
  }));
  EXPECT_NEAR(recorded.nodes.back().path.lambda(setting.model->n_constraints() + 1, 0), 0.0, 1e-9);
}

/// Where the stiffness with the torque held passes zero, the trimmed path goes straight on.
TEST(Trim, DivergenceWithHeldControlsIsNoFold) {
  const Setting setting =
      make_setting(pendulum(along("angle", 1.0, 2.6), trim("torque", "angle(hinge) = angle")));
  const RecordedTrace recorded = completed_trace(setting);
  const double critical = std::acos(-stiffness / (mass * g * arm));
  int zeros = 0;
  for (const Event& event : recorded.result.events) {
    EXPECT_NE(event.kind, EventKind::fold);
    EXPECT_NE(event.kind, EventKind::branch_point);
    if (std::abs(event.p - critical) < 1e-8) ++zeros;
  }
  EXPECT_EQ(zeros, 1);
  EXPECT_EQ(recorded.nodes.back().p, 2.6);
}

TEST(Trim, SingularTrimNamesConditionAndUnknown) {
  const Setting setting =
      make_setting(pendulum(along("angle", 0.1, 1.2),
                            trim("torque", "force(hinge, y) = idle") + trim("push", "angle(hinge) = angle")));
  const Solved found = solve(setting, "angle", 0.5);
  EXPECT_EQ(found.at.status, SteadyStatus::not_converged);
  EXPECT_NE(found.at.report.message.find("force(hinge, y) = idle"), std::string::npos)
      << found.at.report.message;
  EXPECT_NE(found.at.report.message.find("'torque'"), std::string::npos) << found.at.report.message;
}

TEST(Trim, MistakesAreNamed) {
  struct Case {
    std::string trims, message;
  };
  const std::string trace = along("angle", 0.1, 1.2);
  for (const Case& c : {Case{trim("torqe", "angle(hinge) = angle"), "no parameter is called 'torqe'"},
                        Case{trim("angle", "angle(hinge) = angle"), "'angle' is the unknown of a [[trim]]"},
                        Case{trim("torque", "angle(hinge) = angle") + trim("torque", "angle(hinge) = angle"),
                             "is the unknown of another [[trim]] already"},
                        Case{trim("torque", "angle(hing) = angle"),
                             "no joint with one angle (revolute, cylindrical) is called 'hing'"},
                        Case{trim("torque", "angle(hinge) = load"), "N, but rad is expected"},
                        Case{trim("torque", "angel(hinge) = angle"), "no quantity is called 'angel'"},
                        Case{trim("torque", "angle hinge"), "expected \"quantity(name) = expression\""},
                        Case{trim("torque", "force(hinge) = load"), "expected a name and an axis"},
                        Case{trim("torque", "force(hinge, w) = load"), "expected the axis x, y or z"},
                        Case{trim("torque", "force(air, z) = load"), "no joint or strips is called 'air'"},
                        Case{trim("torque", "thrust(disc) = load"), "no [[inflow]] is called 'disc'"},
                        Case{trim("torque", "position(bob.top, x) = reach"), "'bob.top'"}}) {
    const std::string message = input_error([&] { (void)make_setting(pendulum(trace, c.trims)); });
    EXPECT_TRUE(contains(message, c.message)) << message;
  }
}

TEST(Trim, FamilyOfMatricesIsRefused) {
  const std::string family =
      "[parameters]\nq = 1\n[trace]\nparameter = \"p\"\nfrom = 0\nto = 1\n[matrix_family]\nM = [[[1]]]\nK = "
      "[[[1]], [[1]]]\n";
  const std::string message =
      input_error([&] { (void)make_setting(family + trim("q", "angle(hinge) = 1")); });
  EXPECT_TRUE(contains(message, "have no equilibrium to trim")) << message;
}

}  // namespace
}  // namespace eigentrail::test::trim_test
