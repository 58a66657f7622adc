// Frame indifference of beams: a rigid motion of a bent, twisted and stretched beam turns its forces, and
// nothing else.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "support/scenes.hpp"

namespace eigentrail::test::beam_test {
namespace {

/// A twisted beam without anything that holds it. Its coordinates are positions and directors, no others.
class FreeBeam : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    setting = make_setting(
        "[trace]\nparameter = \"p\"\nfrom = 0.5\nto = 1\n[parameters]\np = 0.7\n"
        "[[beam]]\nname = \"arm\"\nfrom = [0.1, 0, 0]\nto = [1, 0.3, 0.2]\nends = [\"free\", \"free\"]\n"
        "elements = 2\ndegree = " +
        std::to_string(GetParam()) +
        "\nspan = [0, 1]\nmass = 1\nEA = \"9*p\"\nEI_flap = 2\nEI_lag = 3\nGJ = 1.5\ntwist = [0.3, -0.2]\n"
        "shear_y = 0.1\n[[beam_damping]]\nbeam = \"arm\"\ntime = 0.2\n");
    counts = setting.model->new_counts();
    parameters = setting.scene.parameters.declared_values();
    guess = setting.model->initial_guess(parameters);
    deformed = guess;
    for (Eigen::Index i = 0; i < guess.size(); ++i)
      deformed[i] += 0.2 * std::sin(1.7 * static_cast<double>(i) + 0.4);
  }

  Vector force(const Vector& x) {
    SteadyResidual residual;
    const Vector lambda = Vector::Zero(setting.model->n_constraints());
    EXPECT_FALSE(setting.model->residual({parameters, x, lambda}, 0, residual, counts));
    return residual.force.col(0);
  }

  /// Every vector turned, and positions moved as well: origins are every fourth triple.
  static Vector turned(const Vector& x, const Eigen::Vector3d& by = Eigen::Vector3d::Zero()) {
    const Eigen::Matrix3d R =
        Eigen::AngleAxisd(2.1, Eigen::Vector3d(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
    Vector result = x;
    for (Eigen::Index i = 0; i < x.size() / 3; ++i) {
      result.segment<3>(3 * i) = R * x.segment<3>(3 * i);
      if (i % 4 == 0) result.segment<3>(3 * i) += by;
    }
    return result;
  }

  Setting setting;
  EvaluationCounts counts;
  Vector parameters, guess, deformed;
};

TEST_P(FreeBeam, HasNoForcesAsTheSceneGivesItWhereverItIsMoved) {
  EXPECT_LT(force(guess).norm(), 1e-13);
  EXPECT_LT(force(turned(guess, {3.0, -1.0, 2.0})).norm(), 1e-13);
}

TEST_P(FreeBeam, ForcesTurnWithItAndKeepTheirSize) {
  const Vector before = force(deformed);
  const Vector after = force(turned(deformed, {3.0, -1.0, 2.0}));
  ASSERT_GT(before.norm(), 1.0);
  EXPECT_LT((after - turned(before)).norm(), 1e-13 * before.norm());
}

/// The virtual work of its forces in a rigid motion vanishes: their sum and their moment are zero.
TEST_P(FreeBeam, ForcesAreInEquilibrium) {
  const Vector f = force(deformed);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 0; i < f.size() / 3; ++i) {
    if (i % 4 == 0) sum += f.segment<3>(3 * i);
    moment += Eigen::Vector3d(deformed.segment<3>(3 * i)).cross(Eigen::Vector3d(f.segment<3>(3 * i)));
  }
  EXPECT_LT(sum.norm(), 1e-13 * f.norm());
  EXPECT_LT(moment.norm(), 1e-13 * f.norm());
}

/// Velocities of a rigid motion, translation and rotation, meet no damping.
TEST_P(FreeBeam, DampingVanishesUnderRigidMotion) {
  Linearization lin;
  const Vector lambda = Vector::Zero(setting.model->n_constraints());
  ASSERT_FALSE(setting.model->linearize({parameters, deformed, lambda}, 0, lin, counts));
  const Matrix C = lin.C[0].dense();
  const Eigen::Vector3d v(0.3, 1.0, -0.4), w(1.0, 0.2, -0.7);
  Vector rate(deformed.size());
  for (Eigen::Index i = 0; i < rate.size() / 3; ++i) {
    rate.segment<3>(3 * i) = w.cross(Eigen::Vector3d(deformed.segment<3>(3 * i)));
    if (i % 4 == 0) rate.segment<3>(3 * i) += v;
  }
  ASSERT_GT(C.norm(), 0.1);
  EXPECT_LT((C * rate).norm(), 1e-13 * C.norm() * rate.norm());
}

INSTANTIATE_TEST_SUITE_P(Degree, FreeBeam, testing::Values(1, 2));

}  // namespace
}  // namespace eigentrail::test::beam_test
