#include "eigentrail/core/errors.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace eigentrail::test::errors_test {
namespace {

const std::vector<std::string> names = {"length", "mass", "stiffness", "k"};

TEST(NearestName, IsTheOneWithTheFewestEdits) {
  struct Row {
    std::string name, nearest, why;
  };
  const std::vector<Row> table = {{"lenght", "length", "two letters exchanged"},
                                  {"mas", "mass", "letter missing"},
                                  {"masss", "mass", "letter too many"},
                                  {"stifness", "stiffness", "letter missing in the middle"},
                                  {"Mass", "mass", "capital letter"},
                                  {"mass", "mass", "the name itself"},
                                  {"K", "k", "single letter"}};
  for (const Row& row : table) EXPECT_EQ(nearest_name(row.name, names), row.nearest) << row.why;
}

TEST(IsMisprint, IsAUsualTypingError) {
  for (const auto& [name, known] :
       {std::pair("stiffnes", "stiffness"), std::pair("dampping", "damping"), std::pair("Omega", "omega"),
        std::pair("lenght", "length"), std::pair("mas_1", "mass_1")})
    EXPECT_TRUE(is_misprint(name, known)) << name;
  for (const auto& [name, known] :
       {std::pair("k1", "k2"), std::pair("mass1", "mass2"), std::pair("mass", "mass2"),
        std::pair("stiff_x", "stiff_y"), std::pair("mass", "mass"), std::pair("rho", "rhoo"),
        std::pair("mass12", "mass21"), std::pair("drag", "mass")})
    EXPECT_FALSE(is_misprint(name, known)) << name;
}

TEST(NearestName, IsEmptyWhenNothingIsClose) {
  EXPECT_EQ(nearest_name("temperature", names), "");
  EXPECT_EQ(nearest_name("zz", names), "");
  EXPECT_EQ(nearest_name("mass", {}), "");
}

TEST(NearestName, AllowsMoreEditsInLongerNames) {
  EXPECT_EQ(nearest_name("xy", {"ab"}), "");
  EXPECT_EQ(nearest_name("K", {"M"}), "") << "no letter is left";
  EXPECT_EQ(nearest_name("stixxess", {"stiffness"}), "stiffness") << "three edits of eight letters";
  EXPECT_EQ(nearest_name("stixxxss", {"stiffness"}), "") << "four edits are too many";
}

TEST(NearestName, PrefersTheCloserOfTwoCandidatesWhateverTheirOrder) {
  // A simpler rule would suggest the first candidate that is close enough.
  EXPECT_EQ(nearest_name("spring_", {"sprint", "spring"}), "spring");
  EXPECT_EQ(nearest_name("spring_", {"spring", "sprint"}), "spring");
}

TEST(Suggestion, AsksForTheNearestName) {
  EXPECT_EQ(suggestion("lenght", names), "did you mean 'length'?");
}

TEST(Suggestion, ListsTheKnownNamesWhenNoneIsClose) {
  EXPECT_EQ(suggestion("temperature", names), "known: length, mass, stiffness, k");
}

TEST(Suggestion, SaysSoWhenNothingIsKnown) {
  EXPECT_EQ(suggestion("temperature", {}), "none is known here");
}

}  // namespace
}  // namespace eigentrail::test::errors_test
