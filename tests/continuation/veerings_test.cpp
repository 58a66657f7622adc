// Veerings of single modes on a step: their place and half-width against closed forms.
#include "continuation/events/veerings.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/planted_search.hpp"

namespace eigentrail::test {
namespace {

/// Frequencies 2 -+ hypot(p - at, eps).
struct Veering {
  Veering(double place, double half_width)
      : at(place),
        eps(half_width),
        planted(Planted::frequencies({Matrix{{2.0 - place, half_width}, {half_width, 2.0 + place}},
                                      Matrix{{1.0, 0.0}, {0.0, -1.0}}})) {}
  std::vector<Together> modes(double p) const {
    const double half = std::hypot(p - at, eps);
    return alone({(2.0 - half) * j, (2.0 + half) * j});
  }
  FoundEvents find(double from, double to) {
    const PathNode left = planted.family.point(from, modes(from));
    return find_veerings(planted.search, planted.step(left, to, modes(to)));
  }
  double at, eps;
  PlantedSearch planted;
};

TEST(FindVeerings, GivesPlaceAndHalfWidth) {
  for (const double eps : {0.1, 0.03}) {
    Veering veering(0.05, eps);
    const FoundEvents found = veering.find(0.0, 0.12);
    ASSERT_EQ(found.events.size(), 1U) << eps;
    const Event& event = found.events[0];
    EXPECT_EQ(event.kind, EventKind::veering);
    EXPECT_NEAR(event.p, 0.05, 1e-9);
    EXPECT_NEAR(event.half_width, eps, 1e-9);
    EXPECT_NEAR(std::abs(event.s - 2.0 * j), 0.0, 1e-9) << "the mean";
    EXPECT_EQ(event.modes, (std::vector<int>{0, 1}));
  }
}

TEST(FindVeerings, DoesSoAgainstTheDirectionOfTheParameter) {
  Veering veering(0.05, 0.05);
  const FoundEvents found = veering.find(0.12, 0.0);
  ASSERT_EQ(found.events.size(), 1U);
  EXPECT_NEAR(found.events[0].p, 0.05, 1e-9);
}

TEST(FindVeerings, LeavesOutWhatIsFarFromTheStepOrTooWide) {
  Veering far(0.5, 0.05);
  EXPECT_TRUE(far.find(0.0, 0.12).events.empty());
  Veering wide(0.05, 1.0);
  EXPECT_TRUE(wide.find(0.0, 0.12).events.empty());
}

TEST(FindVeerings, DoesNotLocateAgainWhatIsRecorded) {
  Veering veering(0.05, 0.05);
  FoundEvents found = veering.find(0.0, 0.12);
  ASSERT_EQ(found.events.size(), 1U);
  veering.planted.events = found.events;
  EXPECT_TRUE(veering.find(0.0, 0.12).events.empty());
}

/// Modes that have nothing to do with each other cross; that is no veering.
TEST(FindVeerings, OfUncoupledModesAreNone) {
  PlantedSearch planted(Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.1, -1.0}})));
  const PathNode left = planted.family.point(0.0, alone({2.0 * j, 2.1 * j}));
  const FoundEvents found = find_veerings(planted.search, planted.step(left, 0.1, alone({2.1 * j, 2.0 * j})));
  EXPECT_TRUE(found.events.empty());
}

}  // namespace
}  // namespace eigentrail::test
