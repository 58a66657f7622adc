// Tables of files.
#include "import/file_table.hpp"

#include <gtest/gtest.h>

#include "scene/input_error.hpp"

namespace eigentrail::test::file_table_test {
namespace {

std::string message(const std::string& text) {
  return test::input_error([&] { parse_file_table(text, "dir/t.csv"); });
}

TEST(FileTable, ValuesAndFilesBesideTheTable) {
  const FileTable table = parse_file_table(
      "# from the tunnel\n\nwind_speed [m/s], A, E\r\n3.0, A_3.mtx, \"E.mtx\"\n 1.5d1 ,sub/A_15.mtx,E.mtx\n",
      "dir/t.csv");
  EXPECT_EQ(table.parameter, "wind_speed");
  EXPECT_EQ(table.unit, "m/s");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"A", "E"}));
  EXPECT_EQ(table.values, (std::vector<double>{3.0, 15.0}));
  ASSERT_EQ(table.files.size(), 2u);
  EXPECT_EQ(table.files[0], (std::vector<std::string>{"dir/A_3.mtx", "dir/E.mtx"}));
  EXPECT_EQ(table.files[1], (std::vector<std::string>{"dir/sub/A_15.mtx", "dir/E.mtx"}));
}

TEST(FileTable, AbsoluteNamesStay) {
  EXPECT_EQ(parse_file_table("p,A\n1,/a/b.mtx", "dir/t.csv").files[0][0], "/a/b.mtx");
  EXPECT_EQ(parse_file_table("p,A\n1,b.mtx", "t.csv").files[0][0], "b.mtx");
}

TEST(FileTable, FaultsNameTheirLine) {
  const std::pair<const char*, const char*> faults[] = {
      {"", "no table"},
      {"# nothing\n", "no table"},
      {"p\n1\n", "dir/t.csv:1: expected titles separated by commas"},
      {"wind speed,A\n1,a\n", "'wind speed': expected the name of the parameter"},
      {"1,A\n", "dir/t.csv:1: '1': expected the name of the parameter"},
      {"p,A\n", "the table has no rows"},
      {"p,A\n1,a,b\n", "dir/t.csv:2: the row has 3 cells; expected 2"},
      {"p,A\n1\n", "the row has 1 cells; expected 2"},
      {"p,A\none,a\n", "expected a value of p, found 'one'"},
      {"p,A\nnan,a\n", "expected a value of p, found 'nan'"},
      {"p,A\n1,a\n1.0,b\n", "dir/t.csv:3: the value 1 of p is there already"},
      {"p,A\n1,\n", "no file for A"},
      {"p,,,,,,,,,,,,,,,,,,,,,,,,\n", "more than 20 columns"},
  };
  for (const auto& [text, expected] : faults)
    EXPECT_TRUE(test::contains(message(text), expected)) << message(text);
}

TEST(FileTable, IsKnownByItsName) {
  EXPECT_TRUE(is_file_table("a/b.csv"));
  EXPECT_TRUE(is_file_table("b.CSV"));
  EXPECT_FALSE(is_file_table("csv"));
  EXPECT_FALSE(is_file_table("b.mtx"));
}

}  // namespace
}  // namespace eigentrail::test::file_table_test
