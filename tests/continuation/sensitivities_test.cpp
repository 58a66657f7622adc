// Influence of each effect on each mode, compared with eigenvalues in closed form.
#include "eigentrail/continuation/sensitivities.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace eigentrail::test::sensitivities_test {
namespace {

/// A mass on springs in x and y, with a drag: s^2 m + r s + k = 0 in either direction.
constexpr double mass = 2.0;
constexpr double drag = 0.4;
constexpr double stiffness = 50.0;

TraceSetup mass_on_springs(double ratio) {
  const std::string text =
      "[parameters]\nk = 50\n[trace]\nparameter = \"k\"\nfrom = 50\nto = 60\n"
      "[gravity]\nacceleration = [0, 0, -9.81]\n"
      "[[point]]\nname = \"a\"\nmass = 2\nposition = [0, 0, 0]\n"
      "[[fixed]]\npoint = \"a\"\ncoordinate = \"z\"\n"
      "[[drag]]\npoint = \"a\"\ncoefficient = 0.4\n"
      "[[guided_spring]]\npoint = \"a\"\ndirection = [1, 0, 0]\nstiffness = \"k\"\n"
      "[[guided_spring]]\npoint = \"a\"\ndirection = [0, 1, 0]\nstiffness = \"" +
      std::to_string(ratio) + " * k\"\n";
  return prepare_trace(parse_scene(text, "test.toml"), {}, Purpose::strengths);
}

Complex eigenvalue(double k) {
  return {-0.5 * drag / mass, std::sqrt(k / mass - 0.25 * drag * drag / (mass * mass))};
}

const ComplexVector& of(const Influences& influences, const std::string& effect) {
  const auto found = std::find_if(influences.effects.begin(), influences.effects.end(),
                                  [&](const EffectInfluence& one) { return one.effect == effect; });
  if (found == influences.effects.end()) throw std::out_of_range("no influence of " + effect);
  return found->derivatives;
}

TEST(EffectInfluences, AreDerivativesWithRespectToTheStrengths) {
  const Influences influences = effect_influences(mass_on_springs(3.0));
  ASSERT_EQ(influences.fault, "");
  ASSERT_EQ(influences.s.size(), 2);
  for (Eigen::Index i = 0; i < 2; ++i) {
    const double k = i == 0 ? stiffness : 3.0 * stiffness;
    const Complex s = eigenvalue(k);
    EXPECT_LT(std::abs(influences.s[i] - s), 1e-12);
    const Complex slope = 2.0 * mass * s + drag;
    EXPECT_LT(std::abs(of(influences, "guided_spring")[i] + k / slope), 1e-11);
    EXPECT_LT(std::abs(of(influences, "drag")[i] + drag * s / slope), 1e-11);
  }
}

TEST(EffectInfluences, OfAForceThatConstraintsTakeIsNone) {
  const Influences influences = effect_influences(mass_on_springs(3.0));
  EXPECT_LT(of(influences, "gravity").norm(), 1e-12);
}

/// One spring along (0.6, 0.8) and one across it, of the same stiffness. The eigenvectors of the double
/// eigenvalue are not unique, so the influence of a single spring on it is not defined.
TEST(EffectInfluences, DoubleEigenvalueHasNone) {
  const std::string text =
      "[parameters]\nk = 50\n[trace]\nparameter = \"k\"\nfrom = 50\nto = 60\n"
      "[[point]]\nname = \"a\"\nmass = 2\nposition = [0, 0, 0]\n"
      "[[fixed]]\npoint = \"a\"\ncoordinate = \"z\"\n"
      "[[spring]]\nfrom = [-0.6, -0.8, 0]\nto = \"a\"\nstiffness = \"k\"\nfree_length = 1\n"
      "[[guided_spring]]\npoint = \"a\"\ndirection = [-0.8, 0.6, 0]\nstiffness = 50\n";
  const Influences influences =
      effect_influences(prepare_trace(parse_scene(text, "test.toml"), {}, Purpose::strengths));
  ASSERT_EQ(influences.fault, "");
  ASSERT_EQ(influences.s.size(), 2);
  ASSERT_LT(std::abs(influences.s[0] - influences.s[1]), 1e-12);
  for (Eigen::Index i = 0; i < 2; ++i) {
    EXPECT_TRUE(std::isnan(of(influences, "spring")[i].real())) << of(influences, "spring")[i];
    EXPECT_TRUE(std::isnan(of(influences, "guided_spring")[i].real())) << of(influences, "guided_spring")[i];
  }
}

TEST(EffectInfluences, AreOfAsManyModesAsAreFollowed) {
  TraceSetup setup = mass_on_springs(3.0);
  setup.options.modes.count = 1;
  const Influences influences = effect_influences(setup);
  EXPECT_EQ(influences.s.size(), 1);
  EXPECT_EQ(of(influences, "drag").size(), 1);
}

}  // namespace
}  // namespace eigentrail::test::sensitivities_test
