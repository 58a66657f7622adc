// Which criteria the options ask for, the excitation along the path, and how events are written and read.
#include <gtest/gtest.h>

#include <cmath>

#include "continuation/events/criterion.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::criteria_test {
namespace {

constexpr double rounding = 1e-13;

Setting oscillator(const std::string& parameters, const std::string& events) {
  return make_setting("[parameters]\n" + parameters + "\n[trace]\nparameter = \"p\"\nfrom = 1\nto = 2\n" +
                      "[events]\n" + events +
                      "\n[matrix_family]\nM = [[[1]]]\nC = [[[0.1]]]\nK = [[[4]], [[1]]]\n");
}

TEST(CriteriaOf, AreStabilityAndExtremaIfThoseAreAskedFor) {
  EXPECT_EQ(criteria_of(EventOptions{}).size(), 1U);
  EventOptions asked;
  asked.extrema = true;
  const auto criteria = criteria_of(asked);
  ASSERT_EQ(criteria.size(), 2U);
  EXPECT_EQ(criteria[0].kind, EventKind::flutter);
  EXPECT_EQ(criteria[1].kind, EventKind::extremum);
  EXPECT_FALSE(criteria[0].asks_for_pairs());
  EXPECT_TRUE(criteria[1].asks_for_pairs());
  EXPECT_TRUE(criteria[1].asks_for_extrema());
}

TEST(CriteriaOf, EveryRatioAndHarmonicIsOne) {
  EventOptions options;
  options.wanted = {{EventKind::damping_ratio, 0.02},
                    {EventKind::damping_ratio, -0.1},
                    {EventKind::resonance, 1.0},
                    {EventKind::resonance, 3.0}};
  options.extrema = false;
  const auto criteria = criteria_of(options);
  ASSERT_EQ(criteria.size(), 5U);
  EXPECT_EQ(criteria[1].kind, EventKind::damping_ratio);
  EXPECT_EQ(criteria[2].value, -0.1);
  EXPECT_EQ(criteria[3].kind, EventKind::resonance);
  EXPECT_EQ(criteria[4].value, 3.0);
  for (const Criterion& criterion : criteria) EXPECT_FALSE(criterion.asks_for_extrema());
}

TEST(CriterionValue, DampingRatioVanishesOnItsRaysAlone) {
  const Criterion criterion{EventKind::damping_ratio, 0.2};
  for (const double size : {1e-3, 1.0, 1e5}) {
    const Complex on_it = size * Complex(-0.2, std::sqrt(0.96));
    EXPECT_NEAR(criterion_value(criterion, on_it, Chart::finite, 0.0), 0.0, rounding * size);
    EXPECT_GT(criterion_value(criterion, on_it + 0.01 * size, Chart::finite, 0.0), 0.0);
    EXPECT_LT(criterion_value(criterion, on_it - 0.01 * size, Chart::finite, 0.0), 0.0);
  }
}

TEST(CriterionValue, ExtremumIsMinusTheDampingRatioInEitherChart) {
  const Criterion criterion{EventKind::extremum, 0.0};
  const Complex s(-0.3, 1.1);
  const double ratio = 0.3 / std::abs(s);
  EXPECT_NEAR(criterion_value(criterion, s, Chart::finite, 0.0), -ratio, rounding);
  EXPECT_NEAR(criterion_value(criterion, 1.0 / s, Chart::reciprocal, 0.0), -ratio, rounding);
}

/// mu = h: |mu| has no power series at zero. Criteria that contain |mu| have no series there; others have
/// one.
TEST(CriterionSeries, AtZeroHasNoneWhereTheFunctionHasNone) {
  const ComplexVector mu{{Complex(0.0), Complex(1.0, 0.5), Complex(0.2)}};
  const Vector excitation = Vector::Zero(3);
  EXPECT_FALSE(criterion_series({EventKind::extremum, 0.0}, mu, Chart::finite, excitation).allFinite());
  EXPECT_FALSE(criterion_series({EventKind::damping_ratio, 0.1}, mu, Chart::finite, excitation).allFinite());
  const Vector flutter = criterion_series({EventKind::flutter, 0.0}, mu, Chart::finite, excitation);
  EXPECT_EQ(flutter, (Vector{{0.0, 1.0, 0.2}}));
}

TEST(ExcitationSeries, WithoutAnExcitationIsZero) {
  const Setting setting = oscillator("p = 1", "");
  const Vector series =
      excitation_series(setting.options.events, setting.scene.parameters, VectorSeries::Ones(1, 4), 3);
  EXPECT_EQ(series, Vector::Zero(4));
}

/// excitation = 2 pi q^2 / p with q = 3 p derived: 18 pi p.
TEST(ExcitationSeries, IsThatOfTheExpressionInSIValues) {
  const Setting setting = oscillator("p = { value = 1, unit = \"rpm\" }\nq = \"3 * p\"",
                                     "harmonics = [1]\nexcitation = \"2 * pi * q^2 / p\"");
  const Parameters& parameters = setting.scene.parameters;
  VectorSeries series = VectorSeries::Zero(static_cast<Eigen::Index>(parameters.size()), 4);
  series(parameters.index("p").value(), 0) = 30.0;
  series(parameters.index("p").value(), 1) = 1.0;
  const Vector excitation = excitation_series(setting.options.events, parameters, series, 3);
  ASSERT_EQ(excitation.size(), 4);
  const double rpm = M_PI / 30.0;
  EXPECT_NEAR(excitation[0], 18.0 * M_PI * 30.0 * rpm, 1e-11);
  EXPECT_NEAR(excitation[1], 18.0 * M_PI * rpm, 1e-12);
  EXPECT_NEAR(excitation[2], 0.0, 1e-12);
}

TEST(EventOptions, TracedParameterIsTheExcitation) {
  const Setting setting = oscillator("p = { value = 1, unit = \"Hz\" }", "harmonics = [1, 2]");
  const Vector series =
      excitation_series(setting.options.events, setting.scene.parameters, VectorSeries{{3.0, 1.0}}, 1);
  // Turns are counted: 2 pi rad/s for every Hz.
  EXPECT_NEAR(series[0], 6.0 * M_PI, rounding);
  EXPECT_NEAR(series[1], 2.0 * M_PI, rounding);
}

TEST(EventOptions, KeepEveryValueOnceAndNoDampingRatioOfZero) {
  const Setting setting = oscillator("p = 1", "damping_ratio = [0.1, 0, 0.1, -0.2]\nextrema = false");
  EXPECT_EQ(setting.options.events.values(EventKind::damping_ratio), (std::vector<double>{0.1, -0.2}));
  EXPECT_FALSE(setting.options.events.extrema);
}

TEST(EventOptions, OperatingRangesAreOnePairOrSeveral) {
  const Setting one = oscillator("p = 1", "harmonics = 1\noperating_range = [2, 3]");
  ASSERT_EQ(one.options.events.operating.ranges.size(), 1U);
  EXPECT_EQ(one.options.events.operating.ranges[0].to, 3.0);
  EXPECT_FALSE(one.options.events.operating.margin.has_value()) << "by the standard";
  const Setting two =
      oscillator("p = 1", "harmonics = 1\noperating_range = [[0, 1], [2, 3]]\nseparation_margin = 0.15");
  EXPECT_EQ(two.options.events.operating.ranges.size(), 2U);
  EXPECT_EQ(two.options.events.operating.margin, 0.15);
}

TEST(CriterionValue, LogDecrementVanishesWhereADecayingOscillationHasIt) {
  // s = -0.2 + 4j falls by exp(0.2 T) over the period T = 2 pi / 4.
  const Complex s(-0.2, 4.0);
  const double decrement = 0.2 * 2.0 * M_PI / 4.0;
  const Criterion criterion{EventKind::log_decrement, decrement};
  EXPECT_NEAR(criterion_value(criterion, s, Chart::finite, 0.0), 0.0, 1e-15);
  EXPECT_NEAR(criterion_value(criterion, 1.0 / s, Chart::reciprocal, 0.0), 0.0, 1e-15);
  EXPECT_LT(criterion_value({EventKind::log_decrement, 0.9 * decrement}, s, Chart::finite, 0.0), -1e-3);
  // Of a growing oscillation it is negative; small ones are 2 pi times the damping ratio.
  EXPECT_NEAR(criterion_value({EventKind::log_decrement, -decrement}, {0.2, 4.0}, Chart::finite, 0.0), 0.0,
              1e-15);
  EXPECT_NEAR(criterion_value({EventKind::log_decrement, 2e-6 * M_PI}, {-1e-6, 1.0}, Chart::finite, 0.0), 0.0,
              1e-15);
}

// s^2 + p s + 1: zeta = p / 2, and the decrement is 2 pi zeta / sqrt(1 - zeta^2).
TEST(LogDecrement, IsLocatedOnATrace) {
  const double zeta = 0.125;
  const double decrement = 2.0 * M_PI * zeta / std::sqrt(1.0 - zeta * zeta);
  const RecordedTrace trace = record_trace(
      make_setting("[trace]\nparameter = \"p\"\nfrom = 0.1\nto = 1\n[matrix_family]\nM = [ [[1]] ]\n"
                   "C = [ [[0]], [[1]] ]\nK = [ [[1]] ]\n[events]\nlog_decrement = " +
                   exact_text(decrement) + "\n"));
  ASSERT_EQ(trace.result.events.size(), 1U);
  const Event& event = trace.result.events[0];
  EXPECT_EQ(event.kind, EventKind::log_decrement);
  EXPECT_NEAR(event.p, 2.0 * zeta, 1e-12);
  EXPECT_EQ(event.value, decrement);
  EXPECT_EQ(event.direction, -1) << "the mode decays faster there";
}

TEST(EventLine, CountsModesFromOneAndKeepsEveryDigit) {
  Event event;
  event.kind = EventKind::crossing;
  event.p = 0.1;
  event.s = Complex(-0.25, 1.0 / 3.0);
  event.modes = {0, 4};
  EXPECT_EQ(event_line(event), "crossing,0.1,-0.25,0.3333333333333333,1;5");
  event.modes.clear();
  EXPECT_EQ(event_line(event), "crossing,0.1,-0.25,0.3333333333333333,");
}

}  // namespace
}  // namespace eigentrail::test::criteria_test
