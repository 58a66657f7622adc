// Arrays in NumPy's format.
#include "import/npy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "scene/input_error.hpp"

namespace eigentrail::test::npy_test {
namespace {

std::string npy(const std::string& descr, const std::string& shape, const std::string& data,
                bool fortran = false, int version = 1) {
  std::string header = "{'descr': '" + descr + "', 'fortran_order': " + (fortran ? "True" : "False") +
                       ", 'shape': " + shape + ", }\n";
  std::string result = "\x93NUMPY";
  result += static_cast<char>(version);
  result += '\0';
  for (int i = 0; i < (version == 1 ? 2 : 4); ++i)
    result += static_cast<char>((header.size() >> (8 * i)) & 0xFFU);
  return result + header + data;
}

template <class T>
std::string bytes(const std::vector<T>& values, bool swapped = false) {
  std::string result;
  for (const T value : values) {
    std::string one(sizeof value, '\0');
    std::memcpy(one.data(), &value, sizeof value);
    if (swapped) std::reverse(one.begin(), one.end());
    result += one;
  }
  return result;
}

std::string message(const std::string& array) {
  return test::input_error([&] { read_npy(array, "a.npz: array A"); });
}

TEST(Npy, NumbersOfEveryType) {
  const std::vector<double> expected{1.0, 2.0, 3.0};
  EXPECT_EQ(read_npy(npy("<f8", "(3,)", bytes<double>({1, 2, 3})), "a").numbers, expected);
  EXPECT_EQ(read_npy(npy(">f8", "(3,)", bytes<double>({1, 2, 3}, true)), "a").numbers, expected);
  EXPECT_EQ(read_npy(npy("<f4", "(3,)", bytes<float>({1, 2, 3})), "a").numbers, expected);
  EXPECT_EQ(read_npy(npy("|i1", "(3,)", bytes<std::int8_t>({1, 2, 3})), "a").numbers, expected);
  EXPECT_EQ(read_npy(npy("<u2", "(3,)", bytes<std::uint16_t>({1, 2, 3})), "a").numbers, expected);
  EXPECT_EQ(read_npy(npy(">i4", "(3,)", bytes<std::int32_t>({1, 2, 3}, true)), "a").numbers, expected);
  EXPECT_EQ(read_npy(npy("<i8", "(3,)", bytes<std::int64_t>({1, 2, 3})), "a").numbers, expected);
  EXPECT_EQ(read_npy(npy("|b1", "(2,)", bytes<std::int8_t>({1, 0})), "a").numbers,
            (std::vector<double>{1.0, 0.0}));
  EXPECT_EQ(read_npy(npy("<i8", "(1,)", bytes<std::int64_t>({-5})), "a").numbers[0], -5.0);
}

TEST(Npy, Orders) {
  const NamedArray c = read_npy(npy("<f8", "(2, 3)", bytes<double>({1, 2, 3, 4, 5, 6})), "a");
  EXPECT_EQ(c.strides, (std::vector<std::size_t>{3, 1}));
  const NamedArray fortran = read_npy(npy("<f8", "(2, 3)", bytes<double>({1, 2, 3, 4, 5, 6}), true), "a");
  EXPECT_EQ(fortran.strides, (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(read_npy(npy("<f8", "()", bytes<double>({7})), "a").size(), 1u);
}

TEST(Npy, LaterVersions) {
  for (const int version : {2, 3})
    EXPECT_EQ(read_npy(npy("<f8", "(1,)", bytes<double>({7}), false, version), "a").numbers[0], 7.0);
}

TEST(Npy, Texts) {
  EXPECT_EQ(read_npy(npy("|S4", "(2,)", std::string("flapab\0\0", 8)), "a").texts,
            (std::vector<std::string>{"flap", "ab"}));
  EXPECT_EQ(read_npy(npy("<U2", "(1,)", bytes<std::uint32_t>({0x3B1, 0x1F600})), "a").texts[0],
            "\xce\xb1\xf0\x9f\x98\x80");
}

TEST(Npy, FaultsNameTheArray) {
  const std::string good = bytes<double>({1, 2, 3});
  const std::pair<std::string, const char*> faults[] = {
      {npy("<f8", "(3,)", good, false, 9), "version 9 of NumPy's format"},
      {npy("<f8", "(3,)", good + "x"), "has 25 bytes of data"},
      {npy("<f8", "(99999999999999999999999,)", good), "its shape cannot be read"},
      {npy("<f8", "3", good), "its shape cannot be read"},
      {npy("<f8", "(1,1,1,1,1,1,1,1,1)", good), "its shape cannot be read"},
      {npy("<f16", "(3,)", good + good), "known: f4, f8"},
      {npy("<M8", "(3,)", good), "known: f4, f8"},
      {npy("<U999999999", "(0,)", ""), "known: f4, f8"},
      {npy("<f99999999999999999999", "(3,)", good), "unknown type"},
      {npy("", "(3,)", good), "elements of several fields"},
  };
  for (const auto& [array, part] : faults)
    EXPECT_TRUE(test::contains(message(array), part)) << part << ": " << message(array);
}

}  // namespace
}  // namespace eigentrail::test::npy_test
