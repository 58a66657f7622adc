// Stable ranges of traces whose stability is known in closed form.
#include "eigentrail/stability/stable_ranges.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "eigentrail/core/text.hpp"
#include "hard_cases/catalogue.hpp"
#include "support/scenes.hpp"
#include "support/traced_path.hpp"

namespace eigentrail::test::stable_ranges_test {
namespace {

struct TracedRanges : TracedPath {
  std::vector<StableRange> ranges;
};

TracedRanges traced_ranges(const Setting& setting, int most_points = 0) {
  TracedRanges traced{trace_path(*setting.model, setting.options, most_points), {}};
  traced.ranges =
      stable_ranges(traced.path, traced.result.events, {setting.options.tolerance, traced.result.s_ref});
  return traced;
}

TracedRanges traced_family(const std::string& trace, const std::string& matrices) {
  return traced_ranges(
      make_setting("[trace]\nparameter = \"p\"\n" + trace + "\n[matrix_family]\n" + matrices));
}

struct ExpectedRange {
  Stability kind;
  double from, to;
  std::string from_cause, to_cause;
};

std::string text(const std::vector<StableRange>& ranges) {
  std::ostringstream out;
  for (const StableRange& range : ranges) {
    out << stability_name(range.kind) << ' ' << range.from.p << ' ' << range.from.cause << " -> "
        << range.to.p << ' ' << range.to.cause << "; ";
  }
  return out.str();
}

void expect_ranges(const std::vector<StableRange>& found, const std::vector<ExpectedRange>& expected) {
  // Events are located to about 1e-10 of the range.
  constexpr double accuracy = 1e-8;
  ASSERT_EQ(found.size(), expected.size()) << text(found);
  for (std::size_t i = 0; i < found.size(); ++i) {
    SCOPED_TRACE(text({found[i]}));
    EXPECT_EQ(found[i].kind, expected[i].kind);
    EXPECT_NEAR(found[i].from.p, expected[i].from, accuracy);
    EXPECT_NEAR(found[i].to.p, expected[i].to, accuracy);
    EXPECT_EQ(found[i].from.cause, expected[i].from_cause);
    EXPECT_EQ(found[i].to.cause, expected[i].to_cause);
  }
}

constexpr Stability stable = Stability::stable;
constexpr Stability marginal = Stability::marginal;

/// Everything happens within the first 1e-10 of the longest range: places are told apart relative to the
/// steps there. K has no inverse where 10 p^2 + 19 p = 1.99.
TEST(StableRanges, OfAStructureMuchSmallerThanTheRange) {
  const double divergence = (std::sqrt(361.0 + 4.0 * 10.0 * 1.99) - 19.0) / 20.0;
  for (const char* to : {"1", "1e3", "1e6", "1e9"}) {
    SCOPED_TRACE(to);
    const TracedRanges traced = traced_family("from = 0\nto = " + std::string(to),
                                              "M = [ [[1, 0], [0, 1]] ]\n"
                                              "C = [ [[0.1, 0], [0, 0.2]] ]\n"
                                              "K = [ [[1, 0.1], [0.1, 2]], [[-10, 0], [0, 1]] ]\n");
    ASSERT_EQ(traced.result.status, TraceStatus::completed) << traced.result.message;
    expect_ranges(traced.ranges, {{stable, 0.0, divergence, "start", "divergence"}});
  }
}

struct RangesCase {
  std::string hard_case;
  std::vector<ExpectedRange> ranges;
};
void PrintTo(const RangesCase& c, std::ostream* out) {
  *out << c.hard_case;
}

class HardCaseRanges : public testing::TestWithParam<RangesCase> {};

TEST_P(HardCaseRanges, AreThoseOfTheClosedForm) {
  for (const double tolerance : {1e-4, 1e-6, 1e-9}) {
    SCOPED_TRACE(tolerance);
    const HardCase& c = hard_case(GetParam().hard_case);
    expect_ranges(traced_ranges(make_setting(c.scene, {{"tolerance", exact_text(tolerance)}})).ranges,
                  GetParam().ranges);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, HardCaseRanges,
    testing::Values(
        RangesCase{"H05_exceptional_point", {{marginal, 0, 0.5, "start", "collision"}}},
        RangesCase{"H05_exceptional_point_at_end", {{marginal, 0, 0.5, "start", "collision"}}},
        RangesCase{"H08_ziegler", {{marginal, 0, 2.085786437626904951198, "start", "collision"}}},
        RangesCase{"H09_ziegler_damped_1em4", {{stable, 0, 1.46428571428571428571, "start", "flutter"}}},
        RangesCase{"H09_ziegler_damped_1", {{stable, 0, 1.96428571428571428571, "start", "flutter"}}},
        RangesCase{"H10_gyroscopic_loss", {{marginal, 3, 2, "start", "collision"}}},
        RangesCase{"H11_internal_damping", {{stable, 0, 3, "start", "flutter"}}},
        RangesCase{"H12_internal_damping_anisotropic", {{stable, 0, 3.60555127546399, "start", "flutter"}}},
        RangesCase{"H13_ground_resonance_undamped",
                   {{marginal, 5, 14.125938130500622816, "start", "collision"},
                    {marginal, 19.246307207909378842, 21.010497422155937776, "collision", "collision"},
                    {marginal, 32.041673914624333041, 40, "collision", "end"}}},
        RangesCase{"H14_ground_resonance_damped",
                   {{stable, 5, 14.196322617088708071, "start", "flutter"},
                    {stable, 19.404591244682398597, 20.950696238470192032, "flutter", "flutter"},
                    {stable, 33.144464474936986812, 40, "flutter", "end"}}},
        RangesCase{"H15_ground_resonance_stable", {{stable, 5, 60, "start", "end"}}},
        RangesCase{"H16_flap_lag", {{stable, 0.01, 0.1657863012097541564, "start", "flutter"}}},
        RangesCase{"H17_divergence", {{stable, 0, 1, "start", "divergence"}}},
        RangesCase{"H18_undamped_divergence", {{marginal, 0, 1, "start", "collision"}}},
        RangesCase{"H20_infinite_eigenvalue", {{stable, 0, 1, "start", "infinity"}}},
        RangesCase{"H22_rigid_body_mode", {{marginal, 0, 0.1, "collision", "end"}}},
        RangesCase{"C01_rotating_mass", {{stable, 100, 12.4393882230095183, "start", "flutter"}}},
        RangesCase{"C05_pushed_pendulum", {{marginal, 0, 1, "start", "fold"}}}),
    [](const auto& test) { return test.param.hard_case; });

/// s^2 + 2 c s + 1 with c = (p - 1)(p - 2)(p - 4)(p - 5)/10: stable but for two windows, |s| = 1 throughout.
TEST(StableRanges, LeaveOutTwoWindowsOfInstability) {
  const TracedRanges traced = traced_family(
      "from = 0\nto = 6", "M = [[[1]]]\nC = [[[\"(p - 1)*(p - 2)*(p - 4)*(p - 5)/50\"]]]\nK = [[[1]]]");
  expect_ranges(traced.ranges, {{stable, 0, 1, "start", "flutter"},
                                {stable, 2, 4, "flutter", "flutter"},
                                {stable, 5, 6, "flutter", "end"}});
  ASSERT_EQ(traced.ranges.size(), 3u);
  // Re s = -c/2: 40/100 at p = 0, and 4/100 in the middle, at p = 3.
  EXPECT_NEAR(traced.ranges[0].from.margin, 0.4, 1e-12);
  EXPECT_EQ(traced.ranges[0].from.mode, 0);
  EXPECT_EQ(traced.ranges[0].to.margin, 0.0);
  EXPECT_NEAR(traced.ranges[1].largest_margin, 0.04, 1e-8);
  EXPECT_NEAR(traced.ranges[1].largest_at, 3.0, 1e-3);
  EXPECT_EQ(traced.ranges[1].least_margin, 0.0);
}

/// The growth rate in the window is at most 2.5e-9, far below the tolerance. Only the events show it.
/// A dip of the margin between two points, and a kink where another mode becomes the slowest one.
TEST(StableRanges, HaveTheExtremaOfTheMargin) {
  const TracedRanges dip = traced_family("from = 0\nto = 1\ntolerance = 1e-9",
                                         "M = [ [[1]] ]\n"
                                         "C = [ [[\"2*(0.3173^2 + 1e-5)\"]], [[\"-4*0.3173\"]], [[2]] ]\n"
                                         "K = [ [[4]], [[1]] ]\n");
  ASSERT_EQ(dip.ranges.size(), 1U);
  EXPECT_NEAR(dip.ranges[0].least_margin, 1e-5, 3e-9);
  const TracedRanges kink = traced_family("from = 0\nto = 1",
                                          "M = [ [[1, 0], [0, 1]] ]\n"
                                          "C = [ [[0.2, 0], [0, 2.2]], [[2, 0], [0, -2]] ]\n"
                                          "K = [ [[4, 0], [0, 9]] ]\n");
  ASSERT_EQ(kink.ranges.size(), 1U);
  EXPECT_NEAR(kink.ranges[0].largest_margin, 0.6, 1e-7);
  EXPECT_NEAR(kink.ranges[0].largest_at, 0.5, 1e-7);
}

TEST(StableRanges, SeeAWindowBelowTheTolerance) {
  const TracedRanges traced =
      traced_family("from = 0\nto = 1\ntolerance = 1e-5",
                    "M = [[[1]]]\nC = [[[\"0.002*(p - 0.4)*(p - 0.405)\"]]]\nK = [[[1]]]");
  expect_ranges(traced.ranges, {{stable, 0, 0.4, "start", "flutter"}, {stable, 0.405, 1, "flutter", "end"}});
}

/// A fast mode grows from p = 0.45 on, more slowly than the error of the dense output tells. Between 0.55 and
/// 0.6, where no other mode grows, there is no stored point either: what is known of it is its flutter.
TEST(StableRanges, AreNoneBehindTheFlutterOfAFastMode) {
  const TracedRanges traced = traced_family("from = 0\nto = 1", R"--(
M = [[[1, 0], [0, 1]]]
C = [[["(p - 0.3) * (p - 0.55) * (0.6 - p)", 0], [0, "1e-5 * (0.45 - p)"]]]
K = [[[1, 0], [0, 1e8]]]
)--");
  for (const double p : traced.path.p) EXPECT_FALSE(p > 0.551 && p < 0.599) << p;
  expect_ranges(traced.ranges, {{stable, 0, 0.3, "start", "flutter"}});
}

TEST(StableRanges, NameTheModeThatEndsThem) {
  // The second oscillator, s = +-2j, loses its damping at p = 1; the first keeps 0.1.
  const TracedRanges traced = traced_family(
      "from = 0\nto = 2",
      "M = [[[1, 0], [0, 1]]]\nC = [[[0.2, 0], [0, 1]], [[0, 0], [0, -1]]]\nK = [[[1, 0], [0, 4]]]");
  expect_ranges(traced.ranges, {{stable, 0, 1, "start", "flutter"}});
  ASSERT_EQ(traced.ranges.size(), 1u);
  EXPECT_EQ(traced.ranges[0].from.mode, 0);
  EXPECT_NEAR(traced.ranges[0].from.margin, 0.1, 1e-12);
  EXPECT_EQ(traced.ranges[0].to.mode, 1);
}

TEST(StableRanges, OfATraceThatEndedEarlyReachAsFarAsItCame) {
  const Setting setting = make_setting(hard_case("H11_internal_damping").scene, {{"max_step", "0.1"}});
  const TracedRanges traced = traced_ranges(setting, 5);
  ASSERT_EQ(traced.result.status, TraceStatus::stopped);
  expect_ranges(traced.ranges, {{stable, 0, traced.result.reached, "start", "end"}});
  EXPECT_TRUE(traced_ranges(setting, 1).ranges.empty());
}

TEST(StableRanges, OfThePathReversedAreTheSame) {
  const HardCase& c = hard_case("H14_ground_resonance_damped");
  expect_ranges(traced_ranges(make_setting(c.scene, {{"from", "40"}, {"to", "5"}})).ranges,
                {{stable, 40, 33.144464474936986812, "start", "flutter"},
                 {stable, 20.950696238470192032, 19.404591244682398597, "flutter", "flutter"},
                 {stable, 14.196322617088708071, 5, "flutter", "end"}});
}

/// A massless freedom with the stiffness p beside a damped oscillator: s^2 + 0.1 s + 1 - 0.09 / p. Where p
/// falls the oscillator diverges at 0.09; its unstable eigenvalue runs to infinity at p = 0, and comes back
/// as a damped pair.
TEST(StableRanges, BeginWhereAnUnstableModeEndsAtInfinity) {
  const std::string matrices =
      "M = [[[1, 0], [0, 0]]]\nC = [[[0.1, 0], [0, 0]]]\nK = [[[1, 0.3], [0.3, 0]], [[0, 0], [0, 1]]]";
  for (const bool falls : {true, false}) {
    SCOPED_TRACE(falls ? "p falls" : "p rises");
    const TracedRanges traced = traced_family(falls ? "from = 1\nto = -1" : "from = -1\nto = 1", matrices);
    ASSERT_EQ(traced.result.status, TraceStatus::completed) << traced.result.message;
    ASSERT_EQ(traced.ranges.size(), 2U) << text(traced.ranges);
    const StableRange& negative = traced.ranges[falls ? 1 : 0];
    const StableRange& positive = traced.ranges[falls ? 0 : 1];
    EXPECT_EQ((falls ? negative.from : negative.to).cause, "infinity");
    EXPECT_NEAR((falls ? negative.from : negative.to).p, 0.0, 1e-3);
    EXPECT_LE((falls ? negative.from : negative.to).p, 0.0) << "stable where the mode still grows";
    EXPECT_EQ((falls ? positive.to : positive.from).cause, "divergence");
    EXPECT_NEAR((falls ? positive.to : positive.from).p, 0.09, 1e-9);
  }
}

/// Without any event the dense output alone finds the boundary, to its own accuracy.
TEST(StableRanges, AreFoundWithoutEventsToo) {
  const HardCase& c = hard_case("H11_internal_damping");
  const Setting setting = make_setting(c.scene, {{"tolerance", "1e-9"}});
  const TracedRanges traced = traced_ranges(setting);
  const auto ranges = stable_ranges(traced.path, {}, {1e-9, traced.result.s_ref});
  ASSERT_EQ(ranges.size(), 1u);
  EXPECT_NEAR(ranges[0].to.p, 3.0, 1e-5);
  EXPECT_EQ(ranges[0].to.cause, "sign change");
}

/// The damping p^2 touches zero. The range continues, and its least margin is zero.
TEST(StableRanges, GoOnWhereTheMarginTouchesZero) {
  const TracedRanges traced =
      traced_family("from = -1\nto = 1", "M = [[[1]]]\nC = [[[0]], [[0]], [[0.1]]]\nK = [[[1]]]");
  ASSERT_EQ(traced.ranges.size(), 1u) << text(traced.ranges);
  EXPECT_EQ(traced.ranges[0].kind, stable);
  EXPECT_NEAR(traced.ranges[0].least_margin, 0.0, 1e-3);
}

TEST(StableRanges, OfEqualOscillatorsAreThoseOfOne) {
  // Four equal ones, s = -p/2 +- j sqrt(1 - p^2/4): a block of four whose eigenvalues coincide throughout.
  const std::string equal = "[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]";
  const std::string none = "[[0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]]";
  const TracedRanges traced = traced_family(
      "from = 0.1\nto = -0.1", "M = [" + equal + "]\nC = [" + none + ", " + equal + "]\nK = [" + equal + "]");
  expect_ranges(traced.ranges, {{stable, 0.1, 0.0, "start", "flutter"}});
  ASSERT_EQ(traced.ranges.size(), 1u);
  EXPECT_NEAR(traced.ranges[0].from.margin, 0.05, 1e-12);
}

TEST(StableRanges, ARigidBodyModeIsNoGrowth) {
  // Two masses on a spring, free to move on: the double eigenvalue zero is found as +-1e-8 or so.
  for (const std::string k : {"1", "1e4"}) {
    const TracedRanges traced =
        traced_family("from = 1\nto = 3", "M = [[[1, 0], [0, 2]]]\nK = [[[0, 0], [0, 0]], [[" + k + ", -" +
                                              k + "], [-" + k + ", " + k + "]]]\n");
    expect_ranges(traced.ranges, {{marginal, 1.0, 3.0, "start", "end"}});
  }
}

TEST(StableRanges, AModeThatIsMissingOnAStepDoesNotDecayThere) {
  TracedRanges traced = traced_family("from = 1\nto = 3\nmax_step = 0.25",
                                      "M = [[[1, 0], [0, 1]]]\nC = [[[0.1, 0], [0, 0]]]\n"
                                      "K = [[[1, 0], [0, 9]], [[1, 0], [0, 1]]]");
  expect_ranges(traced.ranges, {{marginal, 1.0, 3.0, "start", "end"}});
  std::erase_if(traced.path.steps.at(2).blocks, [](const DenseBlock& block) { return block.modes[0] == 1; });
  expect_ranges(stable_ranges(traced.path, {}, {1e-8, traced.result.s_ref}),
                {{marginal, 1.0, 3.0, "start", "end"}});
}

TEST(StableRanges, ManyRigidBodyModesEndATraceInNoTime) {
  // Two points in space joined by a spring have five rigid-body modes, which cannot be distinguished.
  // Following them through rounding errors took hours.
  const TracedRanges traced = traced_ranges(make_setting(R"(
parameters = { k = 1 }
trace = { parameter = "k", from = 1, to = 3 }
point = [
  { name = "a", mass = 1, position = [0, 0, 0] },
  { name = "b", mass = 2, position = [1, 0, 0] },
]
spring = [{ from = "a", to = "b", stiffness = "k", free_length = 1 }]
)"));
  EXPECT_EQ(traced.result.status, TraceStatus::completed) << traced.result.message;
  EXPECT_LT(traced.result.nodes, 50);
  ASSERT_FALSE(traced.ranges.empty());
  for (const StableRange& range : traced.ranges) EXPECT_EQ(range.kind, marginal) << text({range});
}

}  // namespace
}  // namespace eigentrail::test::stable_ranges_test
