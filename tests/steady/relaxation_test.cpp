// Equilibria from poor guesses. Those that KINSOL's line search does not find are found after relaxation.
#include "eigentrail/steady/relaxation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <sstream>

#include "support/scenes.hpp"

namespace eigentrail::test::relaxation_test {
namespace {

std::string triple(double a, double b, double c) {
  std::ostringstream text;
  text.precision(17);
  text << std::fixed << '[' << a << ", " << b << ", " << c << ']';
  return text.str();
}

/// A chain of masses from the origin, joined by rods or springs, some of them tied to the ground by another
/// spring, with a guess whose points lie anywhere within `spread` of straight down.
std::string hanging_chain(std::mt19937_64& engine, double spread) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto between = [&](double low, double high) { return low + (high - low) * unit(engine); };
  std::ostringstream text;
  text.precision(17);
  text << std::fixed
       << "[parameters]\ng = 9.81\n[trace]\nparameter = \"g\"\nfrom = 9.81\nto = 5.0\n"
          "[gravity]\nacceleration = [0, 0, \"-g\"]\n";
  const int masses = 1 + static_cast<int>(between(1.0, 5.0));
  for (int i = 0; i < masses; ++i) {
    const double scatter = spread;
    text << "[[point]]\nname = \"m" << i << "\"\nmass = " << between(0.3, 3.0) << "\nposition = "
         << triple(between(-scatter, scatter), between(-scatter, scatter),
                   -(i + 1.0) + between(-scatter, scatter))
         << "\n";
    const std::string from = i == 0 ? "[0, 0, 0]" : "\"m" + std::to_string(i - 1) + "\"";
    const std::string ends = "from = " + from + "\nto = \"m" + std::to_string(i) + "\"\n";
    if (unit(engine) < 0.6) {
      text << "[[rod]]\n" << ends << "length = " << between(0.5, 1.5) << "\n";
    } else {
      text << "[[spring]]\n"
           << ends << "stiffness = " << between(30.0, 1000.0) << "\nfree_length = " << between(0.4, 1.2)
           << "\n";
    }
    if (unit(engine) < 0.4) {
      text << "[[spring]]\nfrom = " << triple(between(-2.0, 2.0), between(-2.0, 2.0), between(-3.0, 1.0))
           << "\nto = \"m" << i << "\"\nstiffness = " << between(5.0, 100.0)
           << "\nfree_length = " << between(0.2, 1.5) << "\n";
    }
  }
  return text.str();
}

/// Largest violation of the steady equations, relative to the weight and to lengths.
double violation(const Setting& setting, const Equilibrium& found, EvaluationCounts& counts) {
  SteadyResidual residual;
  const Path path{setting.scene.parameters.declared_values(), found.x, found.lambda};
  if (setting.model->residual(path, 0, residual, counts)) return INFINITY;
  const double force = residual.force.col(0).lpNorm<Eigen::Infinity>() / 9.81;
  return residual.constraint.rows() == 0
             ? force
             : std::max(force, residual.constraint.col(0).lpNorm<Eigen::Infinity>());
}

class PoorGuesses : public testing::TestWithParam<double> {};

TEST_P(PoorGuesses, OfHangingChainsAllLeadToAnEquilibrium) {
  constexpr int scenes = 100;
  std::mt19937_64 engine(7);
  int without = 0;
  for (int i = 0; i < scenes; ++i) {
    const Setting setting = make_setting(hanging_chain(engine, GetParam()));
    EvaluationCounts counts = setting.model->new_counts();
    const Vector parameters = setting.scene.parameters.declared_values();
    const Vector guess = setting.model->initial_guess(parameters);
    SteadyOptions newton_alone;
    newton_alone.relax = false;
    without += solve_equilibrium(*setting.model, parameters, guess, Vector(), newton_alone, counts).status ==
               SteadyStatus::converged;
    const Equilibrium found = solve_equilibrium(*setting.model, parameters, guess, Vector(), {}, counts);
    ASSERT_EQ(found.status, SteadyStatus::converged) << "scene " << i << ": " << found.report.message;
    EXPECT_LT(violation(setting, found, counts), 1e-9) << "scene " << i;
  }
  RecordProperty("found_by_kinsol_alone_of_100", without);
  std::printf("spread %g: KINSOL alone finds %d of %d\n", GetParam(), without, scenes);
  EXPECT_LT(without, scenes);  // otherwise the scenes do not need relaxation
}

INSTANTIATE_TEST_SUITE_P(Spreads, PoorGuesses, testing::Values(0.5, 1.0, 2.0, 4.0));

/// From a guess close to the upright equilibrium, relaxation leads to the hanging one.
TEST(Relaxation, ComesToRestHanging) {
  const Setting setting = make_setting(R"(
parameters = { g = 9.81 }
trace = { parameter = "g", from = 9.81, to = 5.0 }
gravity = { acceleration = [0, 0, "-g"] }
point = [{ name = "bob", mass = 2.0, position = [0.3, 0.1, 2.5] }]
rod = [{ from = [0, 0, 0], to = "bob", length = 1.5 }]
)");
  EvaluationCounts counts = setting.model->new_counts();
  const Vector parameters = setting.scene.parameters.declared_values();
  Vector x = setting.model->initial_guess(parameters);
  Vector lambda;
  ASSERT_TRUE(relax(*setting.model, parameters, 1e-8, x, lambda, counts).at_rest);
  EXPECT_NEAR(x[2], -1.5, 1e-6);
  EXPECT_NEAR(x.head(2).norm(), 0.0, 1e-6);
  ASSERT_EQ(lambda.size(), 1);
  EXPECT_NEAR(lambda[0] * 2.0 * x[2], -2.0 * 9.81, 1e-5);  // A^T lambda = f
}

/// The blade of the paper turns so slowly that its weight-like forces bend it far from the guess.
TEST(Relaxation, SlowBladeIsFoundFromItsGuess) {
  for (const double omega : {5.0, 5.2, 5.5, 5.8, 6.0}) {
    const Setting setting = scene_setting("rotating_mass");
    const Equilibrium found = at_rest(setting, {{"omega", omega}});
    ASSERT_EQ(found.status, SteadyStatus::converged) << omega << ": " << found.report.message;
    EXPECT_LT(found.report.residual, 1e-12) << omega;
  }
}

/// Beyond its fold the pushed pendulum has no equilibrium and keeps rotating. Relaxation reports this.
TEST(Relaxation, WithoutAnEquilibriumDoesNotComeToRest) {
  const Setting setting = pushed_pendulum({.from = 1.2, .to = 1.3, .guess = 0.1});
  EvaluationCounts counts = setting.model->new_counts();
  const Vector parameters = setting.scene.parameters.declared_values();
  Vector x = setting.model->initial_guess(parameters);
  Vector lambda;
  EXPECT_FALSE(relax(*setting.model, parameters, 1e-8, x, lambda, counts).at_rest);
}

}  // namespace
}  // namespace eigentrail::test::relaxation_test
