#include "eigentrail/scene/scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "eigentrail/scene/limits.hpp"
#include "scene/input_error.hpp"

namespace eigentrail::test::scene_test {
namespace {

using test::contains;
using test::input_error;

Scene parsed(const std::string& text) {
  return parse_scene(text, "test.toml");
}

double declared(const Scene& scene, const std::string& name) {
  return scene.parameters.declared_values()[scene.parameters.index(name).value()];
}

double si(const Scene& scene, const std::string& name) {
  Vector values = scene.parameters.declared_values();
  scene.parameters.to_si(std::span<double>(values.data(), scene.parameters.size()));
  return values[scene.parameters.index(name).value()];
}

TEST(ParseScene, KeepsTitleTextAndPath) {
  const std::string text = "title = \"Pendulum\"\n";
  const Scene scene = parsed(text);
  EXPECT_EQ(scene.title, "Pendulum");
  EXPECT_EQ(scene.text, text);
  EXPECT_EQ(scene.path, "test.toml");
  EXPECT_EQ(scene.parameters.size(), 0U);
}

TEST(ParseScene, ParametersAreNumbersExpressionsOrTablesWithAUnit) {
  const Scene scene = parsed(
      "[parameters]\n"
      "mass = 2\n"
      "speed = { value = 3000, unit = \"rpm\" }\n"
      "radius = { unit = \"mm\", value = 250 }\n"
      "inertia = \"mass * radius^2\"\n"
      "tip = { value = \"speed * radius\", unit = \"km/h\" }\n");
  EXPECT_EQ(scene.parameters.names(),
            (std::vector<std::string>{"mass", "speed", "radius", "inertia", "tip"}));
  EXPECT_DOUBLE_EQ(declared(scene, "speed"), 3000.0);
  EXPECT_DOUBLE_EQ(si(scene, "speed"), 100.0 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(si(scene, "radius"), 0.25);
  EXPECT_DOUBLE_EQ(si(scene, "inertia"), 0.125);
  EXPECT_DOUBLE_EQ(declared(scene, "tip"), 25.0 * std::numbers::pi * 3.6) << "25 pi m/s";
  EXPECT_DOUBLE_EQ(si(scene, "tip"), 25.0 * std::numbers::pi);
  EXPECT_EQ(scene.parameters[1].unit, "rpm");
  EXPECT_EQ(scene.parameters[3].where.line, 5);
}

TEST(ParseScene, DerivedParametersMayStandBeforeWhatTheyUse) {
  const Scene scene = parsed("[parameters]\nc = \"a + b\"\nb = \"2 * a\"\na = 3\n");
  EXPECT_EQ(declared(scene, "c"), 9.0);
}

const std::string family = "[matrix_family]\nM = [[[1]]]\nK = [[[1]]]\n";

TEST(ParseScene, TracedParameterOfAMatrixFamilyIsImplied) {
  const Scene scene =
      parsed("[parameters]\nc = 2\n[trace]\nparameter = \"p\"\nfrom = 0.5\nto = 1\n" + family);
  EXPECT_EQ(scene.parameters.names(), (std::vector<std::string>{"c", "p"}));
  EXPECT_EQ(declared(scene, "p"), 0.5);
}

TEST(ParseScene, ParametersMayUseTheImpliedOne) {
  const Scene scene =
      parsed("[parameters]\nk = \"2 * p\"\n[trace]\nparameter = \"p\"\nfrom = 0.5\nto = 1\n" + family);
  EXPECT_EQ(declared(scene, "k"), 1.0);
}

TEST(ParseScene, DeclarationBeatsTheImpliedParameter) {
  const Scene scene = parsed(
      "[parameters]\np = { value = 7, unit = \"mm\" }\n[trace]\nparameter = \"p\"\nfrom = 0.5\nto = 1\n" +
      family);
  EXPECT_EQ(scene.parameters.names(), (std::vector<std::string>{"p"}));
  EXPECT_EQ(declared(scene, "p"), 7.0);
}

TEST(ParseScene, NothingIsImpliedWithoutAMatrixFamily) {
  EXPECT_EQ(parsed("[trace]\nparameter = \"p\"\nfrom = 0.5\n").parameters.size(), 0U);
  EXPECT_EQ(parsed(family).parameters.size(), 0U) << "without [trace]";
  EXPECT_EQ(parsed("[trace]\nparameter = \"2 p\"\n" + family).parameters.size(), 0U) << "no name";
  EXPECT_EQ(parsed("trace = 1\n" + family).parameters.size(), 0U) << "no table";
}

TEST(SceneError, LeavesOutAPlaceThatIsUnknown) {
  const Scene scene = parsed("");
  EXPECT_STREQ(scene_error(scene, {3, 7}, "wrong").what(), "test.toml:3:7: wrong");
  EXPECT_STREQ(scene_error(scene, {}, "wrong").what(), "test.toml: wrong");
}

TEST(Tables, AreTheTablesOfAnArrayInOrder) {
  const Scene scene =
      parsed("[[rod]]\nlength = 1\n[[rod]]\nlength = 2\n[gravity]\ng = 9.81\n[[spring]]\nk = 1\n");
  const auto rods = tables(scene, "rod");
  ASSERT_EQ(rods.size(), 2U);
  EXPECT_EQ(std::get<double>(rods[1]->find("length")->data), 2.0);
  EXPECT_EQ(rods[1]->where.line, 3);
  EXPECT_EQ(tables(scene, "gravity").size(), 1U) << "a single table counts as one";
  EXPECT_TRUE(tables(scene, "damper").empty());
  EXPECT_TRUE(tables(parsed("rod = []\n"), "rod").empty());
}

TEST(UnusedParameters, AreThoseThatNothingUses) {
  const Scene scene = parsed("[parameters]\nmass = 1\nspare = 2\nk = 3\n");
  EXPECT_EQ(unused_parameters(scene, {0, 2}), std::vector<int>{1});
  EXPECT_EQ(unused_parameters(scene, {0, 1, 2}), std::vector<int>());
  EXPECT_STREQ(
      unused_error(scene, 1).what(),
      "test.toml:3:1: [parameters] spare: nothing in the scene uses this parameter; remove it or use it");
}

TEST(UnusedParameters, AreRefusedIfTheyLookLikeMisprints) {
  const Scene scene = parsed("[parameters]\nstiffness = 1\nstiffnes = 2\n");
  EXPECT_EQ(input_error([&] { unused_parameters(scene, {0}); }),
            "test.toml:3:1: [parameters] stiffnes: nothing in the scene uses this parameter; did you mean "
            "'stiffness'?");
  const Scene siblings = parsed("[parameters]\nspring1 = 1\nspring2 = 2\n");
  EXPECT_EQ(unused_parameters(siblings, {0}), std::vector<int>{1});
}

TEST(UnusedParameters, CountUseThroughOtherParameters) {
  const Scene scene = parsed("[parameters]\na = 1\nb = \"a\"\nc = \"b\"\n");
  EXPECT_EQ(unused_parameters(scene, {2}), std::vector<int>());
  EXPECT_EQ(unused_parameters(scene, {1}), std::vector<int>{2}) << "using others is not being used";
}

class ReadScene : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(path); }
  const std::string path = testing::TempDir() + "eigentrail_" +
                           testing::UnitTest::GetInstance()->current_test_info()->name() + ".toml";
};

TEST_F(ReadScene, ReadsTheFileByteForByte) {
  const std::string text = "title = \"Träger\"\r\n[parameters]\r\nk = 1\r\n";
  std::ofstream(path, std::ios::binary) << text;
  const Scene scene = read_scene(path);
  EXPECT_EQ(scene.text, text);
  EXPECT_EQ(scene.title, "Träger");
  EXPECT_EQ(scene.path, path);
}

TEST_F(ReadScene, NamesTheFileInErrors) {
  EXPECT_TRUE(input_error([&] { read_scene(path); }).starts_with(path + ": no such file"));
  EXPECT_TRUE(input_error([&] { read_scene(testing::TempDir()); }).starts_with(testing::TempDir()));
  std::ofstream(path) << "k = \n";
  EXPECT_TRUE(input_error([&] { read_scene(path); }).starts_with(path + ":1:"));
}

TEST_F(ReadScene, RefusesFilesThatAreTooLarge) {
  std::ofstream(path) << "k = 1\n";
  std::filesystem::resize_file(path, limits::scene_bytes + 1);
  EXPECT_TRUE(contains(input_error([&] { read_scene(path); }), "put large matrices into HDF5"));
}

}  // namespace
}  // namespace eigentrail::test::scene_test
