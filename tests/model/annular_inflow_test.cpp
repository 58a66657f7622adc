// Annular momentum theory in hover and climb: [[inflow]] model = "annular".
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/steady/equilibrium.hpp"
#include "scene/input_error.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::annular_inflow_test {
namespace {

constexpr double radius = 5.0, chord = 0.3, slope = 5.7, speed = 40.0, density = 1.225;
constexpr int blades = 3, strips = 6;
constexpr double solidity = blades * chord / (std::numbers::pi * radius);

/// A rigid blade from 1 m to the tip.
std::string rotor(const std::string& inflow, const std::string& of_strips, const std::string& rest = "") {
  return R"(
[parameters]
omega = { value = 40, unit = "rad/s" }
pitch = { value = 0.1, unit = "rad" }
climb = { value = 0, unit = "m/s" }
thrust = { value = 3000, unit = "N" }
twist = { value = 1e-5, unit = "rad" }
[trace]
parameter = "omega"
from = 40
to = 30
tolerance = 1e-8
[frame]
angular_velocity = [0, 0, "omega"]
[[body]]
name = "blade"
mass = 10
inertia = [1, 1, 1]
position = [0, 0, 0]
[[weld]]
from = [0, 0, 0]
to = "blade"
[[inflow]]
name = "disc"
model = "annular"
radius = 5
blades = 3
wind = [0, 0, "-climb"]
)" + inflow +
         of_strips + rest;
}

std::string strips_on(double from, double to, const std::string& incidence, int count) {
  return "\n[[strips]]\non = \"blade\"\nroot = [" + std::to_string(from) + ", 0, 0]\ntip = [" +
         std::to_string(to) + ", 0, 0]\nincidence = \"" + incidence +
         "\"\nchord = 0.3\nlift_slope = 5.7\nwind = [0, 0, \"-climb\"]\ninflow = \"disc\"\nstrips = " +
         std::to_string(count) + "\n";
}

/// Inflow of all annuli, m/s.
std::vector<double> inflow_of(const Setting& setting, const Equilibrium& at) {
  std::vector<double> v;
  const auto& names = setting.model->description().coordinate_names;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i].ends_with(".mean")) v.push_back(at.x[static_cast<Eigen::Index>(i)]);
  }
  return v;
}

/// Radii of the Gauss points of six strips from 1 m to 5 m.
std::vector<double> radii() {
  std::vector<double> r;
  for (const double x : {-0.932469514203152, -0.661209386466265, -0.238619186083197, 0.238619186083197,
                         0.661209386466265, 0.932469514203152})
    r.push_back(3.0 + 2.0 * x);
  return r;
}

/// 4 lambda (lambda + mu) = sigma a / 2 (x sin - (lambda + mu) cos): lambda of small pitch in hover is
/// sigma a / 16 (sqrt(1 + 32 pitch x / (sigma a)) - 1).
double ratio(double r, double pitch, double climb) {
  const double mu = climb / (speed * radius), x = r / radius;
  const double b = mu + solidity * slope * std::cos(pitch) / 8.0;
  const double c = solidity * slope / 8.0 * (x * std::sin(pitch) - mu * std::cos(pitch));
  return 0.5 * (std::sqrt(b * b + 4.0 * c) - b);
}

TEST(AnnularInflow, HasTheClosedFormInHoverAndClimb) {
  const Setting setting = make_setting(rotor("", strips_on(1.0, radius, "pitch", strips)));
  const std::vector<double> r = radii();
  for (const double climb : {0.0, 2.0, 5.0}) {
    const Equilibrium found = at_rest(setting, {{"climb", climb}});
    ASSERT_EQ(found.status, SteadyStatus::converged) << found.report.message;
    const std::vector<double> v = inflow_of(setting, found);
    ASSERT_EQ(v.size(), r.size());
    for (std::size_t i = 0; i < v.size(); ++i)
      EXPECT_NEAR(v[i] / (speed * radius), ratio(r[i], 0.1, climb), 1e-12) << "radius " << r[i];
  }
}

/// Ideal twist, pitch proportional to 1/r, has uniform inflow; constant pitch has not.
TEST(AnnularInflow, IsUniformForIdealTwist) {
  std::string ideal, constant;
  for (int i = 0; i < 4; ++i) {
    const double from = 1.0 + i, middle = from + 0.5;
    ideal += strips_on(from, from + 1.0, "twist * 5 / " + std::to_string(middle), 1);
    constant += strips_on(from, from + 1.0, "twist", 1);
  }
  const auto spread = [](const std::string& of_strips) {
    const Setting setting = make_setting(rotor("", of_strips));
    const Equilibrium found = at_rest(setting);
    EXPECT_EQ(found.status, SteadyStatus::converged) << found.report.message;
    const std::vector<double> v = inflow_of(setting, found);
    const auto [least, most] = std::minmax_element(v.begin(), v.end());
    return *most / *least - 1.0;
  };
  // The remainder is of the second order in the pitch, 5e-5 at the innermost strip.
  EXPECT_LT(spread(ideal), 1e-8);
  EXPECT_GT(spread(constant), 0.5);
}

/// Prandtl's factor from its definition: the thrust of each annulus on both sides.
TEST(AnnularInflow, TipLossMeetsTheEquationOfMomentum) {
  const Setting setting = make_setting(rotor("tip_loss = true\n", strips_on(1.0, radius, "pitch", strips)));
  const Equilibrium found = at_rest(setting);
  ASSERT_EQ(found.status, SteadyStatus::converged) << found.report.message;
  const std::vector<double> r = radii(), v = inflow_of(setting, found);
  for (std::size_t i = 0; i < v.size(); ++i) {
    const double tangent = v[i] / (speed * r[i]), sine = tangent / std::hypot(1.0, tangent);
    const double factor =
        2.0 / std::numbers::pi * std::acos(std::exp(-0.5 * blades * (radius - r[i]) / (r[i] * sine)));
    const double momentum = 4.0 * std::numbers::pi * density * r[i] * v[i] * v[i] * factor;
    const double downwash = speed * r[i] * std::sin(0.1) - v[i] * std::cos(0.1);
    const double blade = blades * 0.5 * density * chord * slope * downwash * speed * r[i];
    EXPECT_NEAR(momentum, blade, 1e-10 * blade);
    EXPECT_GT(v[i] / (speed * radius), ratio(r[i], 0.1, 0.0));
  }
}

/// Thrust of all annuli is what strips give; the collective pitch follows the speed of the rotor.
TEST(AnnularInflow, CollectiveIsTrimmedToTheThrust) {
  const std::string trim = "\n[[trim]]\nunknown = \"pitch\"\ncondition = \"thrust(disc) = thrust\"\n";
  const Setting setting = make_setting(rotor("", strips_on(1.0, radius, "pitch", strips), trim));
  const Equilibrium found = at_rest(setting);
  ASSERT_EQ(found.status, SteadyStatus::converged) << found.report.message;
  const double pitch = found.lambda[setting.model->n_constraints()];
  constexpr std::array<double, 6> weights = {0.171324492379170, 0.360761573048139, 0.467913934572691,
                                             0.467913934572691, 0.360761573048139, 0.171324492379170};
  double thrust = 0.0;
  const std::vector<double> r = radii();
  for (std::size_t i = 0; i < r.size(); ++i) {
    const double v = speed * radius * ratio(r[i], pitch, 0.0);
    thrust += 2.0 * weights[i] * 4.0 * std::numbers::pi * density * r[i] * v * v;
  }
  EXPECT_NEAR(thrust, 3000.0, 1e-8);
}

TEST(AnnularInflow, MistakesAreNamed) {
  const auto message = [](const std::string& text) { return input_error([&] { (void)make_setting(text); }); };
  std::string uniform = rotor("tip_loss = true\n", strips_on(1.0, radius, "pitch", strips));
  uniform.replace(uniform.find("annular"), 7, "uniform");
  EXPECT_NE(message(uniform).find("needs model = \"annular\""), std::string::npos) << message(uniform);
  const std::string long_blade = rotor("", strips_on(1.0, 6.0, "pitch", 4));
  EXPECT_NE(message(long_blade).find("outside the radius of 'disc'"), std::string::npos)
      << message(long_blade);
  std::string other = strips_on(1.0, radius, "pitch", 2);
  other.replace(other.find("\"blade\""), 7, "\"other\"");
  const std::string two =
      rotor("", strips_on(1.0, radius, "pitch", 2) + other,
            "[[body]]\nname = \"other\"\nmass = 1\ninertia = [1, 1, 1]\nposition = [0, 0, 0]\n");
  EXPECT_NE(message(two).find("has the strips of one blade"), std::string::npos) << message(two);
}

}  // namespace
}  // namespace eigentrail::test::annular_inflow_test
