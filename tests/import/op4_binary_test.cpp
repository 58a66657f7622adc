// OUTPUT4 in binary form.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "import/op4.hpp"
#include "scene/input_error.hpp"

namespace eigentrail::test::op4_binary_test {
namespace {

/// Writes files of all variants.
struct Writer {
  bool swapped = false;
  std::size_t word = 4;  ///< bytes
  bool single = false;
  int strings = 0;  ///< 0: dense columns, 1: packed strings, 2: bigmat

  template <class T>
  std::string bytes(T value) const {
    std::string text(sizeof value, '\0');
    std::memcpy(text.data(), &value, sizeof value);
    if (swapped) std::reverse(text.begin(), text.end());
    return text;
  }
  std::string whole(std::int64_t value) const {
    return word == 4 ? bytes(static_cast<std::int32_t>(value)) : bytes(value);
  }
  std::string number(double value) const {
    return single && word == 4 ? bytes(static_cast<float>(value)) : bytes(value);
  }
  std::string record(const std::string& content) const {
    const std::string marker = bytes(static_cast<std::int32_t>(content.size()));
    return marker + content + marker;
  }
  std::string header(const std::string& name, std::int64_t rows, std::int64_t columns, int type) const {
    std::string padded = name;
    padded.resize(2 * word, ' ');
    return record(whole(columns) + whole(rows) + whole(1) + whole(type) + padded);
  }
  std::string column(std::int64_t c, std::int64_t row, const std::string& data) const {
    return record(whole(c) + whole(row) + whole(static_cast<std::int64_t>(data.size() / word)) + data);
  }
  std::string string_of(std::int64_t row, const std::vector<double>& numbers) const {
    std::string data;
    for (const double x : numbers) data += number(x);
    const auto length = static_cast<std::int64_t>(data.size() / word) + 1;
    return (strings == 2 ? whole(length) + whole(row) : whole(length * 65536 + row)) + data;
  }
  /// The matrix `expected` below.
  std::string file() const {
    std::string text = header("KAA", strings == 2 ? -3 : 3, 3, single ? 1 : 2);
    if (strings == 0) {
      text += column(1, 1, number(1.0) + number(3.0) + number(0.5));
      text += column(2, 1, number(-2.0) + number(0.0) + number(4.0));
    } else {
      text += column(1, 0, string_of(1, {1.0, 3.0, 0.5}));
      text += column(2, 0, string_of(1, {-2.0}) + string_of(3, {4.0}));
    }
    return text + column(4, 1, number(1.0));
  }
};

const Matrix expected{{1.0, -2.0, 0.0}, {3.0, 0.0, 0.0}, {0.5, 4.0, 0.0}};

std::vector<Op4Matrix> read(const std::string& bytes) {
  return parse_op4(bytes, "a.op4", [](const std::string&) { return true; });
}

std::string message(const std::string& bytes) {
  return test::input_error([&] { read(bytes); });
}

TEST(Op4Binary, AllVariantsHoldTheSameMatrix) {
  for (const bool swapped : {false, true}) {
    for (const std::size_t word : {4, 8}) {
      for (const bool single : {false, true}) {
        for (const int strings : {0, 1, 2}) {
          const auto matrices = read(Writer{swapped, word, single, strings}.file());
          ASSERT_EQ(matrices.size(), 1u);
          EXPECT_EQ(matrices[0].name, "KAA");
          EXPECT_EQ(matrices[0].values, expected) << swapped << word << single << strings;
          EXPECT_EQ(matrices[0].single, single);
        }
      }
    }
  }
}

TEST(Op4Binary, NumbersKeepAllBits) {
  const Writer writer;
  const std::string bytes = writer.header("K", 1, 1, 2) + writer.column(1, 1, writer.number(0.1)) +
                            writer.column(2, 1, writer.number(1.0));
  EXPECT_EQ(read(bytes)[0].values(0, 0), 0.1);
}

TEST(Op4Binary, SeveralMatrices) {
  const Writer writer;
  const std::string complex = writer.header("ZAA", 1, 1, 4) +
                              writer.column(1, 1, writer.number(1) + writer.number(2)) +
                              writer.column(2, 1, writer.number(1.0));
  const auto matrices = read(complex + writer.file());
  ASSERT_EQ(matrices.size(), 2u);
  EXPECT_EQ(matrices[0].fault, "is complex (type 4); expected real numbers");
  EXPECT_EQ(matrices[1].values, expected);
}

TEST(Op4Binary, EveryCutIsNoticed) {
  for (const int strings : {0, 1, 2}) {
    const std::string whole = Writer{false, 4, false, strings}.file();
    for (std::size_t size = 4; size < whole.size(); ++size)
      EXPECT_TRUE(test::contains(message(whole.substr(0, size)), "a.op4: ")) << size;
  }
}

TEST(Op4Binary, FaultsNameTheirPlace) {
  const Writer w;
  const Writer big{false, 4, false, 2};
  const std::string last = w.column(2, 1, w.number(1.0));
  const auto one = [&](const std::string& column) { return w.header("K", 1, 1, 2) + column + last; };
  std::string other_length = w.file();
  other_length[28] = 25;  // behind the first record
  const std::pair<std::string, const char*> faults[] = {
      {std::string("\0\0\0", 3), "ends within its first record"},
      {"\x89PNG\r\n\x1a\n" + std::string(50, '\0'), "is no file of Nastran's OUTPUT4"},
      {w.header("K", 0, 1, 2), "no header of a matrix"},
      {w.header("K", 1, 1, 7), "no header of a matrix"},
      {w.header("K", 1, 1, 2), "matrix K, the file ends between two records"},
      {one(w.column(1, 2, w.number(1.0))), "column 1: 1 numbers from row 2 on; the matrix has 1 rows"},
      {one(w.column(1, 1, w.number(1.0) + w.number(1.0))), "2 numbers from row 1 on"},
      {one(w.column(1, 1, w.whole(5))), "a number has one word only"},
      {one(w.column(1, -1, w.number(1.0))), "expected row and number of words"},
      {one(w.record(w.whole(1) + w.whole(1) + w.whole(9) + w.number(1.0))), "9 words announced and 2 there"},
      {one(w.record(w.whole(1) + w.whole(1) + w.whole(-1))), "-1 words announced"},
      {one(w.record(w.whole(1))), "a record ends too early"},
      {one(w.column(5, 1, w.number(1.0))), "a record of column 5 of 1 follows"},
      {one(w.column(1, 0, w.whole(1))), "expected the length and the first row of a string"},
      {one(w.column(1, 0, w.whole(9 * 65536 + 1) + w.number(1.0))),
       "expected the length and the first row of a string"},
      {one(w.column(1, 0, w.whole(3 * 65536 + 2) + w.number(1.0))), "1 numbers from row 2 on"},
      {w.header("K", -1, 1, 2) + big.column(1, 0, big.whole(3)) + last, "a record ends too early"},
      {w.header("K", -1, 1, 2) + big.column(1, 0, big.whole(INT32_MAX) + big.whole(1)) + last,
       "expected the length and the first row of a string"},
  };
  for (const auto& [bytes, part] : faults)
    EXPECT_TRUE(test::contains(message(bytes), part)) << part << ": " << message(bytes);
}

TEST(Op4Binary, HugeSizesTakeNoMemory) {
  const Writer writer{false, 8, false, 0};
  const auto matrices = read(writer.header("K", 900'000'000, 900'000'000, 2) +
                             writer.column(900'000'001, 1, writer.number(1.0)));
  EXPECT_EQ(matrices[0].values.size(), 0);
  EXPECT_TRUE(test::contains(matrices[0].fault, "has 900000000 rows"));
  EXPECT_TRUE(test::contains(message(writer.header("K", INT64_MAX, INT64_MAX, 2)), "no header of a matrix"));
}

}  // namespace
}  // namespace eigentrail::test::op4_binary_test
