#include "eigentrail/modes/mode_choice.hpp"

#include <gtest/gtest.h>

namespace eigentrail::test::mode_choice_test {
namespace {

/// Real eigenvalues that crowd out the oscillatory ones, a heavily damped pair, and three lightly damped
/// ones.
std::vector<StartingMode> spectrum() {
  std::vector<StartingMode> modes;
  for (const Complex s : {Complex(-0.1, 0), Complex(-0.2, 0), Complex(-0.5, 1), Complex(-3, 1),
                          Complex(-0.1, 5), Complex(-0.1, 20)})
    modes.push_back({s, {}});
  return modes;
}

std::vector<Complex> chosen(const ModeChoice& choice) {
  std::vector<StartingMode> modes = spectrum();
  const int count = choose_modes(choice, modes);
  EXPECT_EQ(modes.size(), 6u);
  std::vector<Complex> s;
  for (int i = 0; i < count; ++i) s.push_back(modes[static_cast<std::size_t>(i)].s);
  return s;
}

TEST(ModeChoice, NothingSaidIsAll) {
  EXPECT_TRUE(ModeChoice().is_all());
  EXPECT_EQ(chosen({}).size(), 6u);
  EXPECT_EQ(text_of({}), "all");
}

TEST(ModeChoice, CountTakesTheLowest) {
  EXPECT_EQ(chosen({.count = 2}), (std::vector<Complex>{-0.1, -0.2}));
  EXPECT_EQ(chosen({.count = 99}).size(), 6u);
  EXPECT_EQ(text_of({.count = 2}), "2");
}

TEST(ModeChoice, BandLeavesOutRealRootsAndOtherFrequencies) {
  EXPECT_EQ(chosen({.band = FrequencyBand{1, 6}}), (std::vector<Complex>{{-0.5, 1}, {-3, 1}, {-0.1, 5}}));
  EXPECT_EQ(chosen({.count = 1, .band = FrequencyBand{1, 6}}), (std::vector<Complex>{{-0.5, 1}}));
}

TEST(ModeChoice, DampingLeavesOutWhatIsDampedMore) {
  EXPECT_EQ(chosen({.damping_below = 0.5}), (std::vector<Complex>{{-0.5, 1}, {-0.1, 5}, {-0.1, 20}}));
  EXPECT_TRUE(ModeChoice{.damping_below = 0.5}.wants(0.3)) << "real roots that grow have a ratio of -1";
}

TEST(ModeChoice, NearTakesTheNearestAndKeepsTheOrderOfMagnitude) {
  EXPECT_EQ(chosen({.count = 2, .near = 18.0}), (std::vector<Complex>{{-0.1, 5}, {-0.1, 20}}));
  EXPECT_EQ(chosen({.count = 2, .near = 0.9}), (std::vector<Complex>{{-0.1, 0}, {-0.5, 1}}));
}

TEST(ModeChoice, WhereNothingIsWantedTheNearestIsTaken) {
  EXPECT_EQ(chosen({.band = FrequencyBand{7, 9}}), (std::vector<Complex>{{-0.1, 5}}));
  EXPECT_EQ(chosen({.damping_below = -0.9}), (std::vector<Complex>{{-0.1, 20}}));
  std::vector<StartingMode> none;
  EXPECT_EQ(choose_modes({.count = 3}, none), 0);
}

TEST(ModeChoice, OnlyChoicesWithoutACountMayGrow) {
  EXPECT_FALSE(ModeChoice().may_grow());
  EXPECT_FALSE((ModeChoice{.count = 3, .band = FrequencyBand{1, 6}}.may_grow()));
  EXPECT_TRUE((ModeChoice{.band = FrequencyBand{1, 6}}.may_grow()));
}

TEST(ModeChoice, TextAndWords) {
  const ModeChoice choice{.count = 12, .band = FrequencyBand{0.5, 20}, .damping_below = 0.9, .near = 3.0};
  EXPECT_EQ(text_of(choice), "count = 12, band = [0.5, 20], damping_below = 0.9, near = 3");
  EXPECT_EQ(
      in_words(choice),
      "the 12 modes nearest to 3 rad/s with Im s between 0.5 and 20 rad/s and a damping ratio below 0.9");
}

}  // namespace
}  // namespace eigentrail::test::mode_choice_test
