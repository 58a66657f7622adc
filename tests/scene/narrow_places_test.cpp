// Where expressions change within a small part of the range: bumps and steps whose places are known.
#include "scene/narrow_places.hpp"

#include <gtest/gtest.h>

#include "scene/interval.hpp"

namespace eigentrail::test::narrow_places_test {
namespace {

/// Places of an expression of p, on the range 0 to 1 if no other is given.
std::vector<double> places(const std::string& text, double from = 0.0, double to = 1.0) {
  const Parameters parameters({Parameter{"p", 0.0, "", 1.0}});
  const std::vector<Expression> expressions{Expression::parse(text, {"p"})};
  return narrow_places(parameters, Vector::Zero(1), 0, from, to, expressions);
}

TEST(NarrowPlaces, OfSmoothExpressionsAreNone) {
  for (const char* text :
       {"3", "p", "2 + p^4 - p", "sin(5*p)", "exp(-p)", "1/(1 + p^2)", "sqrt(1 + p)", "p - p", "tanh(3*p)",
        "cos(p)^2 + sin(p)^2", "(1 + p)^1.5", "log(2 + p)", "atan(4*p)", "sin(p)*cos(p) - cos(p)*sin(p)"})
    EXPECT_TRUE(places(text).empty()) << text;
}

TEST(NarrowPlaces, OfABumpLieOnIt) {
  for (const double width : {1e-2, 1e-3, 1e-5}) {
    const std::string text = "5 - 2*exp(-((p - 0.3137)/" + std::to_string(width) + ")^2)";
    const std::vector<double> found = places(text);
    ASSERT_FALSE(found.empty()) << width;
    for (const double place : found) EXPECT_NEAR(place, 0.3137, 4.0 * width) << width;
  }
}

TEST(NarrowPlaces, OfASteepTransitionLieOnItInBothDirections) {
  for (const bool back : {false, true}) {
    const std::vector<double> found =
        places("1 + tanh(1e4*(p - 0.7123))", back ? 1.0 : 0.0, back ? 0.0 : 1.0);
    ASSERT_FALSE(found.empty());
    for (const double place : found) EXPECT_NEAR(place, 0.7123, 1e-3);
  }
}

TEST(NarrowPlaces, AreFoundEachByItself) {
  const std::vector<double> found = places("exp(-1e6*(p - 0.2)^2) + exp(-1e6*(p - 0.6)^2) + p");
  ASSERT_GE(found.size(), 2U);
  EXPECT_NEAR(found.front(), 0.2, 4e-3);
  EXPECT_NEAR(found.back(), 0.6, 4e-3);
}

TEST(NarrowPlaces, DoNotLieOnAPole) {
  for (const double place : places("1/(p - 0.5)")) EXPECT_NE(place, 0.5);
}

TEST(NarrowPlaces, AreThoseOfDefinitionsOfParametersToo) {
  std::vector<Parameter> list{Parameter{"p", 0.0, "", 1.0}, Parameter{"k", 0.0, "", 1.0}};
  list[1].definition = Expression::parse("exp(-1e6*(p - 0.25)^2)", {"p", "k"});
  const std::vector<double> found = narrow_places(Parameters(list), Vector::Zero(2), 0, 0.0, 1.0, {});
  ASSERT_FALSE(found.empty());
  EXPECT_NEAR(found.front(), 0.25, 4e-3);
}

/// The enclosures contain what they enclose, and are not much wider for a single function.
TEST(Interval, EnclosesEveryFunction) {
  using Real = double (*)(double);
  using Enclosing = Interval (*)(const Interval&);
  const std::vector<std::pair<Real, Enclosing>> functions{
      {std::exp, exp},   {std::sin, sin},   {std::cos, cos},   {std::sinh, sinh}, {std::cosh, cosh},
      {std::tanh, tanh}, {std::atan, atan}, {std::asin, asin}, {std::acos, acos}, {std::floor, floor}};
  for (const Interval x : {Interval(-0.9, -0.3), Interval(-0.4, 0.8), Interval(0.1, 0.2)}) {
    for (const auto& [f, F] : functions) {
      const Interval image = F(x);
      double least = INFINITY, largest = -INFINITY;
      for (int i = 0; i <= 1000; ++i) {
        const double y = f(x.lower + (x.upper - x.lower) * i / 1000.0);
        least = std::min(least, y);
        largest = std::max(largest, y);
      }
      EXPECT_LE(image.lower, least + 1e-15);
      EXPECT_GE(image.upper, largest - 1e-15);
      EXPECT_NEAR(image.lower, least, 1e-5);
      EXPECT_NEAR(image.upper, largest, 1e-5);
    }
  }
  EXPECT_EQ(cos(Interval(3.0, 10.0)), Interval(-1.0, 1.0));
  EXPECT_EQ(Interval(-1.0, 2.0) * Interval(3.0, 4.0), Interval(-4.0, 8.0));
  EXPECT_FALSE((Interval(1.0) / Interval(-1.0, 1.0)).is_finite());
  EXPECT_FALSE(sqrt(Interval(-1.0, 1.0)).is_finite());
}

}  // namespace
}  // namespace eigentrail::test::narrow_places_test
