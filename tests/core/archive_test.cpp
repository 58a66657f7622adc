// Conversion of values to bytes and back, and bytes that do not represent values.
#include "core/archive.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace eigentrail::test::archive_test {
namespace {

struct Item {
  int number = 0;
  std::string text;
  std::optional<double> maybe;

  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit(self.number, self.text, self.maybe);
  }
};

template <class... T>
std::string bytes_of(const T&... values) {
  ArchiveWriter archive;
  archive(values...);
  return archive.bytes();
}

template <class T>
T back(const T& value) {
  const std::string bytes = bytes_of(value);
  ArchiveReader archive(bytes);
  T result;
  archive(result);
  archive.finish();
  return result;
}

TEST(Archive, NumbersKeepEveryBit) {
  for (const double value : {0.0, -0.0, 1.0 / 3.0, std::numeric_limits<double>::denorm_min(),
                             std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(std::signbit(back(value)), std::signbit(value));
    EXPECT_EQ(back(value), value);
  }
  EXPECT_TRUE(std::isnan(back(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_EQ(back(Complex(1, -2)), Complex(1, -2));
}

TEST(Archive, ContainersComeBack) {
  const std::map<std::pair<int, std::size_t>, std::vector<bool>> map{{{1, 2}, {true, false}}, {{-1, 0}, {}}};
  EXPECT_EQ(back(map), map);
  const std::vector<Item> items = back(std::vector<Item>{{1, "one", 0.5}, {2, std::string("a\0b", 3), {}}});
  ASSERT_EQ(items.size(), 2u);
  EXPECT_EQ(items[0].maybe, 0.5);
  EXPECT_EQ(items[1].text.size(), 3u);
  EXPECT_FALSE(items[1].maybe);
}

TEST(Archive, MatricesComeBackWithTheirKind) {
  const Matrix dense = Matrix::Random(3, 5);
  EXPECT_EQ(back(dense), dense);
  EXPECT_EQ(back(Matrix(0, 4)).cols(), 4);
  EXPECT_EQ(back(Vector(Vector::Random(7))).size(), 7);
  SparseMatrix sparse(4, 3);
  sparse.insert(2, 1) = 0.25;
  sparse.insert(3, 2) = 0.0;  // an entry that is kept, though zero
  const SystemMatrix again = back(SystemMatrix(sparse));
  ASSERT_TRUE(again.is_sparse());
  EXPECT_EQ(again.sparse().nonZeros(), 2);
  EXPECT_EQ(again(2, 1), 0.25);
  EXPECT_FALSE(back(SystemMatrix(dense)).is_sparse());
}

template <class T>
void expect_no(const std::string& bytes) {
  ArchiveReader archive(bytes);
  T value;
  EXPECT_THROW(
      {
        archive(value);
        archive.finish();
      },
      ArchiveError);
}

TEST(Archive, CountsBeyondTheBytesAreRefusedBeforeMemoryIsAskedFor) {
  const std::string huge = bytes_of(std::uint64_t{1} << 60U);
  expect_no<std::string>(huge);
  expect_no<std::vector<double>>(huge);
  expect_no<std::vector<bool>>(huge);
  expect_no<std::map<int, int>>(huge);
  expect_no<Matrix>(bytes_of(std::int64_t{1} << 29, std::int64_t{1} << 29));
  expect_no<Matrix>(bytes_of(std::int64_t{-1}, std::int64_t{1}));
  expect_no<Vector>(bytes_of(std::int64_t{2}, std::int64_t{2}, 1.0, 2.0, 3.0, 4.0));
  expect_no<SystemMatrix>(bytes_of(true, std::int64_t{2}, std::int64_t{2}, std::uint64_t{1}, std::int64_t{2},
                                   std::int64_t{0}, 1.0));
}

TEST(Archive, TooFewOrTooManyBytesAreRefused) {
  const std::string bytes = bytes_of(Item{3, "three", 0.1});
  for (std::size_t size = 0; size < bytes.size(); ++size) expect_no<Item>(bytes.substr(0, size));
  expect_no<Item>(bytes + '\0');
  expect_no<bool>("\2");
}

}  // namespace
}  // namespace eigentrail::test::archive_test
