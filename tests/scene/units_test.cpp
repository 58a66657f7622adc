#include "eigentrail/scene/units.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace eigentrail::test::units_test {
namespace {

// A product of a few factors, each rounded once.
constexpr double rounding = 1e-15;
constexpr double pi = std::numbers::pi;

struct Unit {
  std::string text;
  double factor;
};

void expect_factors(const std::vector<Unit>& table) {
  for (const Unit& unit : table) {
    const auto factor = unit_factor(unit.text);
    ASSERT_TRUE(factor.has_value()) << '"' << unit.text << '"';
    EXPECT_NEAR(*factor, unit.factor, rounding * unit.factor) << '"' << unit.text << '"';
  }
}

TEST(UnitFactor, OfNoUnitIsOne) {
  expect_factors({{"", 1.0}, {"1", 1.0}, {"-", 1.0}, {" ", 1.0}});
}

TEST(UnitFactor, OfSingleUnitsIsTheirDefinition) {
  expect_factors({{"m", 1.0},
                  {"mm", 1e-3},
                  {"µm", 1e-6},
                  {"km", 1e3},
                  {"in", 0.0254},
                  {"ft", 12 * 0.0254},
                  {"kg", 1.0},
                  {"g", 1e-3},
                  {"t", 1e3},
                  {"lb", 0.45359237},
                  {"min", 60.0},
                  {"h", 3600.0},
                  {"lbf", 0.45359237 * 9.80665},
                  {"slug", 0.45359237 * 9.80665 / 0.3048},
                  {"MPa", 1e6},
                  {"kJ", 1e3},
                  {"deg", pi / 180},
                  {"rev", 2 * pi},
                  {"rpm", pi / 30},
                  {"Hz", 2 * pi},
                  {"kHz", 2e3 * pi},
                  {"bar", 1e5},
                  {"daN", 10.0},
                  {"psi", 0.45359237 * 9.80665 / (0.0254 * 0.0254)},
                  {"kt", 1852.0 / 3600.0},
                  {"mph", 1609.344 / 3600.0},
                  {"g0", 9.80665},
                  {"%", 0.01}});
}

TEST(UnitFactor, OfProductsQuotientsAndPowersFollowsFromTheirFactors) {
  expect_factors({{"rad/s", 1.0},       {"m/s^2", 1.0},       {"N m^-1", 1.0},
                  {"N/mm", 1e3},        {"N mm", 1e-3},       {"N*mm", 1e-3},
                  {"N·mm", 1e-3},       {"kg m^2", 1.0},      {"kg mm^2", 1e-6},
                  {"g mm^-3", 1e6},     {"N s/m", 1.0},       {"km/h", 1.0 / 3.6},
                  {"deg/s", pi / 180},  {"rev/min", pi / 30}, {"1/min", 1.0 / 60.0},
                  {"/min", 1.0 / 60.0}, {"mm / ms^2", 1e3},   {"m/min/min", 1.0 / 3600.0},
                  {"kJ/kg km", 1e6},    {" mm ", 1e-3},       {"m^0", 1.0}});
}

TEST(ParseUnit, KnowsTheDimension) {
  const std::vector<std::pair<std::string, Dimension>> table = {{"mm", {{0, 1, 0}}},
                                                                {"kN", {{1, 1, -2}}},
                                                                {"N m/rad", {{1, 2, -2}}},
                                                                {"lbf s/in", {{1, 0, -1}}},
                                                                {"GPa mm^4", {{1, 3, -2}}},
                                                                {"rpm", {{0, 0, -1}}},
                                                                {"deg", {}},
                                                                {"%", {}},
                                                                {"mV s/m", {{1, 1, -2, -1}}},
                                                                {"slug/ft^3", {{1, -3, 0}}},
                                                                {"kW/m^2 K^-1", {{1, 0, -3, 0, -1}}}};
  for (const auto& [text, dimension] : table) {
    const auto unit = parse_unit(text);
    ASSERT_TRUE(unit.has_value()) << text;
    EXPECT_TRUE(unit->dimension == dimension) << text << " is " << si_unit(unit->dimension);
  }
}

TEST(ParseUnit, PrefixesDoNotHideOtherUnits) {
  EXPECT_EQ(parse_unit("min")->factor, 60.0) << "no milliinch";
  EXPECT_EQ(parse_unit("ft")->factor, 0.3048) << "no femtotonne";
  EXPECT_EQ(parse_unit("mi")->factor, 1609.344);
  EXPECT_EQ(parse_unit("h")->factor, 3600.0);
  EXPECT_EQ(parse_unit("cd"), std::nullopt) << "no centiday";
}

TEST(SiUnit, NamesUsualDimensionsAndSpellsOutOthers) {
  for (const std::string unit : {"1", "m", "N/m", "N s/m", "N m", "kg m^2", "1/s", "kg/m^3"})
    EXPECT_EQ(si_unit(parse_unit(unit)->dimension), unit);
  EXPECT_EQ(si_unit(parse_unit("J")->dimension), "N m");
  EXPECT_EQ(si_unit(parse_unit("kg^2 s^-3")->dimension), "kg^2 s^-3");
  EXPECT_EQ(si_unit(pow(parse_unit("m")->dimension, 0.5)), "m^0.5");
}

TEST(UnitSuggestion, NamesTheUnitThatIsMeant) {
  const std::vector<std::pair<std::string, std::string>> table = {
      {"RPM", "rpm"},       {"hz", "Hz"},     {"HZ", "Hz"},    {"Nm", "N m"},       {"Nm/rad", "N m/rad"},
      {"rad/sec", "rad/s"}, {"kn", "kN"},     {"mpa", "MPa"},  {"kg*m²", "kg*m^2"}, {"m/s2", "m/s^2"},
      {"degrees", "deg"},   {"Rad", "rad"},   {"Meters", "m"}, {"N.m", "N m"},      {"m**2", "m^2"},
      {"turns/s", "rev/s"}, {"rps", "rev/s"}, {"KG", "kg"},    {"Ns/m", "N s/m"},   {"m/(s^2)", "m/s^2"},
      {"km/hr", ""},        {"furlong", ""},  {"N/(m s)", ""}, {"kg^m", ""}};
  for (const auto& [wrong, right] : table) {
    const std::string expected = right.empty() ? "write it like" : "did you mean '" + right + "'?";
    EXPECT_EQ(unit_suggestion(wrong).substr(0, expected.size()), expected) << wrong;
    EXPECT_EQ(parse_unit(wrong), std::nullopt) << wrong;
  }
}

TEST(AngularFrequency, IsInRadiansPerSecond) {
  EXPECT_DOUBLE_EQ(*angular_frequency("3 Hz"), 6 * pi);
  EXPECT_DOUBLE_EQ(*angular_frequency("60rpm"), 2 * pi);
  EXPECT_DOUBLE_EQ(*angular_frequency("5"), 5.0);
  EXPECT_DOUBLE_EQ(*angular_frequency("180 deg/s"), pi);
  for (const std::string text : {"", "x", "3 m", "3 Hzz", "inf"})
    EXPECT_FALSE(angular_frequency(text).has_value()) << text;
}

TEST(UnitFactor, IsEmptyForTextsThatAreNoUnit) {
  for (const std::string text :
       {"furlong",        "m/",   "m*",   "m·",    "m//s", "m*/s", "m^x",   "m^", "m^1.5", "m^2x",
        "m^ 2",           "^2",   "2",    "10 mm", "M",    "Rad",  "kg·m²", "m)", "N,m",   "m^2^2",
        "m^999999999999", "m^13", "\xc2", "m\xc2"}) {
    EXPECT_FALSE(unit_factor(text).has_value()) << '"' << text << '"';
  }
}

TEST(UnitFactor, IsEmptyForTheMostNegativePower) {
  // Its magnitude is no int.
  EXPECT_FALSE(unit_factor("mm^-2147483648").has_value());
}

TEST(UnitFactor, IsPositiveAndFiniteForLargePowers) {
  for (const std::string text : {"nm^12", "nm^-12", "GPa^12", "GPa^-12"}) {
    const auto factor = unit_factor(text);
    ASSERT_TRUE(factor.has_value()) << text;
    EXPECT_TRUE(std::isfinite(*factor) && *factor > 0.0) << text;
  }
}

}  // namespace
}  // namespace eigentrail::test::units_test
