#include "eigentrail/scene/expression_dimension.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "eigentrail/scene/scene.hpp"
#include "scene/input_error.hpp"

namespace eigentrail::test::expression_dimension_test {
namespace {

using test::contains;
using test::input_error;
using Kind = ExpressionDimension::Kind;

constexpr const char* parameters =
    "[parameters]\n"
    "m = { value = 2, unit = \"kg\" }\n"
    "l = { value = 300, unit = \"mm\" }\n"
    "F = { value = 2, unit = \"kN\" }\n"
    "f = { value = 5, unit = \"Hz\" }\n"
    "n = { value = 300, unit = \"rpm\" }\n"
    "a = { value = 90, unit = \"deg\" }\n"
    "share = { value = 50, unit = \"%\" }\n"
    "t = { value = 3, unit = \"1/min\" }\n"
    "c = 7\n";

class DimensionTest : public testing::Test {
 protected:
  ExpressionDimension dimension(const std::string& text) const {
    return dimension_of(Expression::parse(text, scene_.parameters.names()), scene_.parameters.list());
  }
  std::string fault(const std::string& text, const std::string& unit) const {
    try {
      return dimension_fault(Expression::parse(text, scene_.parameters.names()), scene_.parameters.list(),
                             unit);
    } catch (const DimensionError& error) {
      return error.what();
    }
  }

 private:
  Scene scene_ = parse_scene(parameters, "test.toml");
};

TEST_F(DimensionTest, FollowsThroughEveryOperation) {
  const std::vector<std::pair<std::string, std::string>> table = {
      {"m", "kg"},         {"-2 * m", "kg"},        {"m * l^2", "kg m^2"}, {"F / l", "N/m"},
      {"2 / l", "1/m"},    {"l + 0.5", "m"},        {"0.5 - l", "m"},      {"sqrt(F / l / m)", "1/s"},
      {"l^1.5", "m^1.5"},  {"l^-1", "1/m"},         {"m * f^2", "N/m"},    {"m * sin(a)", "kg"},
      {"m * l / l", "kg"}, {"l * cos(n / f)", "m"}, {"share * m", "kg"},   {"c + l", "m"},
      {"l * 2^share", "m"}};
  for (const auto& [text, unit] : table) {
    const ExpressionDimension found = dimension(text);
    EXPECT_EQ(found.kind, Kind::known) << text;
    EXPECT_EQ(si_unit(found.dimension), unit) << text;
  }
}

TEST_F(DimensionTest, OfNumbersAndOfParametersWithoutAUnitFitsAnywhere) {
  for (const std::string text : {"c", "c * m", "c / m", "c^2 * l", "sqrt(c)", "2 * c + 1"})
    EXPECT_EQ(dimension(text).kind, Kind::unknown) << text;
  for (const std::string text : {"2 * pi", "sin(a)", "exp(c)", "100 * cos(2 * a)"})
    EXPECT_EQ(dimension(text).kind, Kind::number) << text;
  for (const std::string text : {"c", "c * m", "3", "100 * sin(a)"})
    EXPECT_EQ(fault(text, "N/m"), "") << text;
}

TEST_F(DimensionTest, ThatDoesNotFitIsNamedBesideTheOneExpected) {
  const std::vector<std::vector<std::string>> table = {
      {"F", "kg", "is in kN, but kg is expected"},
      {"l", "N/m", "is in mm, but N/m is expected"},
      {"m * l", "kg m^2", "is in kg m, but kg m^2 is expected; a factor that stands for a quantity needs"},
      {"500 * n", "N/m", "is in 1/s, but N/m is expected"},
      {"a", "m", "is in deg, but m is expected"},
      {"l", "", "is in mm, but a number without unit is expected"},
      {"m + l", "kg", "adds kg and m"},
      {"F - m * f", "N", "subtracts N and N s/m"},
      {"sin(l)", "", "has a function of m; its argument must be an angle or a number"},
      {"2^l", "", "has an exponent in m; exponents are numbers"},
      {"l^c", "m", "raises m to a power that depends on parameters"},
      {"t", "rad/s", "is in 1/min, which does not say of what"}};
  for (const auto& row : table) EXPECT_EQ(fault(row[0], row[1]).substr(0, row[2].size()), row[2]) << row[0];
}

TEST_F(DimensionTest, OfAnglesAndSpeedsFitsWhateverTheirUnit) {
  for (const std::string text : {"n", "f", "2 * f", "n + f", "sqrt(F / l / m)"})
    EXPECT_EQ(fault(text, "rad/s"), "") << text;
  EXPECT_EQ(fault("a", "rad"), "");
  EXPECT_EQ(fault("F * l", "N m/rad"), "");
}

TEST_F(DimensionTest, SecondConversionToRadiansIsRefused) {
  for (const std::string text :
       {"2 * pi * f", "f * 2 * pi", "2*pi*n/60", "n * pi / 30", "pi / 180 * a", "a * pi / 180",
        "(2 * pi * f)^2", "4 * pi^2 * f^2 * m", "m * (2 * pi * f)^2", "l * 2 * pi * n"}) {
    EXPECT_TRUE(contains(fault(text, "1"), "to radians twice")) << text << ": " << fault(text, "1");
  }
  for (const std::string text : {"pi * l^2 * n", "f / (2 * pi)", "2 * pi * c", "cos(pi / 2 - a)", "3 * f"})
    EXPECT_FALSE(contains(fault(text, "1"), "twice")) << text;
}

std::string scene_fault(const std::string& text) {
  return input_error([&] { parse_scene(text, "test.toml"); });
}

TEST(DerivedParameter, OfKnownDimensionIsAQuantity) {
  const Scene scene = parse_scene(
      "[parameters]\nw = { value = 10, unit = \"Hz\" }\nn = { value = \"2 * w\", unit = \"rpm\" }\n"
      "p = { value = \"2 * 3\", unit = \"mm\" }\n",
      "test.toml");
  const Vector values = scene.parameters.declared_values();
  EXPECT_NEAR(values[1], 1200.0, 1e-12 * 1200.0) << "20 Hz in rpm";
  EXPECT_EQ(values[2], 6.0) << "a number of millimetres";
}

TEST(DerivedParameter, MustHaveTheDimensionOfItsUnit) {
  EXPECT_TRUE(contains(scene_fault("[parameters]\nl = { value = 1, unit = \"m\" }\n"
                                   "k = { value = \"2 * l\", unit = \"N/m\" }\n"),
                       "test.toml:3:1: [parameters] k: its value is in m, but its unit is N/m"));
}

TEST(DerivedParameter, OfUnknownDimensionMustSayItsUnitClearly) {
  const std::string start = "[parameters]\nc = 2\nl = { value = 1, unit = \"m\" }\n";
  EXPECT_TRUE(contains(scene_fault(start + "b = { value = \"c * l\", unit = \"mm\" }\n"),
                       "b: it is not known whether its value is in mm or in SI units: l has a unit"));
  EXPECT_EQ(scene_fault(start + "b = { value = \"c * l\", unit = \"m\" }\n"), "no error was thrown");
  EXPECT_EQ(scene_fault(start + "b = { value = \"3 * c\", unit = \"mm\" }\n"), "no error was thrown");
}

TEST(ParameterDefinition, MayNotAddDifferentDimensions) {
  EXPECT_TRUE(contains(scene_fault("[parameters]\nl = { value = 1, unit = \"m\" }\n"
                                   "m = { value = 1, unit = \"kg\" }\nx = \"l + m\"\n"),
                       "test.toml:4:1: [parameters] x: adds m and kg"));
}

}  // namespace
}  // namespace eigentrail::test::expression_dimension_test
