// The options of criteria, the excitation along the path, and how events are written and read.
#include <gtest/gtest.h>

#include <cmath>

#include "continuation/events/criterion.hpp"
#include "eigentrail/core/text.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::criteria_test {
namespace {

Setting oscillator(const std::string& parameters, const std::string& events) {
  return make_setting("[parameters]\n" + parameters + "\n[trace]\nparameter = \"p\"\nfrom = 1\nto = 2\n" +
                      "[events]\n" + events +
                      "\n[matrix_family]\nM = [[[1]]]\nC = [[[0.1]]]\nK = [[[4]], [[1]]]\n");
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
