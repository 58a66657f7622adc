#include "eigentrail/scene/units.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace eigentrail {
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
}  // namespace eigentrail
