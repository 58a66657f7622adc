// Files of the Matrix Market.
#include "import/market_file.hpp"

#include <gtest/gtest.h>

#include "scene/input_error.hpp"

namespace eigentrail::test::market_file_test {
namespace {

Matrix read(const std::string& text) {
  return parse_market_file("%%MatrixMarket matrix " + text, "a.mtx").dense();
}

Matrix read_whole(const std::string& text, const std::string& path) {
  return parse_market_file(text, path).dense();
}

std::string message(const std::string& text) {
  return test::input_error([&] { parse_market_file(text, "a.mtx"); });
}

TEST(MarketFile, Coordinates) {
  EXPECT_EQ(
      read("coordinate real general\n% comment\n\n2 3 3\n1 1 1.5\n2 3 -2.5D+01\n% in between\n1 2 1e-3\n"),
      (Matrix{{1.5, 1e-3, 0.0}, {0.0, 0.0, -25.0}}));
}

TEST(MarketFile, EntriesThatAreGivenTwiceAreAdded) {
  EXPECT_EQ(read("coordinate real general\n1 1 2\n1 1 1.5\n1 1 2\n"), (Matrix{{3.5}}));
}

TEST(MarketFile, Symmetries) {
  EXPECT_EQ(read("coordinate real symmetric\n2 2 2\n1 1 1\n2 1 3\n"), (Matrix{{1.0, 3.0}, {3.0, 0.0}}));
  EXPECT_EQ(read("coordinate real symmetric\n2 2 2\n1 1 1\n1 2 3\n"), (Matrix{{1.0, 3.0}, {3.0, 0.0}}));
  EXPECT_EQ(read("coordinate integer skew-symmetric\n2 2 1\n2 1 3\n"), (Matrix{{0.0, -3.0}, {3.0, 0.0}}));
  EXPECT_EQ(read("coordinate pattern symmetric\n2 2 2\n2 1\n2 2\n"), (Matrix{{0.0, 1.0}, {1.0, 1.0}}));
  EXPECT_EQ(read("coordinate complex hermitian\n2 2 2\n2 1 3 0\n2 2 1 0.0\n"),
            (Matrix{{0.0, 3.0}, {3.0, 1.0}}));
}

TEST(MarketFile, Arrays) {
  EXPECT_EQ(read("array real general\n2 3\n1\n2\n3\n4\n5\n6\n"), (Matrix{{1.0, 3.0, 5.0}, {2.0, 4.0, 6.0}}));
  EXPECT_EQ(read("array real general\n2 2\n1 2\n3 4"), (Matrix{{1.0, 3.0}, {2.0, 4.0}}));
  EXPECT_EQ(read("array integer symmetric\n2 2\n1\n2\n3\n"), (Matrix{{1.0, 2.0}, {2.0, 3.0}}));
  EXPECT_EQ(read("array real skew-symmetric\n3 3\n1\n2\n3\n"),
            (Matrix{{0.0, -1.0, -2.0}, {1.0, 0.0, -3.0}, {2.0, 3.0, 0.0}}));
  EXPECT_EQ(read("array complex general\n1 2\n1 0\n2 0\n"), (Matrix{{1.0, 2.0}}));
}

TEST(MarketFile, CapitalsAndEndsOfLinesDoNotMatter) {
  EXPECT_EQ(read_whole("%%matrixmarket MATRIX Coordinate REAL General\r\n1 1 1\r\n1 1 4\r\n", "a"),
            (Matrix{{4.0}}));
}

/// Seventeen digits bring back the same number.
TEST(MarketFile, NumbersKeepAllBits) {
  EXPECT_EQ(read("array real general\n1 1\n0.10000000000000001\n")(0, 0), 0.1);
  EXPECT_EQ(read("array real general\n1 1\n4.9406564584124654e-324\n")(0, 0), 5e-324);
}

TEST(MarketFile, FaultsNameTheirLine) {
  const std::string banner = "%%MatrixMarket matrix coordinate real general\n";
  const std::string array = "%%MatrixMarket matrix array real general\n";
  const std::pair<std::string, const char*> faults[] = {
      {"%%MatrixMarket matrix coordinate real\n", "expected five words"},
      {"%%MatrixMarket vector coordinate real general\n", "expected five words"},
      {"%%MatrixMarket matrix dense real general\n", "expected coordinate or array, found 'dense'"},
      {"%%MatrixMarket matrix array pattern general\n", "an array cannot be a pattern"},
      {"%%MatrixMarket matrix array real hermitian\n", "cannot be hermitian"},
      {banner + "2 2\n", "a.mtx:2: expected rows, columns and number of entries, found 2 words"},
      {banner + "2 x 2\n", "expected a size, found 'x'"},
      {banner + "0 0 0\n", "the matrix is 0 x 0"},
      {array + "6000 6000\n1\n", "the matrix is 6000 x 6000; matrices of 1 to 5000 rows"},
      {banner + "2 2 1\n1 1 one\n", "expected a finite number, found 'one'"},
      {array + "1 2\n1\n", "the file ends before row 1 of column 2"},
      {array + "1 2\n1 2 3\n", "more numbers on the line"},
      {"%%MatrixMarket matrix coordinate complex general\n1 1 1\n1 1 1 2\n", "the matrix is complex"},
      {"%%MatrixMarket matrix coordinate complex hermitian\n1 1 1\n1 1 1\n", "expected 4 numbers"},
      {"%%MatrixMarket matrix coordinate real symmetric\n2 3 1\n1 1 1\n", "a symmetric matrix is square"},
      {"%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n1 2 1\n2 1 1\n",
       "both sides of the diagonal"},
      {"%%MatrixMarket matrix coordinate real skew-symmetric\n2 2 1\n1 1 1\n", "no entries on its diagonal"},
  };
  for (const auto& [text, expected] : faults)
    EXPECT_TRUE(test::contains(message(text), expected)) << message(text);
}

}  // namespace
}  // namespace eigentrail::test::market_file_test
