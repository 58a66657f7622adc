// Lines, words and numbers of text files.
#include "import/text_lines.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "scene/input_error.hpp"
#include "support/folder.hpp"

namespace eigentrail::test::text_lines_test {
namespace {

TEST(TextLines, EndsOfEverySystem) {
  TextLines lines("a\nb\r\n\nlast", "file");
  EXPECT_EQ(lines.next(), "a");
  EXPECT_EQ(lines.next(), "b");
  EXPECT_EQ(lines.next(), "");
  EXPECT_EQ(lines.next(), "last");
  EXPECT_EQ(lines.line(), 4);
  EXPECT_EQ(lines.next(), std::nullopt);
}

TEST(TextLines, ErrorsNameFileAndLine) {
  TextLines lines("a\nb", "file.txt");
  lines.next();
  lines.next();
  EXPECT_EQ(test::input_error([&] { lines.fail("is wrong"); }), "file.txt:2: is wrong");
}

TEST(TextLines, WordsLieBetweenBlanks) {
  const auto words = words_of("  one\ttwo \r");
  ASSERT_EQ(words.size(), 2u);
  EXPECT_EQ(words[0], "one");
  EXPECT_EQ(words[1], "two");
  EXPECT_TRUE(words_of(" \t ").empty());
  EXPECT_EQ(trimmed(" \ta b\r "), "a b");
}

TEST(TextLines, NumbersAsFortranPrintsThem) {
  EXPECT_EQ(number_of("1.5"), 1.5);
  EXPECT_EQ(number_of("+1.5"), 1.5);
  EXPECT_EQ(number_of("-.5"), -0.5);
  EXPECT_EQ(number_of("3."), 3.0);
  EXPECT_EQ(number_of("1.5E-003"), 1.5e-3);
  EXPECT_EQ(number_of("1.5D+02"), 150.0);
  EXPECT_EQ(number_of("1.5d2"), 150.0);
  EXPECT_EQ(number_of("1.5-101"), 1.5e-101);
  EXPECT_EQ(number_of("-2.5+10"), -2.5e10);
  EXPECT_EQ(number_of("1e-400"), 0.0);
  EXPECT_EQ(number_of("1.0-400"), 0.0);
  EXPECT_EQ(number_of("1e400"), INFINITY);
}

TEST(TextLines, WordsThatAreNoNumbers) {
  for (const char* word : {"", "+", "-", ".", "e5", "1.5x", "1,5", "0x10", "1-", "--1", "1 2", "1.5e"})
    EXPECT_EQ(number_of(word), std::nullopt) << word;
  for (const char* word : {"", "1.0", "a", "99999999999999999999", "1-"})
    EXPECT_EQ(whole_number_of(word), std::nullopt) << word;
  EXPECT_EQ(whole_number_of("+12"), 12);
  EXPECT_EQ(whole_number_of("-3"), -3);
}

TEST(TextLines, PrintedDigitsCountTrailingZeros) {
  EXPECT_EQ(printed_digits("2.801451E-002"), 7);
  EXPECT_EQ(printed_digits("-0.00120"), 3);
  EXPECT_EQ(printed_digits("1.000000"), 7);
  EXPECT_EQ(printed_digits("1.25-10"), 3);
  EXPECT_EQ(printed_digits("0.000000"), 0);
  EXPECT_EQ(printed_digits("12"), 0);
}

TEST(TextLines, NamesOfParameters) {
  for (const char* name : {"p", "wind_speed", "A2"}) EXPECT_TRUE(is_identifier(name)) << name;
  for (const char* name : {"", "2p", "_p", "wind speed", "a-b", "\xc3\xa4"})
    EXPECT_FALSE(is_identifier(name)) << name;
}

TEST(TextLines, FilesThatCannotBeRead) {
  const test::Folder folder;
  EXPECT_TRUE(
      test::contains(test::input_error([&] { read_text_file(folder.path() + "/none"); }), "no such file"));
  EXPECT_TRUE(test::contains(test::input_error([&] { read_text_file(folder.path()); }), "is a folder"));
  std::ofstream(folder.path() + "/text") << "a\n";
  EXPECT_EQ(read_text_file(folder.path() + "/text"), "a\n");
}

}  // namespace
}  // namespace eigentrail::test::text_lines_test
