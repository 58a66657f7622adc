// The multibody model: structure flags, counters, names, guesses.
#include <gtest/gtest.h>

#include <cmath>

#include "support/scenes.hpp"

namespace eigentrail::test::multibody_test {
namespace {

TEST(Multibody, AbsentEffectsAreNeverEvaluated) {
  const Setting setting = scene_setting("pendulum");
  const RecordedTrace recorded = record_trace(setting);
  const auto& effects = setting.model->description().effects;
  const EvaluationCounts& counts = recorded.result.counts.evaluations;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    if (effects[i].count == 0) {
      EXPECT_EQ(counts.residual[i] + counts.linearization[i], 0U) << effects[i].name;
    } else {
      EXPECT_GT(counts.linearization[i], 0U) << effects[i].name;
    }
  }
}

TEST(Multibody, NamesCoordinatesAndConstraintsAfterTheScene) {
  const Setting setting = scene_setting("pendulum");
  const ModelDescription& description = setting.model->description();
  EXPECT_EQ(description.coordinate_names, (std::vector<std::string>{"bob.x", "bob.y", "bob.z"}));
  EXPECT_EQ(description.constraint_names, (std::vector<std::string>{"rod 1", "fixed 1"}));
}

struct StructureCase {
  std::string name;
  std::string scene;
  std::string parameter;
  bool fixed_equilibrium, constant_mass, constant_damping, constant_stiffness, constant_constraints;
};

class MultibodyStructure : public testing::TestWithParam<StructureCase> {};

TEST_P(MultibodyStructure, FollowsFromWhereTheParameterEnters) {
  const StructureCase& c = GetParam();
  const Setting setting = scene_setting(c.scene);
  const Structure structure = setting.model->structure(setting.parameter(c.parameter));
  EXPECT_EQ(structure.fixed_equilibrium, c.fixed_equilibrium);
  EXPECT_EQ(structure.constant_mass, c.constant_mass);
  EXPECT_EQ(structure.constant_damping, c.constant_damping);
  EXPECT_EQ(structure.constant_stiffness, c.constant_stiffness);
  EXPECT_EQ(structure.constant_constraints, c.constant_constraints);
}

INSTANTIATE_TEST_SUITE_P(
    Parameters, MultibodyStructure,
    testing::Values(
        StructureCase{"SpeedMovesEverythingButMass", "rotating_mass", "omega", false, true, false, false,
                      false},
        StructureCase{"DragEntersOnlyDamping", "rotating_mass", "drag", true, true, false, true, true},
        StructureCase{"MassEntersWithTheFrame", "rotating_mass", "mass", false, false, false, false, false},
        StructureCase{"GravityMovesTheEquilibrium", "pendulum", "g", false, true, true, false, false},
        StructureCase{"LengthEntersTheConstraint", "pendulum", "length", false, true, true, false, false}),
    [](const auto& tested) { return tested.param.name; });

TEST(Multibody, StructureFlagsComeFromTheEffects) {
  const Structure blade = scene_setting("rotating_mass").model->structure(0);
  EXPECT_TRUE(blade.damped && blade.gyroscopic && blade.circulatory);
  const Structure pendulum = scene_setting("pendulum").model->structure(0);
  EXPECT_FALSE(pendulum.damped || pendulum.gyroscopic || pendulum.circulatory);
}

TEST(Multibody, TracingAParameterThatMovesNothingKeepsTheEquilibrium) {
  const Setting setting =
      scene_setting("rotating_mass", {{"parameter", "drag"}, {"from", "1"}, {"to", "30"}});
  const RecordedTrace recorded = completed_trace(setting);
  for (const PathNode& node : recorded.nodes) EXPECT_EQ(node.path.x.col(0), recorded.nodes[0].path.x.col(0));
  // KINSOL ran at the first point only.
  const RecordedTrace shorter =
      record_trace(scene_setting("rotating_mass", {{"parameter", "drag"}, {"from", "1"}, {"to", "1.5"}}));
  EXPECT_EQ(recorded.result.counts.equilibrium_iterations, shorter.result.counts.equilibrium_iterations);
}

/// No constraints, so there are no multipliers whose absence could stand for "not solved yet".
TEST(Multibody, FixedEquilibriumWithoutConstraintsIsSolvedAtTheStart) {
  const Setting setting = make_setting(
      "[parameters]\nc = 1\n[trace]\nparameter = \"c\"\nfrom = 0.1\nto = 1\n"
      "[gravity]\nacceleration = [0, 0, -9.81]\n[[point]]\nname = \"bob\"\nmass = 2\nposition = [0.3, 0.1, "
      "-0.8]\n"
      "[[spring]]\nfrom = [0, 0, 0]\nto = \"bob\"\nstiffness = 30\nfree_length = 1\n"
      "[[drag]]\npoint = \"bob\"\ncoefficient = \"c\"\n"
      "[[guided_spring]]\npoint = \"bob\"\ndirection = [0, 1, 0]\nstiffness = 5\n");
  ASSERT_TRUE(setting.model->structure(0).fixed_equilibrium);
  const RecordedTrace recorded = completed_trace(setting);
  const double length = 1.0 + 2.0 * 9.81 / 30.0;  // hangs straight down
  for (const PathNode& node : recorded.nodes) {
    EXPECT_NEAR(node.path.x(2, 0), -length, 1e-12);
    const double damping = node.p / 4.0;
    EXPECT_NEAR(node.s(0, 0).imag(), std::sqrt(9.81 / length - damping * damping), 1e-9);
  }
  EXPECT_GT(recorded.result.counts.equilibrium_iterations, 0U);
}

TEST(Multibody, SensitivityToADerivedParameterIsRefused) {
  const Setting setting = scene_setting("rotating_mass", {},
                                        {{"[trace]", "half = \"drag / 2\"\n[trace]"},
                                         {"coefficient = \"drag\"", "coefficient = \"2 * half\""}});
  RunCounts counts;
  const PathPoint point = point_from_guess(setting.problem(), 100.0, counts);
  EXPECT_THROW((void)differentiate_point(setting.problem(), point, setting.parameter("half"), counts),
               std::invalid_argument);
}

TEST(Multibody, ValuesThatFailInsideTheRangeAreRefused) {
  // Positive at both ends, negative between 40 and 60 rad/s.
  EXPECT_THROW(
      scene_setting("rotating_mass", {}, {{"mass = \"mass\"", "mass = \"(omega - 40) * (omega - 60)\""}}),
      InputError);
}

TEST(Multibody, OrderBeyondTheHighestIsRefused) {
  const Setting setting = scene_setting("pendulum");
  EvaluationCounts counts = setting.model->new_counts();
  Linearization lin;
  const Path path{setting.scene.parameters.declared_values(), Vector::Zero(3), Vector::Zero(2)};
  EXPECT_THROW((void)setting.model->linearize(path, max_order + 1, lin, counts), std::invalid_argument);
}

}  // namespace
}  // namespace eigentrail::test::multibody_test
