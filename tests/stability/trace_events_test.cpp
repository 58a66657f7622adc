// Special points of traces against closed forms, and their sensitivities against differences.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "eigentrail/core/text.hpp"
#include "hard_cases/catalogue.hpp"
#include "scene/input_error.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::trace_events_test {
namespace {

/// x'' + c x' + k x = 0 with c = c0 + c1 p + c2 p^2; the damping ratio is c / (2 sqrt(k)).
struct Oscillator {
  double c0 = 0.0, c1 = 0.0, c2 = 0.0, k = 4.0;
  double from = -1.0, to = 1.0;
  std::string events = "";  ///< keys of [events]
  OptionTexts options = {};
};

Setting oscillator(const Oscillator& o) {
  const auto text = [](double x) { return exact_text(x); };
  return make_setting("[parameters]\np = 0.0\nc0 = " + text(o.c0) + "\nk = " + text(o.k) +
                          "\n[trace]\nparameter = \"p\"\nfrom = " + text(o.from) + "\nto = " + text(o.to) +
                          "\n[events]\n" + o.events + "\n[matrix_family]\nM = [[[1]]]\nC = [[[\"c0\"]], [[" +
                          text(o.c1) + "]], [[" + text(o.c2) + "]]]\nK = [[[\"k\"]]]\n",
                      o.options);
}

std::vector<Event> events_of(const Setting& setting, EventKind kind) {
  return test::events_of(completed_trace(setting).result, kind);
}

constexpr double located = 1e-10;

TEST(TraceEvents, FindARequiredDampingRatio) {
  // c = 0.1 + 0.2 p: 0.03 at p = 0.1, 0.07 at p = 0.9.
  for (const bool reversed : {false, true}) {
    Oscillator o{.c0 = 0.1, .c1 = 0.2, .events = "damping_ratio = [0.03, 0.07]"};
    if (reversed) std::swap(o.from, o.to);
    const auto events = events_of(oscillator(o), EventKind::damping_ratio);
    ASSERT_EQ(events.size(), 2U);
    EXPECT_NEAR(events[0].p, 0.1, located);
    EXPECT_NEAR(events[1].p, 0.9, located);
    for (const Event& event : events) {
      EXPECT_NEAR(-event.s.real() / std::abs(event.s), event.value, located);
      EXPECT_EQ(event.direction, -1);  // more stable with growing p, whichever way the trace goes
      EXPECT_LE(event.retrackings, 4);
    }
  }
}

TEST(TraceEvents, FindResonancesWithTheTracedParameter) {
  // c = 0.1: s = -0.05 + j sqrt(4 - 0.0025).
  const auto events =
      events_of(oscillator({.c0 = 0.1, .from = 0.1, .to = 3.0, .events = "harmonics = [1, 2, 4]"}),
                EventKind::resonance);
  const double frequency = std::sqrt(4.0 - 0.0025);
  ASSERT_EQ(events.size(), 3U);
  for (const Event& event : events) {
    EXPECT_NEAR(event.p, frequency / event.value, located);
    EXPECT_EQ(event.direction, -1);
    EXPECT_NEAR(event.s.imag(), frequency, located);
  }
}

TEST(TraceEvents, FindResonancesWithAnExpression) {
  // Excited at k + p^2 / 10 = sqrt(k).
  const Setting setting = oscillator(
      {.k = 0.81, .from = 0.1, .to = 2.0, .events = "harmonics = 1\nexcitation = \"k + p^2 / 10\""});
  const auto events = events_of(setting, EventKind::resonance);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_NEAR(events[0].p, std::sqrt(10.0 * (0.9 - 0.81)), located);
  // dp/dk of k + p^2 / 10 = sqrt(k).
  const auto k = static_cast<Eigen::Index>(setting.parameter("k"));
  EXPECT_NEAR(events[0].shift[k], (1.0 / 1.8 - 1.0) / (0.2 * events[0].p), 1e-6);
}

TEST(TraceEvents, FindResonancesInTheUnitOfTheTracedParameter) {
  const double pi = std::acos(-1.0);
  for (const auto& [unit, factor] : {std::pair("rpm", pi / 30.0), std::pair("Hz", 2.0 * pi),
                                     std::pair("rad/s", 1.0), std::pair("deg/s", pi / 180.0)}) {
    // s = 3j, excited at p in that unit; the damping is nothing but a use for p.
    const Setting setting = make_setting(
        "[parameters]\np = {value = 0.0, unit = \"" + std::string(unit) +
        "\"}\nnone = 0.0\n[trace]\nparameter = \"p\"\nfrom = 0\nto = " + exact_text(6.0 / factor) +
        "\n[events]\nharmonics = 1\n[matrix_family]\nM = [[[1]]]\nC = [[[0]], [[\"none\"]]]\nK = [[[9]]]\n");
    const auto events = events_of(setting, EventKind::resonance);
    ASSERT_EQ(events.size(), 1U) << unit;
    EXPECT_NEAR(events[0].p, 3.0 / factor, 6.0 / factor * located) << unit;
  }
}

TEST(TraceEvents, FindExtremaOfTheDampingRatio) {
  for (const double sign : {1.0, -1.0}) {
    // c = 1 +- (p - 0.3)^2.
    const auto events = events_of(
        oscillator({.c0 = 1.0 + sign * 0.09, .c1 = -0.6 * sign, .c2 = sign, .events = "extrema = true"}),
        EventKind::extremum);
    ASSERT_EQ(events.size(), 1U);
    EXPECT_NEAR(events[0].p, 0.3, 1e-8);
    EXPECT_NEAR(events[0].value, 0.25, 1e-12);
    EXPECT_EQ(events[0].direction, sign > 0.0 ? 1 : -1);
  }
}

TEST(TraceEvents, ExtremaAreNotSoughtUnlessAskedFor) {
  const auto events = events_of(oscillator({.c0 = 1.0, .c2 = 1.0}), EventKind::extremum);
  EXPECT_TRUE(events.empty());
}

TEST(TraceEvents, ConstantDampingHasNoExtrema) {
  for (const double c : {0.0, 0.1, 3.9})
    EXPECT_TRUE(events_of(oscillator({.c0 = c, .events = "extrema = true"}), EventKind::extremum).empty())
        << c;
}

/// c = (p - 0.3)^2 - depth: unstable between 0.3 -+ sqrt(depth), however short that is.
Oscillator dip(double depth) {
  return {.c0 = 0.09 - depth, .c1 = -0.6, .c2 = 1.0};
}

TEST(TraceEvents, TwoCrossingsWithinOneStepAreFound) {
  for (const char* tolerance : {"1e-4", "1e-6", "1e-8"}) {
    for (const double depth : {1e-2, 1e-4, 1e-6, 1e-8}) {
      Oscillator o = dip(depth);
      o.options = {{"tolerance", tolerance}};
      const auto events = events_of(oscillator(o), EventKind::flutter);
      ASSERT_EQ(events.size(), 2U) << tolerance << ' ' << depth;
      // Rounding of c moves zeros of this slope so far.
      const double rounding = 1e-16 / std::sqrt(depth);
      EXPECT_NEAR(events[0].p, 0.3 - std::sqrt(depth), located + rounding);
      EXPECT_NEAR(events[1].p, 0.3 + std::sqrt(depth), located + rounding);
      EXPECT_EQ(events[0].direction, 1);
      EXPECT_EQ(events[1].direction, -1);
    }
  }
}

TEST(TraceEvents, ATouchIsOneEventWithoutDirection) {
  // (p - 1/4)^2 has no rounding.
  const auto events = events_of(oscillator({.c0 = 0.0625, .c1 = -0.5, .c2 = 1.0}), EventKind::flutter);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_NEAR(events[0].p, 0.25, 1e-7);
  EXPECT_EQ(events[0].direction, 0);
}

TEST(TraceEvents, ANearMissIsNone) {
  for (const double depth : {-1e-8, -1e-6, -1e-4})
    EXPECT_TRUE(events_of(oscillator(dip(depth)), EventKind::flutter).empty()) << depth;
}

TEST(TraceEvents, EventsInTheFirstMomentsOfATraceAreFound) {
  // Flutter at -1 + 1e-3, far within the first sample of the first step.
  const auto events =
      events_of(oscillator({.c0 = 0.999, .c1 = 1.0, .options = {{"first_step", "0.3"}}}), EventKind::flutter);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_NEAR(events[0].p, -0.999, located);
}

TEST(TraceEvents, KeepTheEigenvectorAndTheSlopesOfFlutter) {
  // c = c0 - p: flutter at p = c0; s = -(c0 - p)/2 + j sqrt(k) there.
  const Setting setting = oscillator({.c0 = 0.25, .c1 = -1.0});
  const auto events = events_of(setting, EventKind::flutter);
  ASSERT_EQ(events.size(), 1U);
  const Event& event = events[0];
  const auto p = static_cast<Eigen::Index>(setting.parameter("p"));
  const auto c0 = static_cast<Eigen::Index>(setting.parameter("c0"));
  const auto k = static_cast<Eigen::Index>(setting.parameter("k"));
  EXPECT_NEAR(std::abs(event.shape[0]), 1.0, 1e-12);
  EXPECT_NEAR(std::abs(event.sensitivity[p] - 0.5), 0.0, 1e-6);
  EXPECT_NEAR(std::abs(event.sensitivity[c0] + 0.5), 0.0, 1e-6);
  EXPECT_NEAR(std::abs(event.sensitivity[k] - Complex(0.0, 0.25)), 0.0, 1e-6);
  EXPECT_NEAR(event.shift[c0], 1.0, 1e-6);
  EXPECT_NEAR(event.shift[k], 0.0, 1e-6);
  EXPECT_TRUE(std::isnan(event.shift[p]));
}

TEST(TraceEvents, KeepTheShiftOfCollisions) {
  // c = p: critical damping at p = 2 sqrt(k).
  const Setting setting = oscillator({.c1 = 1.0, .from = 3.0, .to = 5.0});
  const auto events = events_of(setting, EventKind::collision);
  ASSERT_EQ(events.size(), 1U);
  const auto c0 = static_cast<Eigen::Index>(setting.parameter("c0"));
  const auto k = static_cast<Eigen::Index>(setting.parameter("k"));
  EXPECT_NEAR(events[0].shift[k], 0.5, 1e-8);
  EXPECT_NEAR(events[0].shift[c0], -1.0, 1e-8);
  // The mean -c/2 moves smoothly.
  EXPECT_NEAR(std::abs(events[0].sensitivity[c0] + 0.5), 0.0, 1e-8);
  EXPECT_NEAR(std::abs(events[0].sensitivity[k]), 0.0, 1e-8);
}

TEST(TraceEvents, VeeringsKeepAnEigenvectorAndTheSlopesOfTheMean) {
  // s^2 = -(eigenvalue of [[a + p, e], [e, b]]): closest at p = b - a, exceptional points at +- 2 e j.
  const Setting setting = make_setting(
      "[parameters]\np = 0.0\na = 1.0\nb = 1.5\n[trace]\nparameter = \"p\"\nfrom = 0\nto = 1\n"
      "[matrix_family]\nM = [[[1, 0], [0, 1]]]\nK = [[[\"a\", 1e-3], [1e-3, \"b\"]], [[1, 0], [0, 0]]]\n");
  const auto events = events_of(setting, EventKind::veering);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_NEAR(events[0].p, 0.5, 1e-9);
  EXPECT_NEAR(events[0].half_width, 2e-3, 1e-9);
  EXPECT_NEAR(events[0].shape.norm(), 1.0, 1e-9);
  // Both freedoms take part alike, and the mean moves with half of either stiffness: ds = j dk / (4 sqrt(k)).
  EXPECT_NEAR(std::abs(events[0].shape[0]), std::sqrt(0.5), 1e-6);
  const Complex expected(0.0, 0.25 / std::sqrt(1.5));
  for (const char* name : {"p", "a", "b"})
    EXPECT_NEAR(std::abs(events[0].sensitivity[setting.parameter(name)] - expected), 0.0, 1e-5) << name;
}

/// The one event of a kind when another parameter has a value of its own.
Event event_at(const Setting& setting, EventKind kind, const std::string& parameter, double value) {
  TraceOptions options = setting.options;
  options.values[parameter] = value;
  const TraceResult result = trace(*setting.model, options, {});
  for (const Event& event : result.events) {
    if (event.kind == kind) return event;
  }
  ADD_FAILURE() << "no event of the kind with " << parameter << " = " << value;
  return {};
}

struct ShiftCase {
  std::string name, scene;
  EventKind kind;
};

class EventShift : public testing::TestWithParam<ShiftCase> {};

TEST_P(EventShift, AgreesWithTracesAtOtherValues) {
  const Setting setting = make_setting(GetParam().scene, {{"tolerance", "1e-10"}});
  const auto& parameters = setting.model->description().parameters;
  int compared = 0;
  for (std::size_t q = 0; q < parameters.size(); ++q) {
    const std::string& name = parameters.names()[q];
    if (static_cast<int>(q) == setting.traced() || parameters[q].definition) continue;
    const double value = parameters[q].value;
    const Event here = event_at(setting, GetParam().kind, name, value);
    const double shift = here.shift[static_cast<Eigen::Index>(q)];
    // Central differences: errors of h^2 and of what is located over h.
    const double h = 1e-4 * std::max(std::abs(value), 1e-3);
    const double difference = (event_at(setting, GetParam().kind, name, value + h).p -
                               event_at(setting, GetParam().kind, name, value - h).p) /
                              (2.0 * h);
    EXPECT_NEAR(shift, difference, 1e-5 * std::max(std::abs(difference), std::abs(here.p / value))) << name;
    ++compared;
  }
  EXPECT_GT(compared, 1);
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, EventShift,
    testing::Values(
        ShiftCase{"RotatingMassFlutter", hard_case("C01_rotating_mass").scene, EventKind::flutter},
        ShiftCase{"RotatingMassCollision", hard_case("C02_rotating_mass_drag_500").scene,
                  EventKind::collision},
        ShiftCase{"FoldInTangentialForce", hard_case("C03_fold_in_tangential_force").scene, EventKind::fold}),
    [](const auto& test) { return test.param.name; });

TEST(EventOptions, FaultsOfOperatingRangesAreNamed) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"operating_range = [1, 2]", "operating_range: is of no use without `harmonics`"},
      {"harmonics = 1\noperating_range = [2, 1]", "expected 0 <= from <= to; found 2 and 1"},
      {"harmonics = 1\noperating_range = [1, 2, 3]", "expected [from, to]"},
      {"harmonics = 1\noperating_range = [\"p\", 2]", "without parameters"},
      {"harmonics = 1\noperating_range = [\"1 RPM\", 2]", "did you mean 'rpm'?"},
      {"harmonics = 1\nseparation_margin = 0.1", "of no use without `operating_range`"},
      {"harmonics = 1\noperating_range = [1, 2]\nseparation_margin = 15", "must be a fraction"},
  };
  for (const auto& [keys, expected] : cases) {
    const std::string message = input_error([&] { oscillator({.c0 = 0.1, .events = keys}); });
    EXPECT_TRUE(contains(message, expected)) << keys << ": " << message;
  }
}

}  // namespace
}  // namespace eigentrail::test::trace_events_test
