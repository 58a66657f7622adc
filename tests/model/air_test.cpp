// Strips in moving air against closed forms and other elements, turned as a whole, and what their tables
// refuse.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "eigentrail/core/errors.hpp"
#include "scene/input_error.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::air_test {
namespace {

constexpr double density = 1.2, chord = 0.4, span = 2.0;

std::string with_wing(const std::string& tables) {
  return "[parameters]\np = 1\n[trace]\nparameter = \"p\"\nfrom = 1\nto = 2\n"
         "[[body]]\nname = \"wing\"\nmass = \"p\"\ninertia = [1, 1, 1]\nposition = [0.3, 0.2, 0.1]\n" +
         tables;
}

/// Strips from x = 0 to 2 on the wing, y forward, in a wind.
std::string strips(const std::string& more = "") {
  return "[[strips]]\nname = \"air\"\non = \"wing\"\nroot = [0, 0, 0]\ntip = [2, 0, 0]\nchord = 0.4\ndensity "
         "= "
         "1.2\nwind = [1, -9, 2]\n" +
         more;
}

struct System {
  explicit System(const std::string& text) : setting(make_setting(text)) {
    counts = setting.model->new_counts();
    parameters = setting.scene.parameters.declared_values();
    x = setting.model->initial_guess(parameters);
  }
  Path path() const { return {parameters, x, Vector::Zero(setting.model->n_constraints())}; }
  Vector force() {
    SteadyResidual residual;
    EXPECT_FALSE(setting.model->residual(path(), 0, residual, counts));
    return -residual.force.col(0);
  }
  Linearization linear() {
    Linearization lin;
    EXPECT_FALSE(setting.model->linearize(path(), 0, lin, counts));
    return lin;
  }

  Setting setting;
  EvaluationCounts counts;
  Vector parameters, x;
};

TEST(Strips, ThatDoNotPitchHaveTheForcesOfABladeElement) {
  System air(with_wing(strips("drag = 0.02\nlift_slope = 5.5\nincidence = 0.1\nstrips = 4\n")));
  System blade(
      with_wing("[[blade_element]]\nbody = \"wing\"\nroot = [0, 0, 0]\ntip = [2, 0, 0]\nleading = [0, 1, "
                "0]\nlift = [0, 0, 1]\nchord = 0.4\ndensity = 1.2\ninflow = [1, -9, 2]\nprofile_drag = "
                "0.02\nlift_slope = 5.5\npitch = 0.1\n"));
  ASSERT_GT(blade.force().norm(), 1.0);
  EXPECT_LT((air.force() - blade.force()).norm(), 1e-13 * blade.force().norm());
  const Matrix K = blade.linear().K[0].dense();
  EXPECT_LT((air.linear().K[0].dense() - K).norm(), 1e-13 * K.norm());
}

TEST(Strips, HaveLiftAboveTheAngleWithoutLiftAndAMoment) {
  System air(with_wing(strips("zero_lift_angle = -0.05\nmoment = -0.03\n")));
  const double V = std::hypot(9.0, 2.0), alpha = std::atan2(2.0, 9.0);
  const double pressure = 0.5 * density * V * V * chord * span;
  const Vector f = air.force();
  const double lift = pressure * 2.0 * std::numbers::pi * std::sin(alpha + 0.05);
  EXPECT_NEAR(f[1], lift * std::sin(alpha), 1e-12 * lift);
  EXPECT_NEAR(f[2], lift * std::cos(alpha), 1e-12 * lift);
  EXPECT_NEAR(f[8], -0.03 * chord * pressure, 1e-12 * lift);  // on the y axis, along z
}

TEST(Strips, CoverTheirExtentWithChordsOfTheirStations) {
  System whole(with_wing(strips("extent = [0.25, 0.75]\n")));
  System tapered(
      with_wing("[[strips]]\non = \"wing\"\nroot = [0, 0, 0]\ntip = [2, 0, 0]\nspan = [0, 5, 10]\nchord = "
                "[0.4, 0.8, 0.1]\ndensity = 1.2\nwind = [1, -9, 2]\nextent = [0.5, 1]\nstrips = 2\n"));
  const Vector all = System(with_wing(strips())).force();
  EXPECT_LT((whole.force() - 0.5 * all).head(3).norm(), 1e-13 * all.norm());
  // The outer half, of mean chord 0.45.
  EXPECT_LT((tapered.force() - 0.45 / 0.4 * 0.5 * all).head(3).norm(), 1e-13 * all.norm());
}

TEST(ApparentMass, IsThatOfACylinderOfAirAroundTheChord) {
  System air(with_wing(strips("quarter_chord_y = 0.03\nstrips = 3\n[[apparent_mass]]\n")));
  const double b = 0.5 * chord, mass = std::numbers::pi * density * b * b;
  const double y = 0.03 - b / 2.0;  // of mid-chord
  const Matrix M = air.linear().M[0].dense() - System(with_wing(strips())).linear().M[0].dense();
  // z of the origin, and of the x and y axes
  const std::array<int, 3> z = {2, 5, 8};
  Eigen::Matrix3d expected;
  expected << span, span * span / 2.0, span * y,  //
      span * span / 2.0, std::pow(span, 3) / 3.0, span * span / 2.0 * y, span * y, span * span / 2.0 * y,
      span * (y * y + b * b / 8.0);
  double rest = M.squaredNorm();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double found = M(z[static_cast<std::size_t>(i)], z[static_cast<std::size_t>(j)]);
      EXPECT_NEAR(found, mass * expected(i, j), 1e-14) << i << j;
      rest -= found * found;
    }
  }
  EXPECT_NEAR(rest, 0.0, 1e-14);
}

/// A coned blade moves on a cone: its sections pitch and its air does not accelerate, so only the moment of
/// the part at three quarters of the chord is left, half a chord from that at mid-chord.
TEST(ApparentMass, OfAConedBladeInSteadyRotationHasNoForce) {
  const std::string rotor =
      "[parameters]\np = 3\n[trace]\nparameter = \"p\"\nfrom = 1\nto = 5\n[frame]\nangular_velocity = [0, 0, "
      "\"p\"]\n[[body]]\nname = \"wing\"\nmass = 1\ninertia = [1, 1, 1]\nposition = [0, 0, 0]\neuler = { "
      "sequence = "
      "\"yzx\", angles = [-0.2, 0, 0] }\n[[strips]]\non = \"wing\"\nroot = [0.5, 0, 0]\ntip = [2.5, 0, 0]\n"
      "quarter_chord_y = 0.1\nchord = 0.4\ndensity = 1.2\n";
  const Vector f = System(rotor + "[[apparent_mass]]\n").force() - System(rotor).force();
  const double b = 0.5 * chord, mass = std::numbers::pi * density * b * b;
  EXPECT_LT(f.head(3).norm(), 1e-14);
  // Mean of the speed, 3 * 1.5 cos 0.2, times the rate of pitch, 3 sin 0.2.
  const double moment = -0.5 * b * 2.0 * mass * span * 3.0 * 1.5 * std::cos(0.2) * 3.0 * std::sin(0.2) / 2.0;
  EXPECT_NEAR(f.segment<3>(6).norm(), std::abs(moment), 1e-13);
}

TEST(LiftLag, HasNoForceInSteadyFlow) {
  System lag(with_wing(strips("[[lift_lag]]\n")));
  const Vector quasi_steady = System(with_wing(strips())).force();
  const Vector f = lag.force();
  EXPECT_LT((f.head(12) - quasi_steady).norm(), 1e-13 * quasi_steady.norm());
  EXPECT_LT(f.tail(f.size() - 12).norm(), 1e-13);
  EXPECT_EQ(lag.x.size(), 12 + 8);
  EXPECT_EQ(lag.setting.model->description().coordinate_names[12], "air, strip 1.slow");
}

/// Four exponentials of which two pairs are alike are two with the sums of their shares: the forces of pairs
/// add up.
TEST(LiftLag, OfFourExponentialsIsThatOfTwoPairs) {
  System two(with_wing(strips("[[lift_lag]]\nA = [0.2, 0.3]\nb = [0.05, 0.4]\n")));
  System four(with_wing(strips("[[lift_lag]]\nA = [0.15, 0.1, 0.05, 0.2]\nb = [0.05, 0.4, 0.05, 0.4]\n")));
  ASSERT_EQ(four.x.size(), 12 + 16);
  EXPECT_EQ(four.setting.model->description().coordinate_names[14], "air, strip 1, more.slow");
  two.x[12] += 0.4;  // out of balance by what the two states of the same rate share
  four.x[12] += 0.1;
  four.x[14] += 0.3;
  const Vector f = two.force().head(12);
  EXPECT_LT((four.force().head(12) - f).norm(), 1e-13 * f.norm());
}

/// A free beam with strips, turned with the wind.
Vector force_of_turned(const Eigen::Matrix3d& R) {
  const Eigen::Vector3d wind = R * Eigen::Vector3d(0.5, -9.0, 1.0);
  const Eigen::Vector3d y = R * Eigen::Vector3d::UnitY(), tip = R * Eigen::Vector3d(1.0, 0.0, 0.0);
  const auto text = [](const Eigen::Vector3d& v) {
    std::string list = "[";
    for (const double e : v) list += (list.size() > 1 ? ", " : "") + std::to_string(e);
    return list + "]";
  };
  System beam(
      "[parameters]\np = 1\n[trace]\nparameter = \"p\"\nfrom = 1\nto = 2\n[[beam]]\nname = \"arm\"\nfrom = "
      "[0, 0, 0]\nto = " +
      text(tip) + "\ny_axis = " + text(y) +
      "\nelements = 2\nends = [\"free\", \"free\"]\nmass = \"p\"\nEA = 9\nEI_flap = 2\nEI_lag = 3\nGJ = 1\n"
      "[[strips]]\non = \"arm\"\nchord = 0.3\nquarter_chord_y = 0.1\nincidence = 0.1\ndrag = 0.02\nwind = " +
      text(wind) + "\n[[lift_lag]]\n[[apparent_mass]]\n");
  const Eigen::Index n = 3 * ((beam.x.size() - 8) / 3);
  for (Eigen::Index i = 0; i < n / 3; ++i)
    beam.x.segment<3>(3 * i) +=
        R * Eigen::Vector3d(0.1 * std::sin(1.7 * i), 0.1 * std::cos(2.3 * i), 0.1 * std::sin(0.9 * i + 1.0));
  Vector f = beam.force();
  for (Eigen::Index i = 0; i < n / 3; ++i) f.segment<3>(3 * i) = R.transpose() * f.segment<3>(3 * i);
  return f;
}

TEST(Strips, ForcesTurnWithBeamAndWind) {
  const Vector before = force_of_turned(Eigen::Matrix3d::Identity());
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(2.1, Eigen::Vector3d(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
  ASSERT_GT(before.norm(), 1.0);
  EXPECT_LT((force_of_turned(R) - before).norm(), 1e-5 * before.norm());  // six digits in the scene
}

struct RefusedAir {
  std::string name, tables, message;
};

class RefusedStrips : public testing::TestWithParam<RefusedAir> {};

TEST_P(RefusedStrips, SaysWhat) {
  const std::string message = input_error([] { (void)make_setting(with_wing(GetParam().tables)); });
  EXPECT_TRUE(contains(message, GetParam().message)) << message;
}

const std::string line = "root = [0, 0, 0]\ntip = [1, 0, 0]\n";

INSTANTIATE_TEST_SUITE_P(
    Tables, RefusedStrips,
    testing::Values(
        RefusedAir{"nothing_of_that_name", "[[strips]]\non = \"wings\"\nchord = 1\n",
                   "on: no beam, blade or body is called 'wings'; did you mean 'wing'?"},
        RefusedAir{"no_line", "[[strips]]\non = \"wing\"\nchord = 1\n", "root: is missing"},
        RefusedAir{"no_length", "[[strips]]\non = \"wing\"\nroot = [1, 0, 0]\ntip = [1, 0, 0]\nchord = 1\n",
                   "tip: must not be the zero vector"},
        RefusedAir{"lift_forward", "[[strips]]\non = \"wing\"\n" + line + "lift = [0, 2, 0]\nchord = 1\n",
                   "lift: must not be parallel to leading"},
        RefusedAir{"no_chord", "[[strips]]\non = \"wing\"\n" + line, "chord"},
        RefusedAir{"zero_chord", "[[strips]]\non = \"wing\"\n" + line + "chord = \"p - 1\"\n",
                   "chord: must be positive"},
        RefusedAir{"extent_reversed",
                   "[[strips]]\non = \"wing\"\n" + line + "chord = 1\nextent = [0.5, 0.2]\n",
                   "extent: expected two numbers from 0 to 1, the second one larger"},
        RefusedAir{"extent_of_one", "[[strips]]\non = \"wing\"\n" + line + "chord = 1\nextent = 0.5\n",
                   "extent: expected two numbers"},
        RefusedAir{"extent_that_moves",
                   "[[strips]]\non = \"wing\"\n" + line + "chord = 1\nextent = [0, \"p/2\"]\n",
                   "found an expression of parameters"},
        RefusedAir{"half_a_strip", "[[strips]]\non = \"wing\"\n" + line + "chord = 1\nstrips = 0.5\n",
                   "strips: expected a whole number from 1 to 64"},
        RefusedAir{"list_without_stations", "[[strips]]\non = \"wing\"\n" + line + "chord = [1, 2]\n",
                   "give span as well"},
        RefusedAir{"wind_across_the_axis", "[frame]\nangular_velocity = [0, 0, 1]\n" + strips(),
                   "wind: must be parallel to [frame] angular_velocity"},
        RefusedAir{"a_name_twice", strips() + strips(), "another [[strips]] is called 'air' already"},
        RefusedAir{"lag_without_strips", "[[lift_lag]]\n", "strips: the scene has no [[strips]]"},
        RefusedAir{"lag_of_others", strips() + "[[lift_lag]]\nstrips = \"water\"\n",
                   "no [[strips]] is called 'water'"},
        RefusedAir{"lag_twice", strips() + "[[lift_lag]]\n[[lift_lag]]\nstrips = \"air\"\n",
                   "'air' has a [[lift_lag]] already"},
        RefusedAir{"three_exponentials", strips() + "[[lift_lag]]\nA = [0.1, 0.2, 0.3]\n",
                   "A: expected two or four numbers, found 3"},
        RefusedAir{"shares_without_rates", strips() + "[[lift_lag]]\nA = [0.1, 0.2, 0.1, 0.1]\n",
                   "b: expected as many numbers as A has"},
        RefusedAir{"a_rate_of_zero", strips() + "[[lift_lag]]\nb = [0.1, 0]\n", "b: must be positive"},
        RefusedAir{"mass_of_others", strips() + "[[apparent_mass]]\nstrips = \"water\"\n",
                   "no [[strips]] is called 'water'"}),
    [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace eigentrail::test::air_test
