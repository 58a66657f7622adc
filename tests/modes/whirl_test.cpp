// Whirl and names of modes of rotors, from shapes that are given.
#include "eigentrail/modes/whirl.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "eigentrail/modes/rotor_names.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::whirl_test {
namespace {

const Complex j(0.0, 1.0);

/// A shaft of ten elements with the freedoms x, y, rx, ry of eleven nodes; the second one is shorter.
Setting rotor(const std::string& speed = "p", const std::string& second = "") {
  return make_setting(
      "[trace]\nparameter = \"p\"\nfrom = 0\nto = 1\n[parameters]\np = 1\n[[shaft]]\nname = \"main\"\n"
      "stations = { length = 1, outer = 0.1 }\nelements = 10\nE = 2e11\nnu = 0.3\ndensity = 7800\nspeed = "
      "\"" +
      speed + "\"\n" + second);
}

/// The shape with displacements x and y of the nodes at places 0 to 1.
template <class X, class Y>
ComplexVector shape_of(const Model& model, X&& x, Y&& y) {
  ComplexVector shape = ComplexVector::Zero(model.n_coordinates());
  const SpinningShaft& shaft = model.description().shafts.front();
  for (std::size_t i = 0; i < shaft.places.size(); ++i) {
    shape[shaft.nodes[i][0]] = x(shaft.places[i]);
    shape[shaft.nodes[i][1]] = y(shaft.places[i]);
  }
  return shape;
}

Vector one(double p = 1.0) {
  return Vector::Constant(1, p);
}

/// x = cos(wt), y = b sin(wt): an ellipse with the semi-axes 1 and b, forward where b > 0.
ComplexVector ellipse(const Model& model, double b) {
  return shape_of(
      model, [](double) { return Complex(1.0); }, [b](double) { return -j * b; });
}

TEST(Whirl, IsTheRatioOfTheSemiAxes) {
  const Setting setting = rotor();
  for (const double b : {1.0, 0.3, 0.0, -0.2, -1.0})
    EXPECT_NEAR(whirl_of(*setting.model, one(), ellipse(*setting.model, b)).measure, b, 1e-15);
  EXPECT_EQ(whirl_in_words(whirl_of(*setting.model, one(), ellipse(*setting.model, 0.3))), "forward");
  EXPECT_EQ(whirl_in_words(whirl_of(*setting.model, one(), ellipse(*setting.model, -0.2))), "backward");
  EXPECT_EQ(whirl_in_words(whirl_of(*setting.model, one(), ellipse(*setting.model, 0.01))), "");
}

TEST(Whirl, DoesNotDependOnPhaseSizeOrDirectionOfTheEllipse) {
  const Setting setting = rotor();
  const double c = std::cos(0.7), s = std::sin(0.7);
  const ComplexVector turned = shape_of(
      *setting.model, [&](double) { return c + j * s * 0.4; }, [&](double) { return s - j * c * 0.4; });
  EXPECT_NEAR(whirl_of(*setting.model, one(), 3.0 * std::exp(0.9 * j) * turned).measure, 0.4, 1e-14);
}

TEST(Whirl, IsRelativeToTheSenseOfTheSpinAndUnknownAtRest) {
  const Setting setting = rotor("-p");
  EXPECT_NEAR(whirl_of(*setting.model, one(), ellipse(*setting.model, 1.0)).measure, -1.0, 1e-15);
  EXPECT_TRUE(std::isnan(whirl_of(*setting.model, one(0.0), ellipse(*setting.model, 1.0)).measure));
}

TEST(Whirl, IsMixedWhereNodesGoRoundEitherWay) {
  const Setting setting = rotor();
  const ComplexVector shape = shape_of(
      *setting.model, [](double) { return Complex(1.0); }, [](double z) { return -j * (z - 0.4); });
  const Whirl whirl = whirl_of(*setting.model, one(), shape);
  EXPECT_GT(whirl.reverse, 0.05);
  EXPECT_EQ(whirl_in_words(whirl), "mixed");
}

TEST(RotorNames, TellStraightFromBentShafts) {
  const Setting setting = rotor();
  const auto motion = [&](auto f) {
    const ComplexVector shape = shape_of(*setting.model, f, [&](double z) { return -j * f(z); });
    return rotor_mode(*setting.model, one(), j, shape).motion;
  };
  EXPECT_EQ(motion([](double) { return Complex(2.0); }), ShaftMotion::cylindrical);
  EXPECT_EQ(motion([](double z) { return Complex(1.0 + z); }), ShaftMotion::cylindrical);
  EXPECT_EQ(motion([](double z) { return Complex(z - 0.3); }), ShaftMotion::conical);
  EXPECT_EQ(motion([](double z) { return Complex(std::sin(std::numbers::pi * z)); }), ShaftMotion::bending);
  EXPECT_EQ(motion([](double z) { return Complex(std::sin(2.0 * std::numbers::pi * z)); }),
            ShaftMotion::bending);
}

TEST(RotorNames, AreNumberedBySenseInTheOrderOfFrequencies) {
  const auto mode = [](int sense, double frequency, ShaftMotion motion = ShaftMotion::bending) {
    return RotorMode{.motion = motion, .sense = sense, .frequency = frequency};
  };
  RotorMode slow = mode(0, 5.0);
  slow.oscillates = false;
  RotorMode planar = mode(0, 70.0);
  planar.axis = 2;
  const std::vector<RotorMode> modes{
      mode(1, 20.0), mode(-1, 10.0), mode(1, 12.0), mode(-1, 50.0, ShaftMotion::conical),
      slow,          planar,         mode(2, 80.0)};
  EXPECT_EQ(rotor_mode_names(modes, {SpinningShaft{}}),
            (std::vector<std::string>{"2nd forward bending", "1st backward bending", "1st forward bending",
                                      "backward conical", "1st overdamped bending", "1st bending along y",
                                      "1st mixed bending"}));
}

TEST(RotorNames, NameTheShaftThatMovesMost) {
  const Setting setting =
      rotor("p",
            "[[shaft]]\nname = \"sleeve\"\nstations = { length = 1, outer = 0.2 }\nE = 2e11\n"
            "nu = 0.3\ndensity = 7800\n");
  ComplexVector shape = ComplexVector::Zero(setting.model->n_coordinates());
  for (const auto& [x, y] : setting.model->description().shafts[1].nodes) {
    shape[x] = 1.0;
    shape[y] = -j;
  }
  const RotorMode mode = rotor_mode(*setting.model, one(), j, shape);
  EXPECT_EQ(rotor_mode_names({mode}, setting.model->description().shafts),
            std::vector<std::string>{"forward cylindrical, sleeve"});
}

}  // namespace
}  // namespace eigentrail::test::whirl_test
