// Shares of kinetic energy compared with closed forms, and the names of modes derived from them.
#include "eigentrail/modes/energy_shares.hpp"

#include <gtest/gtest.h>

#include "support/scenes.hpp"

namespace eigentrail::test::energy_shares_test {
namespace {

/// Shares of all modes of a scene where its trace begins, by motion and mode.
struct SharedModes {
  std::vector<MassMotion> motions;
  Matrix shares;
  std::vector<std::string> names;

  double share(const std::string& mass, const std::string& kind, Eigen::Index mode) const {
    for (std::size_t i = 0; i < motions.size(); ++i) {
      if (motions[i].mass == mass && motions[i].kind == kind)
        return shares(static_cast<Eigen::Index>(i), mode);
    }
    ADD_FAILURE() << "no motion " << mass << ' ' << kind;
    return -1.0;
  }
};

SharedModes shared_modes(const std::string& scene) {
  const Setting setting = make_setting(scene);
  RunCounts counts;
  const PathPoint point = point_from_guess(setting.problem(), setting.options.from, counts);
  const SystemMatrix& M = point.equilibrium.linearization.M[0];
  const EnergyShares energy(setting.model->description(), M, point.equilibrium.x);
  ComplexMatrix shapes(point.equilibrium.x.size(), static_cast<Eigen::Index>(point.pairs.size()));
  for (std::size_t i = 0; i < point.pairs.size(); ++i)
    shapes.col(static_cast<Eigen::Index>(i)) = point.shapes(i).col(0);
  SharedModes result{energy.motions(), energy.of(M, point.equilibrium.x, shapes), {}};
  result.names = energy.names(result.shares);
  return result;
}

const std::string hanging_bar = R"(
parameters = { g = 9.81 }
trace = { parameter = "g", from = 5, to = 10 }
gravity = { acceleration = [0, 0, "-g"] }
revolute = [{ from = [0, 0, 0], to = "bar", axis = [0, 1, 0] }]
[[body]]
name = "bar"
mass = 3
centre = [0.7, 0, 0]
inertia = [0, "3*1.4^2/12", "3*1.4^2/12"]
position = [0, 0, 0]
x_axis = [0, 0, -1]
y_axis = [0, 1, 0]
)";

TEST(EnergyShares, OfAHangingBarAreThreeQuartersTranslation) {
  const SharedModes modes = shared_modes(hanging_bar);
  EXPECT_NEAR(modes.share("bar", "along x", 0), 0.75, 1e-12);
  EXPECT_NEAR(modes.share("bar", "about y", 0), 0.25, 1e-12);
  EXPECT_NEAR(modes.shares.col(0).sum(), 1.0, 1e-12);
  EXPECT_EQ(modes.names[0], "along x");
}

const std::string blade = R"(
parameters = { omega = 20 }
trace = { parameter = "omega", from = 20, to = 30 }
frame = { angular_velocity = [0, 0, "omega"] }
revolute = [
  { name = "flap", from = [0, 0.3, 0], to = "cuff", axis = [1, 0, 0] },
  { name = "lag", from = "cuff", to = "yoke", axis = [0, 0, 1] },
  { name = "pitch", from = "yoke", to = "blade", axis = [0, 1, 0] },
]
torsional_spring = [{ joint = "pitch", stiffness = 1000 }]
[[body]]
name = "cuff"
mass = 0
position = [0, 0.3, 0]
[[body]]
name = "yoke"
mass = 0
position = [0, 0.3, 0]
[[body]]
name = "blade"
mass = 12
centre = [0, 2, 0]
inertia = [16, 0.02, 16]
position = [0, 0.3, 0]
)";

TEST(EnergyShares, OfABladeAreLagFlapAndTorsion) {
  const SharedModes modes = shared_modes(blade);
  ASSERT_EQ(modes.shares.cols(), 3);
  EXPECT_NEAR(modes.share("blade", "lag", 0), 1.0, 1e-9);
  EXPECT_NEAR(modes.share("blade", "flap", 1), 1.0, 1e-5);
  // The propeller moment couples pitch and flap a little: frequencies that differ, not shapes at rest.
  EXPECT_NEAR(modes.share("blade", "torsion", 2), 1.0, 1e-5);
  EXPECT_EQ(modes.names, (std::vector<std::string>{"blade lag", "blade flap", "blade torsion"}));
}

TEST(EnergyShares, EqualNamesAreNumbered) {
  const SharedModes modes = shared_modes(R"(
parameters = { k = 4 }
trace = { parameter = "k", from = 4, to = 5 }
point = [
  { name = "a", mass = 1, position = [0, 0, 0] },
  { name = "b", mass = 1, position = [1, 0, 0] },
]
fixed = [
  { point = "a", coordinate = "y" },
  { point = "b", coordinate = "y" },
  { point = "a", coordinate = "z" },
  { point = "b", coordinate = "z" },
]
guided_spring = [
  { point = "a", direction = [1, 0, 0], stiffness = "k" },
  { point = "b", direction = [1, 0, 0], stiffness = "k", reference = 1 },
]
spring = [{ from = "a", to = "b", stiffness = 3, free_length = 1 }]
)");
  EXPECT_EQ(modes.names, (std::vector<std::string>{"along x 1", "along x 2"}));
  EXPECT_NEAR(modes.share("a", "along x", 0), 0.5, 1e-12);
  EXPECT_NEAR(modes.share("b", "along x", 1), 0.5, 1e-12);
}

TEST(EnergyShares, MotionInTwoDirectionsIsNamedByBoth) {
  const Setting setting = make_setting(hanging_bar);
  RunCounts counts;
  const PathPoint point = point_from_guess(setting.problem(), setting.options.from, counts);
  const EnergyShares energy(setting.model->description(), point.equilibrium.linearization.M[0],
                            point.equilibrium.x);
  Matrix shares = Matrix::Zero(6, 2);
  shares.col(0) << 0.5, 0.5, 0.0, 0.0, 0.0, 0.0;
  shares.col(1) << 0.0, 0.4, 0.0, 0.6, 0.0, 0.0;
  EXPECT_EQ(energy.names(shares), (std::vector<std::string>{"along x and y", "about x, along y"}));
}

}  // namespace
}  // namespace eigentrail::test::energy_shares_test
