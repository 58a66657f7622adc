// OUTPUT4 as text.
#include <gtest/gtest.h>

#include "import/op4.hpp"
#include "scene/input_error.hpp"

namespace eigentrail::test::op4_text_test {
namespace {

std::vector<Op4Matrix> read(
    const std::string& text, const Op4Choice& wanted = [](const std::string&) { return true; }) {
  return parse_op4(text, "a.op4", wanted);
}

std::string message(const std::string& text) {
  return test::input_error([&] { read(text); });
}

const Matrix expected{{1.0, -2.0, 0.0}, {3.0, 0.0, 0.0}, {0.5, 4.0, 0.0}};

const std::string end =
    "       4       1       1\n"
    " 1.000000000E+00\n";

const std::string dense =
    "       3       3       1       2KAA     1P,2E16.9\n"
    "       1       1       3\n"
    " 1.000000000E+00 3.000000000E+00\n"
    " 5.000000000E-01\n"
    "       2       1       3\n"
    "-2.000000000E+00 0.000000000E+00\n"
    " 4.000000000D+00\n" +
    end;

/// Strings with length and row packed: length * 65536 + row, a double has two words.
const std::string packed =
    "       3       3       1       2KAA     1P,5E16.9\n"
    "       1       0       7\n"
    "  458753\n"  // (6 + 1) * 65536 + 1
    " 1.000000000E+00 3.000000000E+00 5.000000000E-01\n"
    "       2       0       6\n"
    "  196609\n"
    "-2.000000000E+00\n"
    "  196611\n"
    " 4.000000000E+00\n" +
    end;

const std::string bigmat =
    "       3      -3       1       2KAA     1P,5E16.9\n"
    "       1       0       8\n"
    "       7       1\n"
    " 1.000000000E+00 3.000000000E+00 5.000000000E-01\n"
    "       2       0       8\n"
    "       3       1\n"
    "-2.000000000E+00\n"
    "       3       3\n"
    " 4.000000000E+00\n" +
    end;

std::string replaced(std::string text, const std::string& old, const std::string& replacement) {
  return text.replace(text.find(old), old.size(), replacement);
}

TEST(Op4Text, AllVariantsHoldTheSameMatrix) {
  for (const std::string& text : {dense, packed, bigmat}) {
    const auto matrices = read(text);
    ASSERT_EQ(matrices.size(), 1u);
    EXPECT_EQ(matrices[0].name, "KAA");
    EXPECT_EQ(matrices[0].values, expected);
    EXPECT_EQ(matrices[0].digits, 10);
    EXPECT_FALSE(matrices[0].single);
  }
}

TEST(Op4Text, SinglePrecisionHasOneWordPerNumber) {
  const auto matrices = read(
      "       3       3       6       1maa     1P,5E16.9\n"
      "       1       0       4\n"
      "  262145\n"  // (3 + 1) * 65536 + 1
      " 1.000000000E+00 3.000000000E+00 5.000000000E-01\n" +
      end);
  EXPECT_EQ(matrices[0].name, "MAA");
  EXPECT_TRUE(matrices[0].single);
  EXPECT_EQ(matrices[0].values.col(0), expected.col(0));
}

TEST(Op4Text, WideIntegersInTheHeader) {
  EXPECT_EQ(read(replaced(bigmat, "       3      -3       1       2KAA     1P,5E16.9",
                          "               3              -3       1       2KAA     1P,5E16.9|I16"))[0]
                .values,
            expected);
}

TEST(Op4Text, MatricesThatAreNotWantedOrCannotBeUsedAreSkipped) {
  const std::string complex =
      "       1       1       6       4ZAA     1P,5E16.9\n"
      "       1       1       2\n"
      " 1.000000000E+00 2.000000000E+00\n"
      "       2       1       1\n"
      " 1.000000000E+00\n";
  const std::string load =
      "       1   99999       2       2PG      1P,5E16.9\n"
      "       1   99999       1\n"
      " 1.000000000E+00\n"
      "       2       1       1\n"
      " 1.000000000E+00\n";
  const auto matrices = read(complex + load + replaced(dense, "KAA", "XYZ") + packed,
                             [](const std::string& name) { return name == "KAA"; });
  ASSERT_EQ(matrices.size(), 4u);
  EXPECT_EQ(matrices[0].fault, "is complex (type 4); expected real numbers");
  EXPECT_EQ(matrices[1].fault, "is 99999 x 1; expected a square matrix");
  EXPECT_EQ(matrices[2].values.size(), 0);
  EXPECT_EQ(matrices[3].values, expected);
}

TEST(Op4Text, LargeMatricesAreNotStored) {
  const auto matrices = read(
      "  100000  100000       6       2KGG     1P,5E16.9\n"
      "  100001       1       1\n"
      " 1.000000000E+00\n");
  EXPECT_EQ(matrices[0].fault, "has 100000 rows; matrices of up to 5000 rows can be imported");
}

TEST(Op4Text, ThreeDigitsOfExponent) {
  EXPECT_EQ(read(replaced(dense, " 1.000000000E+00", "1.000000000-101 "))[0].values(0, 0), 1e-101);
}

TEST(Op4Text, FaultsNameTheirLine) {
  const std::pair<std::string, const char*> faults[] = {
      {"\n", "no matrix of Nastran's OUTPUT4"},
      {replaced(dense, "       2KAA", "       9KAA"), "no header of a matrix"},
      {replaced(dense, "       3       3", "99999999       0"), "no header of a matrix"},
      {replaced(dense, "1P,2E16.9", "1P,0E16.9"), "expected a format of numbers"},
      {replaced(dense, "1P,2E16.9", "9999999E16.9"), "expected a format of numbers"},
      {dense.substr(0, dense.size() - end.size()), "the file ends within matrix KAA"},
      {replaced(dense, "       1       1       3", "       1       2       3"),
       "3 numbers from row 2 on; matrix KAA has 3"},
      {replaced(dense, "       1       1       3", "       1      -1       3"), "expected a column, a row"},
      {replaced(dense, "       2       1       3", "       1       1       3"),
       "column 1 of matrix KAA follows column 1"},
      {replaced(dense, "       2       1       3", "       9       1       3"),
       "column 9 of matrix KAA follows column 1"},
      {replaced(dense, " 3.000000000E+00", ""), "found ''"},
      {replaced(packed, "  458753", "99999999"), "expected the length and the first row of a string"},
      {replaced(packed, "  458753", "       1"), "expected the length and the first row of a string"},
      {replaced(packed, "  458753", "  393217"), "expected the length and the first row of a string"},
      {replaced(bigmat, "       7       1", "       7       2"), "3 numbers from row 2 on"},
      {replaced(bigmat, "       7       1", "       7       0"), "expected the length and the first row"},
      {replaced(bigmat, "       1       0       8", "       1       0       7"), "more words than announced"},
  };
  for (const auto& [text, part] : faults) EXPECT_TRUE(test::contains(message(text), part)) << message(text);
}

}  // namespace
}  // namespace eigentrail::test::op4_text_test
