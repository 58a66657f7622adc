#include "eigentrail/scene/value.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/input_error.hpp"

namespace eigentrail::test::value_test {
namespace {

using test::contains;
using test::input_error;

/// "line:column"
std::string place(SourceLocation where) {
  return std::to_string(where.line) + ":" + std::to_string(where.column);
}

Table parsed(const std::string& text) {
  return parse_toml(text, "test.toml");
}

template <class T>
const T& get(const Table& table, const std::string& key) {
  const Value* value = table.find(key);
  if (value == nullptr) throw std::out_of_range(key);
  return std::get<T>(value->data);
}

TEST(ParseToml, ReadsEveryKindOfValue) {
  const Table root = parsed(
      "flag = true\ninteger = -7\nreal = 2.5e-3\ntext = \"rotor\"\nlist = [1, \"k\", [false]]\n[table]\nx = "
      "1\n");
  EXPECT_EQ(get<bool>(root, "flag"), true);
  EXPECT_EQ(get<double>(root, "integer"), -7.0);
  EXPECT_EQ(get<double>(root, "real"), 2.5e-3);
  EXPECT_EQ(get<std::string>(root, "text"), "rotor");
  const Array& list = get<Array>(root, "list");
  ASSERT_EQ(list.size(), 3U);
  EXPECT_EQ(std::get<double>(list[0].data), 1.0);
  EXPECT_EQ(std::get<std::string>(list[1].data), "k");
  EXPECT_EQ(std::get<bool>(std::get<Array>(list[2].data)[0].data), false);
  EXPECT_EQ(get<double>(get<Table>(root, "table"), "x"), 1.0);
  EXPECT_EQ(root.find("absent"), nullptr);
}

TEST(ParseToml, NamesTheKindOfEveryValueForMessages) {
  const Table root = parsed("a = true\nb = 1\nc = \"\"\nd = []\ne = {}\n");
  EXPECT_EQ(root.find("a")->kind(), "true or false");
  EXPECT_EQ(root.find("b")->kind(), "a number");
  EXPECT_EQ(root.find("c")->kind(), "a text");
  EXPECT_EQ(root.find("d")->kind(), "an array");
  EXPECT_EQ(root.find("e")->kind(), "a table");
}

TEST(ParseToml, KeepsTheOrderOfTheFile) {
  const Table root = parsed("zeta = 1\nalpha = 2\n[mass]\nk = 1\nc = 2\nb.z = 3\na = 4\n[before]\n");
  const auto keys = [](const Table& table) {
    std::vector<std::string> names;
    for (const auto& [key, value] : table.entries) names.push_back(key);
    return names;
  };
  EXPECT_EQ(keys(root), (std::vector<std::string>{"zeta", "alpha", "mass", "before"}));
  EXPECT_EQ(keys(get<Table>(root, "mass")), (std::vector<std::string>{"k", "c", "b", "a"}));
}

TEST(ParseToml, PlacesAValueWhereItsKeyStands) {
  const Table root =
      parsed("title = \"x\"\n\n  indented   = 3\n[table]\nk = [1,\n  2]\ninline = { a = 1, b = 2 }\n");
  EXPECT_EQ(place(root.find("title")->where), "1:1");
  EXPECT_EQ(place(root.find("indented")->where), "3:3");
  EXPECT_EQ(place(root.find("table")->where), "4:2");
  const Table& table = get<Table>(root, "table");
  EXPECT_EQ(place(table.where), "4:1");
  EXPECT_EQ(place(table.find("k")->where), "5:1");
  const Array& items = get<Array>(table, "k");
  EXPECT_EQ(place(items[0].where), "5:6");
  EXPECT_EQ(place(items[1].where), "6:3");
  EXPECT_EQ(place(get<Table>(table, "inline").find("b")->where), "7:19");
}

TEST(ParseToml, PlacesEveryTableOfAnArrayOfTables) {
  const Table root = parsed("[[rod]]\nx = 1\n[[rod]]\ny = 2\n");
  const Array& rods = get<Array>(root, "rod");
  ASSERT_EQ(rods.size(), 2U);
  EXPECT_EQ(place(std::get<Table>(rods[0].data).where), "1:1");
  EXPECT_EQ(place(std::get<Table>(rods[1].data).where), "3:1");
}

TEST(ParseToml, SyntaxErrorsNameFileLineAndColumn) {
  struct Row {
    std::string text, where;
  };
  const std::vector<Row> table = {
      {"a = 1\nb = \n", "test.toml:2:"},  {"a = 1\n\nc = [1, 2\n", "test.toml:3:"},
      {"a = 1\na = 2\n", "test.toml:2:"}, {"[t]\n[t]\n", "test.toml:2:"},
      {"x = 1 2\n", "test.toml:1:7: "},   {"x = \"open\n", "test.toml:1:"},
      {"x = \"\xff\"\n", "test.toml:1:"}, {"just words\n", "test.toml:1:"}};
  for (const Row& row : table) {
    const std::string message = input_error([&] { parsed(row.text); });
    EXPECT_TRUE(message.starts_with(row.where)) << row.text << " -> " << message;
    EXPECT_TRUE(contains(message, "not valid TOML")) << message;
  }
}

TEST(ParseToml, RefusesDatesAtTheirPlace) {
  for (const std::string date : {"2024-06-01", "12:30:00", "2024-06-01T12:30:00Z"}) {
    EXPECT_TRUE(input_error([&] {
                  parsed("a = 1\nwhen = " + date + "\n");
                }).starts_with("test.toml:2:8: dates and times have no meaning"))
        << date;
  }
}

TEST(ParseToml, NumbersThatAreNotFiniteAreReadAsSuch) {
  const Table root = parsed("a = inf\nb = -inf\nc = nan\n");
  EXPECT_EQ(get<double>(root, "a"), INFINITY);
  EXPECT_EQ(get<double>(root, "b"), -INFINITY);
  EXPECT_TRUE(std::isnan(get<double>(root, "c")));
}

TEST(ParseToml, IntegersBeyondTheMantissaAreRoundedLikeOtherNumbers) {
  EXPECT_EQ(get<double>(parsed("a = 9007199254740992\n"), "a"), 9007199254740992.0);
  EXPECT_EQ(get<double>(parsed("a = 9007199254740993\n"), "a"), 9007199254740992.0);
}

TEST(ParseToml, RefusesNestingBeyondAnyUse) {
  std::string dotted;
  for (int i = 0; i < 100000; ++i) dotted += "a.";
  // Tables in tables: as many as toml++ lets pass, each inside a key of a hundred parts.
  std::string nested = "x = ";
  for (int i = 0; i < 255; ++i) nested += "{" + dotted.substr(0, 200) + "a = ";
  nested += "1" + std::string(255, '}') + "\n";
  struct Row {
    std::string name, text;
  };
  for (const Row& row : {Row{"arrays", "a = " + std::string(100000, '[')},
                         Row{"dotted keys", dotted + "a = 1\n"}, Row{"dotted header", "[" + dotted + "a]\n"},
                         Row{"dotted key of an inline table", "x = { " + dotted + "a = 1 }\n"},
                         Row{"dotted keys in nested tables", nested},
                         Row{"quoted parts of a dotted key", "\"=\"." + dotted + "a = 1\n"},
                         Row{"behind a text", "x = { s = 'it', " + dotted + "a = 1 }\n"},
                         Row{"behind an escaped quote", "x = { s = \"\\\"\", " + dotted + "a = 1 }\n"},
                         Row{"behind a long text", "x = { s = \"\"\" \" \"\"\", " + dotted + "a = 1 }\n"}}) {
    EXPECT_TRUE(input_error([&] { parsed(row.text); }).starts_with("test.toml:1:")) << row.name;
  }
}

TEST(ParseToml, RowsOfManyNumbersAreNotTakenForKeys) {
  std::string row;
  for (int i = 0; i < 500; ++i) row += "0.5, ";
  const Table root = parsed("M = [[\n  [" + row + "1.0],\n  [" + row + "2.0]\n]]\n");
  const Array& rows = std::get<Array>(get<Array>(root, "M")[0].data);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(std::get<double>(std::get<Array>(rows[1].data)[500].data), 2.0);
}

TEST(ParseToml, DotsInTextsAndCommentsAreNotTakenForKeys) {
  std::string sum = "0.5";
  for (int i = 0; i < 100; ++i) sum += " + 0.5 * p";
  for (const std::string quote : {"\"", "'", "\"\"\"", "'''"}) {
    const Table root = parsed("# " + sum + "\nx = " + quote + sum + quote + "  # it's " + sum + "\ny = 1\n");
    EXPECT_EQ(get<std::string>(root, "x"), sum);
    EXPECT_EQ(get<double>(root, "y"), 1.0);
  }
}

}  // namespace
}  // namespace eigentrail::test::value_test
