// Veerings of single modes on a step: their place and half-width against closed forms.
#include "continuation/events/veerings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "continuation/planted_search.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::veerings_test {
namespace {

/// Modes that have nothing to do with each other cross; that is no veering.
TEST(FindVeerings, OfUncoupledModesAreNone) {
  PlantedSearch planted(Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.1, -1.0}})));
  const PathNode left = planted.family.point(0.0, alone({2.0 * j, 2.1 * j}));
  const FoundEvents found = find_veerings(planted.search, planted.step(left, 0.1, alone({2.1 * j, 2.0 * j})));
  EXPECT_TRUE(found.events.empty());
}

/// W = [w + a p, e; e, v + b p]: the exceptional points are at (v - w +- 2 e j) / (a - b).
struct Sloping {
  explicit Sloping(double coupling)
      : e(coupling),
        planted(Planted::frequencies({Matrix{{2.0, e}, {e, 2.1}}, Matrix{{a, 0.0}, {0.0, b}}})) {}
  std::vector<Complex> at(double p) const {
    const double mean = 0.5 * (4.1 + (a + b) * p);
    const double half = std::hypot(0.5 * (-0.1 + (a - b) * p), e);
    return {(mean - half) * j, (mean + half) * j};
  }
  FoundEvents find(double from, double to, bool as_block) {
    const auto tracks = [&](double p) { return as_block ? std::vector<Together>{{at(p)}} : alone(at(p)); };
    const PathNode left = planted.family.point(from, tracks(from));
    return find_veerings(planted.search, planted.step(left, to, tracks(to)));
  }
  static constexpr double a = 1.5, b = -0.5, place = 0.05;
  double e;
  PlantedSearch planted;
};

TEST(FindVeerings, OfABlockAreThoseOfItsModesAlone) {
  for (const bool as_block : {false, true}) {
    Sloping sloping(0.015);
    const FoundEvents found = sloping.find(0.0, 0.09, as_block);
    ASSERT_EQ(found.events.size(), 1U) << as_block;
    const Event& event = found.events[0];
    EXPECT_NEAR(event.p, Sloping::place, 1e-9);
    EXPECT_NEAR(event.half_width, 0.015, 1e-9);
    EXPECT_LT(std::abs(event.s - 2.075 * j), 1e-9);
    // The mean moves by (a + b) / 2; the place of the exceptional point is complex.
    EXPECT_LT(std::abs(event.sensitivity[0] - 0.5 * j), 1e-7);
    EXPECT_TRUE(std::isnan(event.shift[0]));
  }
}

TEST(FindVeerings, DoesNotLocateAgainWhatIsRecorded) {
  Sloping sloping(0.015);
  FoundEvents found = sloping.find(0.09, 0.0, false);
  ASSERT_EQ(found.events.size(), 1U);
  sloping.planted.events = found.events;
  EXPECT_TRUE(sloping.find(0.0, 0.09, false).events.empty());
}

/// Down to where a step would end on them, at 3e-3 of its length.
TEST(FindVeerings, FindsNarrowOnesBetweenTheirPoints) {
  for (const double e : {1e-3, 3e-4}) {
    Sloping sloping(e);
    const FoundEvents found = sloping.find(0.0, 0.09, true);
    ASSERT_EQ(found.events.size(), 1U) << e;
    EXPECT_NEAR(found.events[0].p, Sloping::place, 1e-9);
    EXPECT_NEAR(found.events[0].half_width, e, 1e-9);
  }
}

/// The largest half-width is a share of the range.
TEST(FindVeerings, EndAtTheLargestHalfWidth) {
  const double widest = 2.0 * Thresholds{}.veering.widest;
  Sloping within(0.99 * widest);
  EXPECT_EQ(within.find(-0.1, 0.2, false).events.size(), 1U);
  Sloping beyond(1.01 * widest);
  EXPECT_TRUE(beyond.find(-0.1, 0.2, false).events.empty());
}

/// Places outside the range of the parameter belong to nobody.
TEST(FindVeerings, EndAtTheEndsOfTheRange) {
  Sloping sloping(0.015);
  PathRange& range = sloping.planted.frame.range;
  range = {range.traced, Sloping::place + 1e-3, Sloping::place + 2.0};
  const FoundEvents found = sloping.find(0.0, 0.09, true);
  EXPECT_TRUE(found.events.empty());
}

/// (s^2 + c s + 1 + p) (s^2 + 1 - p) = e^2: one of the two modes is damped. Exceptional points near s = i are
/// at p = -i c / 2 +- i e, but for terms of c^2 and c e^2: on both sides of the real axis, and no mirror
/// images of each other.
TEST(FindVeerings, OnBothSidesOfTheAxisAreTwoUnlessTheyAreMirrorImages) {
  for (const auto& [e, c] : {std::pair{5e-3, 1e-5}, {5e-3, 2e-7}, {9e-3, 1e-6}, {5e-3, 0.0}}) {
    SCOPED_TRACE(testing::Message() << "e " << e << ", c " << c);
    std::ostringstream scene;
    scene.precision(17);
    scene << "[trace]\nparameter = \"p\"\nfrom = -0.5\nto = 0.5\n[matrix_family]\nM = [[[1, 0], [0, 1]]]\n"
          << "C = [[[" << c << ", 0], [0, 0]]]\nK = [[[1, " << e << "], [" << e
          << ", 1]], [[1, 0], [0, -1]]]\n";
    std::vector<double> half_widths;
    for (const Event& event : events_of(record_trace(make_setting(scene.str())).result, EventKind::veering)) {
      half_widths.push_back(event.half_width);
      EXPECT_NEAR(event.p, 0.0, 1e-9);
    }
    std::sort(half_widths.begin(), half_widths.end());
    const auto expected = c > 0.0 ? std::vector{e - 0.5 * c, e + 0.5 * c} : std::vector{e};
    ASSERT_EQ(half_widths.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(half_widths[i], expected[i], 1e-9);
  }
}

/// K = 4 -+ (f^2 + c^2)^(1/2) with f = exp(-(p/w)^2) - 1/2: exceptional points at p^2 = -w^2 log(1/2 +- i c).
/// Those farther from the axis than the series tell are left out, and none is at another place.
TEST(FindVeerings, ThatTheSeriesDoNotTellAreNotListed) {
  constexpr double w = 0.04;
  for (const auto& [c, are_told] : {std::pair{1e-3, true}, {0.4, false}}) {
    std::ostringstream scene;
    scene << "[trace]\nparameter = \"p\"\nfrom = -1\nto = 1\n[matrix_family]\nM = [[[1, 0], [0, 1]]]\n"
          << "K = [[[\"4 + exp(-625*p^2) - 0.5\", " << c << "], [" << c << ", \"4.5 - exp(-625*p^2)\"]]]\n";
    const Complex place = w * std::sqrt(-std::log(Complex(0.5, c)));
    const std::vector<Event> listed =
        events_of(record_trace(make_setting(scene.str())).result, EventKind::veering);
    EXPECT_EQ(listed.size(), are_told ? 2U : 0U);
    for (const Event& event : listed) {
      EXPECT_NEAR(std::abs(event.p), place.real(), 2e-7);
      EXPECT_NEAR(event.half_width, std::abs(place.imag()), 2e-7);
    }
  }
}

/// A rough trace needs none, and does not look for them.
TEST(FindVeerings, IsLeftOutWhereTheOptionsSaySo) {
  Setting setting = make_setting(
      "[trace]\nparameter = \"p\"\nfrom = -1\nto = 1\n[matrix_family]\nM = [ [[1, 0], [0, 1]] ]\n"
      "K = [ [[4, 0.02], [0.02, 4]], [[1, 0], [0, -1]] ]\n");
  const auto veerings = [&] { return events_of(record_trace(setting).result, EventKind::veering).size(); };
  EXPECT_EQ(veerings(), 1U);
  setting.options.events.veerings = false;
  EXPECT_EQ(veerings(), 0U);
}

}  // namespace
}  // namespace eigentrail::test::veerings_test
