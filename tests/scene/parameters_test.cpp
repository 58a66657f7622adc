#include "eigentrail/scene/parameters.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "eigentrail/core/series.hpp"
#include "scene/input_error.hpp"

namespace eigentrail::test::parameters_test {
namespace {

constexpr double pi = std::numbers::pi;

struct Declaration {
  std::string name;
  double value = 0.0;
  double factor = 1.0;
  std::string definition;  ///< empty for a number
};

Parameters declare(const std::vector<Declaration>& declarations) {
  std::vector<std::string> names;
  for (const Declaration& d : declarations) names.push_back(d.name);
  std::vector<Parameter> list;
  for (const Declaration& d : declarations) {
    Parameter parameter;
    parameter.name = d.name;
    parameter.value = d.value;
    parameter.factor = d.factor;
    if (!d.definition.empty()) parameter.definition = Expression::parse(d.definition, names);
    list.push_back(parameter);
  }
  return Parameters(list);
}

/// A rotor: speed in rpm, radius in mm, and three derived parameters of which one is in rpm again.
std::vector<Declaration> rotor() {
  return {{"speed", 3000.0, pi / 30, ""},
          {"radius", 250.0, 1e-3, ""},
          {"tip", 0.0, 1.0, "speed * radius"},
          {"square", 0.0, 1.0, "tip^2"},
          {"half", 0.0, pi / 30, "speed / 2"}};
}

Vector si_values(const Parameters& parameters) {
  Vector values = parameters.declared_values();
  parameters.to_si(std::span<double>(values.data(), parameters.size()));
  return values;
}

TEST(Parameters, DeclaredValuesAreInDeclaredUnits) {
  const Vector values = declare(rotor()).declared_values();
  EXPECT_DOUBLE_EQ(values[0], 3000.0);
  EXPECT_DOUBLE_EQ(values[1], 250.0);
  EXPECT_DOUBLE_EQ(values[2], 100.0 * pi * 0.25) << "from SI values of the others";
  EXPECT_DOUBLE_EQ(values[4], 50.0 * pi) << "the definition yields the value in the parameter's unit";
}

TEST(Parameters, ToSiScalesNumbersAndComputesDerivedOnes) {
  const Vector si = si_values(declare(rotor()));
  EXPECT_DOUBLE_EQ(si[0], 100.0 * pi);
  EXPECT_DOUBLE_EQ(si[1], 0.25);
  EXPECT_DOUBLE_EQ(si[2], 25.0 * pi);
  EXPECT_DOUBLE_EQ(si[3], 625.0 * pi * pi);
  EXPECT_DOUBLE_EQ(si[4], 50.0 * pi * pi / 30);
}

TEST(Parameters, ToSiIgnoresWhatStoodInDerivedEntries) {
  const Parameters parameters = declare(rotor());
  Vector values = parameters.declared_values();
  values.tail(3).setConstant(NAN);
  parameters.to_si(std::span<double>(values.data(), parameters.size()));
  EXPECT_EQ(values, si_values(parameters));
}

TEST(Parameters, ToSiOnSeriesCarriesTheChainRule) {
  using S = Series<double, 2>;
  const Parameters parameters = declare(rotor());
  std::vector<S> values(5);
  values[0] = S(3000.0);
  values[0][1] = 60.0;  // rpm per unit of h: 2 pi rad/s
  values[1] = S(250.0);
  parameters.to_si(std::span<S>(values));
  EXPECT_DOUBLE_EQ(values[0][1], 2.0 * pi);
  EXPECT_DOUBLE_EQ(values[2][1], 0.5 * pi);
  EXPECT_DOUBLE_EQ(values[3][1], 2.0 * 25.0 * pi * 0.5 * pi);
  EXPECT_DOUBLE_EQ(values[3][2], 0.25 * pi * pi);
}

TEST(Parameters, DerivedOnesMayStandInAnyOrder) {
  // A chain a -> b -> c -> d -> e in every order of declaration.
  std::vector<Declaration> chain = {{"a", 2.0, 1.0, ""},
                                    {"b", 0.0, 1.0, "a + 1"},
                                    {"c", 0.0, 1.0, "2 * b"},
                                    {"d", 0.0, 1.0, "c^2 - a"},
                                    {"e", 0.0, 1.0, "d / b"}};
  const auto by_name = [](const Declaration& x, const Declaration& y) { return x.name < y.name; };
  int orders = 0;
  do {
    const Parameters parameters = declare(chain);
    const Vector si = si_values(parameters);
    EXPECT_EQ(si[*parameters.index("e")], 34.0 / 3.0);
    EXPECT_EQ(si[*parameters.index("d")], 34.0);
    ++orders;
  } while (std::next_permutation(chain.begin(), chain.end(), by_name));
  EXPECT_EQ(orders, 120);
}

TEST(Parameters, CyclesAreRefusedByName) {
  struct Row {
    std::string name;
    std::vector<Declaration> declarations;
  };
  const std::vector<Row> table = {{"itself", {{"a", 0.0, 1.0, "a + 1"}}},
                                  {"two", {{"a", 0.0, 1.0, "b"}, {"b", 0.0, 1.0, "a"}}},
                                  {"three behind a chain",
                                   {{"k", 1.0, 1.0, ""},
                                    {"x", 0.0, 1.0, "a * k"},
                                    {"a", 0.0, 1.0, "b"},
                                    {"b", 0.0, 1.0, "c"},
                                    {"c", 0.0, 1.0, "a"}}}};
  for (const Row& row : table) {
    const std::string message = error_text<std::invalid_argument>([&] { declare(row.declarations); });
    EXPECT_TRUE(contains(message, "is defined through itself: a -> ")) << row.name << ": " << message;
  }
}

TEST(Parameters, DiamondsAreNoCycles) {
  const Parameters parameters = declare(
      {{"d", 0.0, 1.0, "b * c"}, {"b", 0.0, 1.0, "a + 1"}, {"c", 0.0, 1.0, "a - 1"}, {"a", 4.0, 1.0, ""}});
  EXPECT_EQ(parameters.declared_values()[0], 15.0);
}

TEST(Parameters, DependenceGoesThroughOtherParameters) {
  const Parameters parameters = declare(rotor());
  const int speed = 0, radius = 1, tip = 2, square = 3, half = 4;
  EXPECT_TRUE(parameters.depends_on(square, speed));
  EXPECT_TRUE(parameters.depends_on(square, radius));
  EXPECT_TRUE(parameters.depends_on(speed, speed));
  EXPECT_FALSE(parameters.depends_on(half, radius));
  EXPECT_FALSE(parameters.depends_on(tip, square)) << "not against its direction";

  const Expression both = Expression::parse("half + 2 * square", parameters.names());
  EXPECT_TRUE(parameters.depends_on(both, radius));
  EXPECT_FALSE(parameters.depends_on(Expression::parse("half", parameters.names()), radius));
  EXPECT_FALSE(parameters.depends_on(Expression(3.0), speed));
}

TEST(Parameters, AreFoundByName) {
  const Parameters parameters = declare(rotor());
  EXPECT_EQ(parameters.size(), 5U);
  EXPECT_EQ(parameters.index("tip"), 2);
  EXPECT_EQ(parameters[2].name, "tip");
  EXPECT_EQ(parameters.index("Tip"), std::nullopt);
  EXPECT_EQ(parameters.names(), (std::vector<std::string>{"speed", "radius", "tip", "square", "half"}));
}

TEST(Parameters, MayBeEmpty) {
  EXPECT_EQ(Parameters().declared_values().size(), 0);
  EXPECT_EQ(Parameters(std::vector<Parameter>()).size(), 0U);
}

TEST(Parameters, DiamondsOfDefinitionsAreSearchedOnce) {
  std::vector<Declaration> declarations = {{"p0", 1.0, 1.0, ""}, {"p1", 1.0, 1.0, ""}};
  for (int i = 2; i < 200; ++i) {
    const auto name = [](int k) { return "p" + std::to_string(k); };
    declarations.push_back({name(i), 0.0, 1.0, name(i - 1) + " / 2 + " + name(i - 2)});
  }
  const Parameters parameters = declare(declarations);
  EXPECT_TRUE(parameters.depends_on(199, 0));
  EXPECT_EQ(parameters.with_definitions({199}).size(), 200U);
  EXPECT_EQ(parameters.at("p7").name, "p7");
  EXPECT_THROW((void)parameters.at("q"), std::out_of_range);
}

}  // namespace
}  // namespace eigentrail::test::parameters_test
