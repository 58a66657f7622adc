#include "eigentrail/scene/expression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace eigentrail::test::expression_test {
namespace {

using S = Series<double, 4>;

// A few roundings.
constexpr double rounding = 1e-14;

const std::vector<std::string> names = {"length", "mass", "x"};
const std::vector<double> values = {1.5, -2.0, 0.25};

double value(const std::string& text) {
  return Expression::parse(text, names).evaluate(std::span<const double>(values));
}

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

struct ValueCase {
  std::string text;
  double value;
};

void expect_values(const std::vector<ValueCase>& table) {
  for (const ValueCase& row : table) {
    EXPECT_NEAR(value(row.text), row.value, rounding * std::abs(row.value)) << row.text;
  }
}

TEST(Expression, NumbersHaveTheUsualForms) {
  expect_values({{"7", 7.0},
                 {"0.5", 0.5},
                 {".5", 0.5},
                 {"5.", 5.0},
                 {"1e3", 1000.0},
                 {"2.5E-3", 0.0025},
                 {"1e+2", 100.0},
                 {" \t 12 \n", 12.0}});
}

TEST(Expression, OperatorsHaveTheirPrecedenceAndAssociativity) {
  expect_values({{"2 + 3 * 4", 14.0},
                 {"(2 + 3) * 4", 20.0},
                 {"10 - 4 - 3", 3.0},
                 {"10 - (4 - 3)", 9.0},
                 {"24 / 4 / 3", 2.0},
                 {"24 / 4 * 3", 18.0},
                 {"2 - 3 + 4", 3.0},
                 {"2^3^2", 512.0},
                 {"(2^3)^2", 64.0},
                 {"2 * 3^2", 18.0},
                 {"18 / 3^2", 2.0},
                 {"2^3 * 2", 16.0},
                 {"2^3 + 1", 9.0}});
}

TEST(Expression, SignsBindWeakerThanPowersAndStrongerThanProducts) {
  expect_values({{"-2^2", -4.0},
                 {"(-2)^2", 4.0},
                 {"2*-3", -6.0},
                 {"2 - -3", 5.0},
                 {"2--3", 5.0},
                 {"2^-1", 0.5},
                 {"2^-2^2", 0.0625},
                 {"-2^-2", -0.25},
                 {"+3", 3.0},
                 {"2 + +3", 5.0},
                 {"-----1", -1.0},
                 {"+-+-1", 1.0},
                 {"6/-2*3", -9.0}});
}

TEST(Expression, FunctionsAndConstants) {
  expect_values({{"pi", std::numbers::pi},
                 {"sqrt(2)", std::sqrt(2.0)},
                 {"sin(0.3)", std::sin(0.3)},
                 {"cos(0.3)", std::cos(0.3)},
                 {"tan(0.3)", std::tan(0.3)},
                 {"asin(0.3)", std::asin(0.3)},
                 {"acos(0.3)", std::acos(0.3)},
                 {"atan(0.3)", std::atan(0.3)},
                 {"sinh(0.3)", std::sinh(0.3)},
                 {"cosh(0.3)", std::cosh(0.3)},
                 {"tanh(0.3)", std::tanh(0.3)},
                 {"exp(0.3)", std::exp(0.3)},
                 {"log(0.3)", std::log(0.3)},
                 {"sin (pi/6)^2", 0.25},
                 {"-sqrt(4)^3", -8.0},
                 {"exp(log(sqrt(9) + 1) * 2)", 16.0}});
}

TEST(Expression, ParametersTakeTheValuesGiven) {
  expect_values({{"length", 1.5},
                 {"mass", -2.0},
                 {"-mass*length^2", 4.5},
                 {"length/x", 6.0},
                 {"sqrt(x)", 0.5},
                 {"2*pi*x", std::numbers::pi / 2}});
}

TEST(Expression, ParametersMayShareTheirNameWithAFunctionOrPi) {
  const std::vector<double> own = {3.0, 0.5};
  const Expression e = Expression::parse("pi + sin(sin)", {"pi", "sin"});
  EXPECT_DOUBLE_EQ(e.evaluate(std::span<const double>(own)), 3.0 + std::sin(0.5));
}

TEST(Expression, WholePowersOfNegativeAndZeroBasesAreDefined) {
  expect_values({{"mass^2", 4.0},
                 {"mass^3", -8.0},
                 {"mass^(3)", -8.0},
                 {"mass^-3", -0.125},
                 {"mass^0", 1.0},
                 {"(x - 0.25)^2", 0.0},
                 {"(x - 0.25)^0", 1.0},
                 {"mass^+2", 4.0},
                 {"mass^64", std::pow(2.0, 64)}});
  EXPECT_TRUE(std::isnan(value("mass^0.5")));
}

TEST(Expression, WholePowersOfSeriesNeedNoLogarithm) {
  S h;
  h[1] = 1.0;
  const std::vector<S> parameters = {h, h - 1.0, S(0.0)};
  const S square = Expression::parse("length^2", names).evaluate(std::span<const S>(parameters));
  const S cube = Expression::parse("mass^3", names).evaluate(std::span<const S>(parameters));
  const std::vector<double> h_minus_one_cubed = {-1.0, 3.0, -3.0, 1.0, 0.0};
  for (int k = 0; k <= 4; ++k) {
    EXPECT_EQ(square[k], k == 2 ? 1.0 : 0.0);
    EXPECT_DOUBLE_EQ(cube[k], h_minus_one_cubed[k]);
  }
}

TEST(Expression, OnSeriesIsTheTaylorExpansion) {
  // length = 1.5 + h: every operation once, against closed forms of the coefficients.
  S h;
  h[1] = 1.0;
  const std::vector<S> parameters = {1.5 + h, S(-2.0), h};
  const auto on_series = [&](const std::string& text) {
    return Expression::parse(text, names).evaluate(std::span<const S>(parameters));
  };
  const S exponential = on_series("exp(2*x - mass)");
  const S reciprocal = on_series("1/length");
  const S power = on_series("length^2.5");
  double factorial = 1.0;
  double binomial = 1.0;
  for (int k = 0; k <= 4; ++k) {
    EXPECT_NEAR(exponential[k], std::exp(2.0) * std::pow(2.0, k) / factorial, rounding * std::exp(2.0) * 2.0);
    EXPECT_NEAR(reciprocal[k], std::pow(-1.0, k) * std::pow(1.5, -k - 1), rounding);
    EXPECT_NEAR(power[k], binomial * std::pow(1.5, 2.5 - k), 10 * rounding);
    binomial *= (2.5 - k) / (k + 1);
    factorial *= k + 1;
  }
}

TEST(Expression, OnConstantSeriesHasTheValueOnNumbers) {
  const std::vector<S> parameters(values.begin(), values.end());
  for (const std::string text :
       {"2^3^2", "-mass^2 + length/x", "sqrt(x) - sin(x)*cos(x)/tan(x)", "asin(x) + acos(x) + atan(mass)",
        "sinh(x) + cosh(mass) - tanh(length)", "exp(mass) * log(length)", "mass^-3 + length^0.3"}) {
    const S y = Expression::parse(text, names).evaluate(std::span<const S>(parameters));
    EXPECT_NEAR(y[0], value(text), rounding * (1.0 + std::abs(value(text)))) << text;
    for (int k = 1; k <= 4; ++k) EXPECT_EQ(y[k], 0.0) << text;
  }
}

TEST(Expression, NestedSeriesGiveTheDerivativeWithRespectToOneParameter) {
  using Nested = Series<S, 1>;
  std::vector<Nested> parameters(values.begin(), values.end());
  parameters[0][1] = S(1.0);
  const Nested y =
      Expression::parse("mass * length^3 / sqrt(x)", names).evaluate(std::span<const Nested>(parameters));
  EXPECT_NEAR(y[1][0], -2.0 * 3.0 * 1.5 * 1.5 / 0.5, 100 * rounding);
}

TEST(Expression, KnowsItsParameters) {
  const Expression e = Expression::parse("x + length*x - sin(x)^2", names);
  EXPECT_EQ(e.parameters(), (std::vector<int>{0, 2}));
  EXPECT_FALSE(e.is_constant());
  EXPECT_TRUE(Expression::parse("2*pi", names).is_constant());
  EXPECT_TRUE(Expression(3.0).is_constant());
  EXPECT_EQ(Expression(3.0).evaluate(std::span<const double>()), 3.0);
}

struct Malformed {
  std::string text;
  std::size_t offset;
  std::string message;  ///< a part of it
};

TEST(Expression, MalformedTextsNameTheFaultAndItsPlace) {
  const std::vector<Malformed> table = {
      {"", 0, "ends where"},
      {"   ", 3, "ends where"},
      {"1 +", 3, "ends where"},
      {"2^", 2, "ends where"},
      {"-", 1, "ends where"},
      {"(1 + 2", 0, "never closed"},
      {"3*(1 + (2)", 2, "never closed"},
      {"sin(1", 3, "never closed"},
      {"1 + 2)", 5, "unexpected ')'"},
      {"2 3", 2, "unexpected '3'"},
      {"2x", 1, "unexpected 'x'"},
      {"2(3)", 1, "unexpected '('"},
      {"1.2.3", 3, "unexpected '.'"},
      {"1e", 1, "unexpected 'e'"},
      {"0x10", 1, "unexpected 'x'"},
      {"* 2", 0, "unexpected '*'"},
      {"2 ** 3", 2, "powers are written with '^'"},
      {"()", 1, "unexpected ')'"},
      {"sin()", 4, "unexpected ')'"},
      {"1, 2", 1, "unexpected ','"},
      {"2 = 2", 2, "unexpected '='"},
      {".", 0, "no number"},
      {"1 + 1e999", 4, "no number"},
      {"atan(1, 2)", 6, "unexpected ','"},
      {"1 + masss", 4, "unknown parameter 'masss'; did you mean 'mass'?"},
      {"temperature", 0, "unknown parameter 'temperature'; known: length, mass, x"},
      {"nan", 0, "unknown parameter"},
      {"2 * sine(1)", 4, "unknown function 'sine'; did you mean 'sin'?"},
      {"mass(2)", 0, "unknown function 'mass'"},
      {"sin + 1", 0, "unknown parameter 'sin'"},
  };
  for (const Malformed& row : table) {
    try {
      Expression::parse(row.text, names);
      ADD_FAILURE() << '"' << row.text << "\" was accepted";
    } catch (const ExpressionError& error) {
      EXPECT_EQ(error.offset, row.offset) << row.text;
      EXPECT_NE(std::string(error.what()).find(row.message), std::string::npos)
          << row.text << ": " << error.what();
    }
  }
}

TEST(Expression, EveryBeginningOfAnExpressionIsAcceptedOrRefusedInPlace) {
  const std::string text = "-(2*pi)^-2 * sin(length / sqrt(x) - 1.5e-3) + mass^2^0.5";
  for (std::size_t n = 0; n < text.size(); ++n) {
    try {
      Expression::parse(text.substr(0, n), names);
    } catch (const ExpressionError& error) {
      EXPECT_LE(error.offset, n) << text.substr(0, n);
    }
  }
}

TEST(Expression, TextsBeyondTheLimitsAreRefused) {
  const std::vector<std::string> refused = {repeated("(", 10000),
                                            repeated("(", 2000) + "1" + repeated(")", 2000),
                                            "1" + repeated("+1", 2500),
                                            repeated("sin(", 1000) + "1" + repeated(")", 1000),
                                            repeated("2^", 1000) + "2",
                                            repeated("2^-", 1000) + "2",
                                            repeated("(2^", 800) + "2" + repeated(")", 800),
                                            repeated("1+(", 70) + "1" + repeated(")", 70),
                                            std::string(5000, ' ') + "1",
                                            std::string(5000, '1')};
  for (const std::string& text : refused) {
    EXPECT_THROW(Expression::parse(text, names), ExpressionError) << text.substr(0, 20) << "...";
  }
}

TEST(Expression, TextsWithinTheLimitsAreEvaluated) {
  expect_values({{repeated("(", 99) + "1" + repeated(")", 99), 1.0},
                 {repeated("-", 4000) + "1", 1.0},
                 {repeated("-", 4001) + "1", -1.0},
                 {"1" + repeated("+1", 2047), 2048.0},
                 {"1" + repeated("^2", 60), 1.0},
                 {repeated("1+(", 60) + "1" + repeated(")", 60), 61.0},
                 {repeated("sqrt(", 90) + "1" + repeated(")", 90), 1.0}});
}

TEST(Expression, TheDeepestStackAcceptedIsEvaluatedOnEveryScalar) {
  // The deepest nesting that the parser accepts must not write beyond the evaluation stack.
  int deepest = 0;
  for (int n = 1; n < 100; ++n) {
    const std::string text = repeated("x-(", n) + "x" + repeated(")", n);
    try {
      Expression::parse(text, names);
      deepest = n;
    } catch (const ExpressionError&) {
      break;
    }
  }
  EXPECT_EQ(deepest + 1, Expression::max_stack);
  const std::string text = repeated("x-(", deepest) + "x" + repeated(")", deepest);
  EXPECT_EQ(value(text), deepest % 2 == 1 ? 0.0 : 0.25);
}

}  // namespace
}  // namespace eigentrail::test::expression_test
