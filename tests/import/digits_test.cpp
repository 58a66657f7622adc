// Significant digits of samples.
#include "import/samples.hpp"

#include <gtest/gtest.h>

#include <charconv>
#include <random>

#include "scene/input_error.hpp"

namespace eigentrail::test::digits_test {
namespace {

SampledData random_samples(int n) {
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> number(-5.0, 5.0);
  SampledData data;
  data.values = {0.0};
  data.A = {Matrix(n, n)};
  for (double& x : data.A[0].reshaped()) x = number(engine);
  return data;
}

double rounded(double x, int digits) {
  std::array<char, 40> text{};
  const auto end = std::to_chars(text.begin(), text.end(), x, std::chars_format::scientific, digits - 1).ptr;
  std::from_chars(text.data(), end, x);
  return x;
}

TEST(Digits, OfRoundedEntriesAreFound) {
  for (int digits = 3; digits <= 7; ++digits) {
    SampledData data = random_samples(8);
    for (double& x : data.A[0].reshaped()) x = rounded(x, digits);
    EXPECT_EQ(digits_of(data), digits);
  }
}

TEST(Digits, OneExactEntryIsEnoughToTellThatTheOthersAreNotRounded) {
  SampledData data = random_samples(8);
  for (double& x : data.A[0].reshaped()) x = rounded(x, 5);
  data.A[0](3, 4) = 1.0 / 3.0;
  EXPECT_EQ(digits_of(data), std::nullopt);
}

TEST(Digits, FullPrecisionHasNone) {
  EXPECT_EQ(digits_of(random_samples(8)), std::nullopt);
}

TEST(Digits, TooFewEntriesTellNothing) {
  SampledData data = random_samples(3);
  for (double& x : data.A[0].reshaped()) x = rounded(x, 5);
  EXPECT_EQ(digits_of(data), std::nullopt);
}

/// Numbers that somebody typed have all kinds of lengths.
TEST(Digits, TypedMatricesAreExact) {
  SampledData data = random_samples(8);
  int i = 0;
  for (double& x : data.A[0].reshaped()) x = rounded(x, 1 + i++ % 4);
  EXPECT_EQ(digits_of(data), std::nullopt);
  for (double& x : data.A[0].reshaped()) x = std::round(x);
  EXPECT_EQ(digits_of(data), std::nullopt);
}

TEST(Digits, Option) {
  SampledData data = random_samples(8);
  EXPECT_EQ(note_digits(data, {}), "");
  EXPECT_EQ(note_digits(data, {{"digits", "6"}}), "6 significant digits");
  EXPECT_EQ(data.digits, 6);
  EXPECT_EQ(note_digits(data, {{"digits", "all"}}, 5), "");
  EXPECT_EQ(data.digits, std::nullopt);
  note_digits(data, {}, 5);
  EXPECT_EQ(data.digits, 5);
  for (const char* text : {"0", "18", "six", "", "6.5"}) {
    const std::string message = test::input_error([&] { note_digits(data, {{"digits", text}}); });
    EXPECT_TRUE(test::contains(message, "--digits: expected a whole number from 1 to 17, or all")) << message;
  }
}

}  // namespace
}  // namespace eigentrail::test::digits_test
