#include <gtest/gtest.h>

#include "eigentrail/scene/scene.hpp"
#include "scene/input_error.hpp"

namespace eigentrail::test::table_reader_test {
namespace {

using test::contains;
using test::input_error;

constexpr const char* parameters =
    "[parameters]\n"  // line 1
    "mass = 2\n"
    "length = 1.5\n"
    "k = 10\n"
    "[element]\n";  // line 5; the element's keys begin in line 6

class TableReaderTest : public testing::Test {
 protected:
  /// A reader of the table [element] with these lines.
  TableReader& read(const std::string& lines) {
    scene_ = parse_scene(parameters + lines, "test.toml");
    used.clear();
    reader_.emplace(scene_, *tables(scene_, "element").at(0), "[element]", used);
    return *reader_;
  }

  double value(const Expression& expression) const {
    const Vector values = scene_.parameters.declared_values();
    return expression.evaluate(
        std::span<const double>(values.data(), static_cast<std::size_t>(values.size())));
  }

  std::set<int> used;

 private:
  Scene scene_;
  std::optional<TableReader> reader_;
};

TEST_F(TableReaderTest, ExpressionIsANumberOrATextOfParameters) {
  EXPECT_EQ(value(read("x = 2.5\n").expression("x")), 2.5);
  EXPECT_EQ(value(read("x = 3\n").expression("x")), 3.0);
  EXPECT_EQ(value(read("x = \"mass * length^2\"\n").expression("x")), 4.5);
  EXPECT_EQ(value(read("x = 1\n").expression_or("y", 7.0)), 7.0) << "the default of an absent key";
  EXPECT_EQ(value(read("x = 1\n").expression_or("x", 7.0)), 1.0);
}

TEST_F(TableReaderTest, ParametersThatExpressionsNameAreUsed) {
  TableReader& reader = read("x = \"mass * 2\"\ny = [0, \"-k\", 1]\nz = 3\n");
  reader.expression("z");
  EXPECT_TRUE(used.empty());
  reader.expression("x");
  EXPECT_EQ(used, std::set<int>{0});
  reader.vector("y");
  EXPECT_EQ(used, (std::set<int>{0, 2}));
}

TEST_F(TableReaderTest, VectorIsThreeExpressions) {
  const auto v = read("v = [1, \"-mass\", \"length / 2\"]\n").vector("v");
  EXPECT_EQ(value(v[0]), 1.0);
  EXPECT_EQ(value(v[1]), -2.0);
  EXPECT_EQ(value(v[2]), 0.75);
}

TEST_F(TableReaderTest, PlacesAreNamesOrPositions) {
  TableReader& reader = read("a = \"hub\"\nb = [0, 0, \"length\"]\n");
  EXPECT_EQ(std::get<std::string>(reader.name_or_position("a")), "hub");
  const auto b = std::get<std::array<Expression, 3>>(reader.name_or_position("b"));
  EXPECT_EQ(value(b[2]), 1.5);
}

TEST_F(TableReaderTest, TextsAreTakenAsTheyAre) {
  TableReader& reader = read("n = -4.5\nt = \"mass\"\n");
  EXPECT_EQ(reader.text("t"), "mass");
  EXPECT_TRUE(reader.has("n"));
  EXPECT_FALSE(reader.has("m"));
  EXPECT_EQ(reader.label(), "[element]");
}

TEST_F(TableReaderTest, MatricesAreListsOfRowsOfExpressions) {
  const auto m = read("m = [[[1, 2], [3, \"k\"]], [[5]]]\n").matrices("m");
  ASSERT_EQ(m.size(), 2U);
  ASSERT_EQ(m[0].size(), 2U);
  ASSERT_EQ(m[0][1].size(), 2U);
  EXPECT_EQ(value(m[0][1][0]), 3.0);
  EXPECT_EQ(value(m[0][1][1]), 10.0);
  EXPECT_EQ(value(m[1][0][0]), 5.0);
  EXPECT_EQ(used, std::set<int>{2});
}

TEST_F(TableReaderTest, FinishRejectsKeysThatNobodyAskedForAndNamesTheNearest) {
  TableReader& reader = read("mass = 1\n lenght = 2\n");
  reader.expression("mass");
  reader.expression_or("length", 1.0);
  EXPECT_EQ(input_error([&] { reader.finish(); }),
            "test.toml:7:2: [element] lenght: unknown key; did you mean 'length'?");
}

TEST_F(TableReaderTest, FinishListsTheKnownKeysWhenNoneIsNear) {
  TableReader& reader = read("colour = \"red\"\n");
  reader.has("mass");
  reader.expression_or("length", 1.0);
  EXPECT_EQ(input_error([&] { reader.finish(); }),
            "test.toml:6:1: [element] colour: unknown key; known: mass, length");
}

TEST_F(TableReaderTest, FinishAcceptsATableWhoseKeysWereAllAskedFor) {
  TableReader& reader = read("a = 1\nb = [0, 0, 0]\nc = \"text\"\ne = [[[1]]]\nf = \"hub\"\ng = 2\n");
  reader.expression("a");
  reader.vector("b");
  reader.text("c");
  reader.matrices("e");
  reader.name_or_position("f");
  EXPECT_TRUE(contains(input_error([&] { reader.finish(); }), "[element] g: unknown key"));
  reader.expression("g");
  EXPECT_NO_THROW(reader.finish());
}

TEST_F(TableReaderTest, FailPointsAtTheTableWhenTheKeyIsAbsent) {
  TableReader& reader = read("a = 1\n");
  EXPECT_EQ(input_error([&] { reader.fail("a", "too large"); }), "test.toml:6:1: [element] a: too large");
  EXPECT_EQ(input_error([&] { reader.fail("b", "needed here"); }), "test.toml:5:1: [element] b: needed here");
}

}  // namespace
}  // namespace eigentrail::test::table_reader_test
