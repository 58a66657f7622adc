// Linearization files of OpenFAST.
#include "import/lin_file.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "scene/input_error.hpp"

namespace eigentrail::test::lin_file_test {
namespace {

const std::string text = R"(
Linearized model: compiled as a 64-bit application using double precision

Simulation information:
   Rotor Speed:                         0.7301 rad/s
   Azimuth:                             0.0067 rad
   Wind Speed:                          3.0000 m/s

Order of continuous states:
   Row/Column Operating Point     Rotating Frame? Derivative Order Description
   ---------- ---------------     --------------- ---------------- -----------
          1    2.80E-002           F               2    ED 1st tower fore-aft bending mode DOF, m
          2    1.50, 0.0           T               1    AD vind, m/s

Order of inputs:
   Row/Column Operating Point     Rotating Frame? Description
   ---------- ---------------     --------------- -----------
          1    3.0                 F               IfW Extended input: horizontal wind speed, m/s

Linearized state matrices:

A: 2 x 2
 0.000E+00  1.250E+00
-2.500D-01 -1.000-101
)";

/// The text with one occurrence replaced.
std::string with(const std::string& old, const std::string& replacement) {
  std::string result = text;
  result.replace(result.find(old), old.size(), replacement);
  return result;
}

std::string message(const std::string& bad) {
  return test::input_error([&] { parse_lin_file(bad, "a.lin"); });
}

TEST(LinFile, EverythingThatIsRead) {
  const LinFile file = parse_lin_file(text, "a.lin");
  EXPECT_EQ(file.rotor_speed, 0.7301);
  EXPECT_EQ(file.azimuth, 0.0067);
  EXPECT_EQ(file.wind_speed, 3.0);
  ASSERT_EQ(file.states.size(), 2u);
  EXPECT_EQ(file.states[0].description, "ED 1st tower fore-aft bending mode DOF, m");
  EXPECT_EQ(file.states[0].value, 0.028);
  EXPECT_FALSE(file.states[0].rotating);
  EXPECT_EQ(file.states[0].derivative_order, 2);
  EXPECT_EQ(file.states[1].value, 1.5);
  EXPECT_TRUE(file.states[1].rotating);
  EXPECT_EQ(file.states[1].derivative_order, 1);
  ASSERT_EQ(file.operating_values.size(), 1u);
  EXPECT_EQ(file.operating_values[0].description, "IfW Extended input: horizontal wind speed, m/s");
  EXPECT_EQ(file.A, (Matrix{{0.0, 1.25}, {-0.25, -1e-101}}));
  EXPECT_EQ(file.digits, 4);
}

TEST(LinFile, SinglePrecisionHasSevenDigits) {
  const std::string long_numbers = with("1.250E+00", "1.2500000000E+00");
  EXPECT_EQ(parse_lin_file(long_numbers, "a.lin").digits, 11);
  std::string single = long_numbers;
  single.replace(single.find("double precision"), 6, "single");
  EXPECT_EQ(parse_lin_file(single, "a.lin").digits, 7);
}

TEST(LinFile, UnitsAreConverted) {
  EXPECT_NEAR(parse_lin_file(with("0.7301 rad/s", "12.1 rpm"), "a.lin").rotor_speed,
              12.1 * std::numbers::pi / 30.0, 1e-14);
  EXPECT_NEAR(parse_lin_file(with("0.0067 rad", "90 deg"), "a.lin").azimuth, std::numbers::pi / 2.0, 1e-15);
  EXPECT_TRUE(
      test::contains(message(with("rad/s", "Hz   ")), "a.lin:5: expected a number in rad/s, found Hz"));
}

TEST(LinFile, WithoutWind) {
  EXPECT_EQ(parse_lin_file(with("Wind Speed:", "Gust Speed:"), "a.lin").wind_speed, std::nullopt);
}

TEST(LinFile, FaultsNameTheirLine) {
  EXPECT_TRUE(test::contains(message(text.substr(0, text.find("A: 2"))), "no matrix 'A: n x n'"));
  EXPECT_TRUE(
      test::contains(message(with(" 1.250E+00", "")), "a.lin:23: row 1 of A has 1 numbers; expected 2"));
  EXPECT_TRUE(test::contains(message(with("A: 2 x 2", "A: 2 x 3")), "expected 'A: n x n'"));
  EXPECT_TRUE(test::contains(message(with("A: 2 x 2", "A: 1 x 1")), "row 1 of A has 2 numbers"));
  EXPECT_TRUE(test::contains(
      message(with("          2    1.50, 0.0           T               1    AD vind, m/s\n", "")),
      "A has 2 rows; the table lists 1 states"));
  EXPECT_TRUE(test::contains(message(with("F               2    ED", "F               7    ED")),
                             "derivative order 7"));
  EXPECT_TRUE(test::contains(message(with("2.80E-002", "many")), "a.lin:12: expected a row number"));
}

}  // namespace
}  // namespace eigentrail::test::lin_file_test
