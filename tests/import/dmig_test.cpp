// DMIG in punch files.
#include "import/dmig.hpp"

#include <gtest/gtest.h>

#include "scene/input_error.hpp"

namespace eigentrail::test::dmig_test {
namespace {

std::vector<DmigMatrix> read(const std::string& text) {
  return parse_dmig(text, "a.pch");
}

std::string message(const std::string& text) {
  return test::input_error([&] { read(text); });
}

void expect_entry(const DmigEntry& entry, const DmigFreedom& row, const DmigFreedom& column, double value) {
  EXPECT_EQ(name_of(entry.row), name_of(row));
  EXPECT_EQ(name_of(entry.column), name_of(column));
  EXPECT_EQ(entry.value, value);
}

TEST(Dmig, SmallFields) {
  const auto matrices = read(
      "$ comment\n"
      "DMIG    STIF    0       6       2       0\n"
      "DMIG    STIF    27      1               27      1       3.+5            \n"
      "        28      3       -1.25-3         31              2.5     \n"
      "DMIG    STIF          28       3              28       3   1.D+3\n");
  ASSERT_EQ(matrices.size(), 1u);
  const DmigMatrix& K = matrices[0];
  EXPECT_EQ(K.name, "STIF");
  EXPECT_TRUE(K.symmetric);
  EXPECT_FALSE(K.single);
  ASSERT_EQ(K.entries.size(), 4u);
  expect_entry(K.entries[0], {27, 1}, {27, 1}, 3e5);
  expect_entry(K.entries[1], {28, 3}, {27, 1}, -1.25e-3);
  expect_entry(K.entries[2], {31, 0}, {27, 1}, 2.5);
  expect_entry(K.entries[3], {28, 3}, {28, 3}, 1000.0);
}

/// As Nastran punches them.
TEST(Dmig, LargeFields) {
  const auto matrices = read(
      "DMIG    KAAX           0       1       1       0                      12\n"
      "DMIG*   KAAX                           1               2\n"
      "*                      1               2 1.250000000D+02\n"
      "*                     10               0-2.500000000D-01 0.000000000D+00\n");
  ASSERT_EQ(matrices.size(), 1u);
  EXPECT_FALSE(matrices[0].symmetric);
  EXPECT_TRUE(matrices[0].single);
  EXPECT_EQ(matrices[0].digits, 10);
  ASSERT_EQ(matrices[0].entries.size(), 2u);
  expect_entry(matrices[0].entries[0], {1, 2}, {1, 2}, 125.0);
  expect_entry(matrices[0].entries[1], {10, 0}, {1, 2}, -0.25);
}

TEST(Dmig, FreeFields) {
  const auto matrices = read(
      "dmig,maax,0,6,2\n"
      "DMIG,MAAX,1,1,,1,1,2.0,,+a\n"
      "+a,2,1,0.5\n"
      ",3,1,0.25,,4,1,0.125\n"
      "DMIG*,MAAX,2,1,\n"
      "*,2,1,3.0\n");
  ASSERT_EQ(matrices.size(), 1u);
  EXPECT_EQ(matrices[0].name, "MAAX");
  ASSERT_EQ(matrices[0].entries.size(), 5u);
  expect_entry(matrices[0].entries[1], {2, 1}, {1, 1}, 0.5);
  expect_entry(matrices[0].entries[3], {4, 1}, {1, 1}, 0.125);
  expect_entry(matrices[0].entries[4], {2, 1}, {2, 1}, 3.0);
}

TEST(Dmig, OtherBulkDataAreSkipped) {
  const auto matrices = read(
      "BEGIN SUPER       75\n"
      "GRID    373             20.25   -61.25  19.5\n"
      "DTI     TUG1    2\n"
      "        TYPE    ID      COMP    ROW     TYPE    ID      COMP    ROW\n"
      "DMIG    M       0       1       2\n"
      "DMIG    M       1       1               1       1       1.0\n"
      "SPOINT   7590001    THRU 7590010\n"
      "           words    words   words\n"
      "ENDDATA\n");
  ASSERT_EQ(matrices.size(), 1u);
  EXPECT_EQ(matrices[0].entries.size(), 1u);
}

TEST(Dmig, MatricesThatCannotBeUsedAreKeptByName) {
  const auto matrices = read(
      "DMIG,Z,0,6,3\nDMIG,Z,1,1,,1,1,1.0,2.0\n"
      "DMIG,P,0,9,2,,,,1\nDMIG,P,1,0,,1,1,1.0\n"
      "DMIG,K,0,6,1\nDMIG,K,1,1,,1,1,1.0\n");
  ASSERT_EQ(matrices.size(), 3u);
  EXPECT_EQ(matrices[0].fault, "is complex (type 3); expected real numbers");
  EXPECT_EQ(matrices[1].fault, "has form 9; expected 1 (square) or 6 (symmetric)");
  EXPECT_TRUE(matrices[0].entries.empty());
  EXPECT_EQ(matrices[2].entries.size(), 1u);
}

TEST(Dmig, Names) {
  EXPECT_EQ(name_of({12, 3}), "grid 12, T3");
  EXPECT_EQ(name_of({12, 4}), "grid 12, R1");
  EXPECT_EQ(name_of({7, 0}), "point 7");
}

TEST(Dmig, FaultsNameTheirLine) {
  const std::string header = "DMIG,K,0,6,2\n";
  const std::pair<std::string, const char*> faults[] = {
      {"DMIG,,0,6,2\n", "a.pch:1: DMIG without the name"},
      {"DMIG,K,0,six,2\n", "expected a form and a type from 1 to 4"},
      {"DMIG,K,0,6,5\n", "expected a form and a type from 1 to 4"},
      {header + "DMIG,K,1,1,,-1,1,1.0\n", "expected the number of a point, found '-1'"},
      {header + "DMIG,K,1,1,,1,1,\n", "matrix K: expected a finite number, found ''"},
      {header + "DMIG\tK\t1\t1\n", "tabs between fields"},
  };
  for (const auto& [text, expected] : faults)
    EXPECT_TRUE(test::contains(message(text), expected)) << message(text);
}

}  // namespace
}  // namespace eigentrail::test::dmig_test
