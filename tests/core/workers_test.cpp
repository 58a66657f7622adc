#include "eigentrail/core/workers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "eigentrail/core/errors.hpp"

namespace eigentrail::test::workers_test {
namespace {

TEST(Workers, ThreadsReturnResultsInOrder) {
  for (const int jobs : {1, 2, 5}) {
    Threads threads(jobs);
    EXPECT_EQ(threads.size(), static_cast<std::size_t>(jobs));
    std::size_t last = 0;
    const auto square = [](std::size_t i) { return std::to_string(i * i); };
    std::vector<std::size_t> numbers = numbers_to(17);
    std::reverse(numbers.begin(), numbers.end());
    const auto results = threads.compute(
        {"square", numbers, square}, [&](std::size_t done, std::size_t number, const std::string& result) {
          last = done;
          EXPECT_EQ(result, square(number));
        });
    ASSERT_EQ(results.size(), 17u);
    for (std::size_t i = 0; i < results.size(); ++i) EXPECT_EQ(results[i], square(numbers[i]));
    EXPECT_EQ(last, 17u);
  }
}

TEST(Workers, ErrorOfAPieceIsRethrown) {
  Threads threads(3);
  const auto fails = [](std::size_t i) { return i == 4 ? throw InputError("four") : std::string(); };
  EXPECT_THROW(threads.compute({"piece", numbers_to(9), fails}, [](auto...) {}), InputError);
}

TEST(Workers, PartsShareAllPiecesAndNoneTwice) {
  for (const std::size_t n : {0u, 1u, 7u, 40u}) {
    for (const int count : {1, 2, 3, 9}) {
      std::multiset<std::size_t> pieces;
      for (int number = 1; number <= count; ++number) {
        for (const std::size_t piece : Part{number, count}.pieces(n)) pieces.insert(piece);
      }
      ASSERT_EQ(pieces.size(), n);
      for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(pieces.count(i), 1u);
    }
  }
}

TEST(Workers, PartIsReadAsNumberAndCount) {
  const Part part = read_part("2/5");
  EXPECT_EQ(part.number, 2);
  EXPECT_EQ(part.count, 5);
  for (const char* text : {"", "2", "2/", "/5", "0/5", "6/5", "2/5/7", "2.0/5", "+2/5", "2/99999999999"})
    EXPECT_THROW(read_part(text), InputError) << text;
}

}  // namespace
}  // namespace eigentrail::test::workers_test
