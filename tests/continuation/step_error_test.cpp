// The estimated error of a step: closed forms on polynomials, the order in the length of the step, and what
// it promises of the error that is really made.
#include "continuation/step/step_error.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/planted_search.hpp"
#include "eigentrail/continuation/dense_output.hpp"

namespace eigentrail::test::step_error_test {
namespace {

constexpr double tolerance = 1e-6;

/// One mode of frequency 2 + c p^degree. With order q the dense output is of degree 2q + 1.
Planted monomial(int degree, double c, int order) {
  std::vector<Matrix> W(static_cast<std::size_t>(degree) + 1, Matrix::Zero(1, 1));
  W[0](0, 0) = 2.0;
  W.back()(0, 0) += c;
  return Planted::frequencies(W, order);
}

/// The error of one track between two points, in units of the accepted one.
double error_on(Planted& family, const PathNode& left, const PathNode& right) {
  const Step step{&left, right, right.p - left.p};
  return track_error(family.problem(), tolerance, 0.0, step, 0);
}

TEST(TrackError, VanishesWhereTheOutputIsExact) {
  Planted family = monomial(3, 1.0, 1);
  const auto s = [](double p) { return (2.0 + p * p * p) * j; };
  const PathNode left = family.point(-0.2, alone({s(-0.2)}));
  EXPECT_LT(error_on(family, left, family.point(0.3, alone({s(0.3)}))), 1e-6);
}

/// The first term left out is c (t (t - 1))^2 h^4 with order 1: c (h / 2)^4 at the middle.
TEST(TrackError, IsTheFirstTermLeftOutAsAShareOfTheSmallestEigenvalue) {
  constexpr double c = 0.5, h = 0.1;
  Planted family = monomial(4, c, 1);
  const auto s = [](double p) { return (2.0 + c * std::pow(p, 4)) * j; };
  const PathNode left = family.point(-0.5 * h, alone({s(-0.5 * h)}));
  const double error = error_on(family, left, family.point(0.5 * h, alone({s(0.5 * h)})));
  const double made = c * std::pow(0.5 * h, 4);
  // The smallest eigenvalue on the step is 2. The terms behind the last are assumed to go on.
  const double share = made / (accepted_share * tolerance * 2.0);
  EXPECT_GE(error, share * (1.0 - 1e-6));
  EXPECT_LE(error, 2.0 * share);
}

/// s = j sqrt(1 + p) from 0 to h.
struct Root {
  explicit Root(int order)
      : family({{Matrix{{1.0}}}, {}, {Matrix{{1.0}}, Matrix{{1.0}}}}, order), left(at(0.0)) {}
  PathNode at(double p) { return family.point(p, alone({std::sqrt(1.0 + p) * j})); }
  double error(double h) { return error_on(family, left, at(h)); }
  /// The largest error of the output of the order q that is stored, as a share of the tolerance.
  double made(double h) {
    const PathNode right = at(h);
    const Eigen::Index count = family.problem().order + 1;
    const HermiteInterpolant output(h, left.tracks[0].functions.leftCols(count),
                                    right.tracks[0].functions.leftCols(count));
    double worst = 0.0;
    for (int i = 1; i < 100; ++i) {
      const double exact = std::sqrt(1.0 + 0.01 * i * h);
      worst = std::max(worst, std::abs(output(0.01 * i)[0] - exact * j) / exact);
    }
    return worst / tolerance;
  }
  Planted family;
  PathNode left;
};

class OrderOfTrackError : public testing::TestWithParam<int> {};

TEST_P(OrderOfTrackError, IsTwiceTheOrderOfTheSeriesAndTwo) {
  Root root(GetParam());
  const double observed = std::log2(root.error(0.4) / root.error(0.2));
  EXPECT_NEAR(observed, 2.0 * GetParam() + 2.0, 1.0);
}

TEST_P(OrderOfTrackError, BoundsTheErrorMadeAndIsNotFarAboveIt) {
  Root root(GetParam());
  for (const double h : {0.2, 0.5, 0.8}) {
    const double bound = accepted_share * root.error(h);
    EXPECT_GE(bound, root.made(h)) << h;
    EXPECT_LE(bound, 5.0 * root.made(h)) << h;
  }
}

INSTANTIATE_TEST_SUITE_P(Orders, OrderOfTrackError, testing::Values(1, 2, 3));

/// s = -1 +- sqrt(p - p^4): the pair meets at p = 0. The fourth power is left out by order 1.
struct Meeting {
  PathNode at(double p) {
    const Complex root = std::sqrt(Complex(p - std::pow(p, 4)));
    return family.point(p, {{{-1.0 + root, -1.0 - root}}});
  }
  Planted family{{{Matrix{{1.0}}},
                  {Matrix{{2.0}}},
                  {Matrix{{1.0}}, Matrix{{-1.0}}, Matrix{{0.0}}, Matrix{{0.0}}, Matrix{{1.0}}}},
                 1};
};

TEST(TrackError, OfABlockThatMeetsOnTheEndIsTakenBesideIt) {
  Meeting meeting;
  const PathNode left = meeting.at(0.15);
  Step step{&left, meeting.at(0.0), -0.15};
  const double at_the_end = track_error(meeting.family.problem(), tolerance, 0.0, step, 0);
  step.meeting = {0};
  const double beside = track_error(meeting.family.problem(), tolerance, 0.0, step, 0);
  ASSERT_TRUE(std::isfinite(at_the_end));
  EXPECT_GT(beside, 0.0);
  EXPECT_LT(beside, 0.7 * at_the_end);
}

TEST(TrackError, OfABlockThatMeetsWhereTheStepBeginsIsTakenBesideIt) {
  Meeting meeting;
  PathNode left = meeting.at(0.0);
  const PathNode right = meeting.at(0.15);
  const double at_the_begin = error_on(meeting.family, left, right);
  left.tracks[0].departure = Track::Departure{1e-5, left.tracks[0].roots};
  EXPECT_LT(error_on(meeting.family, left, right), 0.7 * at_the_begin);
}

/// A frequency that is not a number must not pass as accurate.
TEST(TrackError, ThatIsNotANumberIsInfinite) {
  Planted family = monomial(3, 1.0, 1);
  const PathNode left = family.point(0.0, alone({2.0 * j}));
  PathNode right = family.point(0.1, alone({2.001 * j}));
  right.tracks[0].functions(0, 0) = NAN;
  EXPECT_EQ(error_on(family, left, right), INFINITY);
}

/// Frequencies 2 and 3, the second with a fourth power that order 1 leaves out.
struct Two {
  Two()
      : family(
            Planted::frequencies(uncoupled(Matrix{{2.0, 0.1, 0.0, 0.0, 0.0}, {3.0, 0.0, 0.0, 0.0, 1.0}}), 1)),
        left(at(0.0)) {}
  PathNode at(double p) { return family.point(p, alone({(2.0 + 0.1 * p) * j, (3.0 + std::pow(p, 4)) * j})); }
  Step step(double h) { return {&left, at(h), h}; }
  Planted family;
  PathNode left;
  PathFrame frame{PathRange{0, -1.0, 1.0}};
};

TEST(JudgeError, AcceptsUpToAnErrorOfOne) {
  Two two;
  const Step step = two.step(0.5);
  const double error = judge_error(two.family.problem(), two.frame, tolerance, step).error;
  // The error is inversely proportional to the tolerance.
  const Verdict above = judge_error(two.family.problem(), two.frame, tolerance * error * 1.001, step);
  EXPECT_TRUE(above.accepted());
  EXPECT_NEAR(above.error, 1.0, 2e-3);
  EXPECT_EQ(above.track, 1);  // the worst
  EXPECT_FALSE(judge_error(two.family.problem(), two.frame, tolerance * error * 0.999, step).accepted());
}

/// The share of the errors of a part is (h / whole)^(2q + 2): with order 1, 1e-6 at a length of 0.0316.
TEST(JudgeError, AShortPartOfAnAccurateStepIsAccurate) {
  Two two;
  Step step = two.step(0.5);
  for (const double direction : {1.0, -1.0}) {
    step.whole = direction * 0.5 / 0.031;
    EXPECT_TRUE(judge_error(two.family.problem(), two.frame, tolerance, step).accepted());
    step.whole = direction * 0.5 / 0.032;
    EXPECT_FALSE(judge_error(two.family.problem(), two.frame, tolerance, step).accepted());
  }
}

/// Across a plane p is a series, too. With order 1 and p = sigma + c sigma^6 the term h^6 is left out.
TEST(JudgeError, CountsTheParameterWhereItIsNotTheCoordinate) {
  Two two;
  Step step = two.step(1e-3);
  PathNode left = two.left;
  step.left = &left;
  left.path.parameters = Matrix{{0.0, 1.0, 0.0}};
  step.right.path.parameters = Matrix{{1e-3, 1.0, 0.3}};
  ASSERT_TRUE(judge_error(two.family.problem(), two.frame, tolerance, step).accepted());
  two.frame.plane = PathPlane{Vector::Zero(2), 1.0};
  const Verdict verdict = judge_error(two.family.problem(), two.frame, tolerance, step);
  EXPECT_EQ(verdict.kind, Verdict::Kind::inaccurate);
  EXPECT_EQ(verdict.track, -1);
  EXPECT_NE(verdict.reason.find("parameter"), std::string::npos);
  step.right.path.parameters(0, 2) = 0.0;
  EXPECT_TRUE(judge_error(two.family.problem(), two.frame, tolerance, step).accepted());
}

/// s = j sqrt(1 + p), where the right end of a short step is off by `noise`, with a tolerance below rounding.
struct Noisy {
  static constexpr double below_rounding = 1e-14;
  Root root{2};
  PathNode right;
  Step step;

  Noisy(double h, double noise) : right(root.at(h)), step{&root.left, {}, h} {
    right.tracks[0].functions(0, 0) += noise;
    step.right = right;
  }
  double observed() { return observed_rounding(root.family.problem(), below_rounding, step, 0); }
  double error(double rounding) {
    return track_error(root.family.problem(), below_rounding, rounding, step, 0);
  }
};

TEST(ObservedRounding, IsWhatTheEndsOfAShortStepDisagreeBy) {
  Noisy noisy(1e-8, 1.5e-14);
  ASSERT_GT(noisy.error(0.0), 1.0);
  const double seen = noisy.observed();
  EXPECT_GT(seen, 0.0);
  EXPECT_EQ(noisy.error(seen), 0.0);
}

TEST(ObservedRounding, IsNoJumpAndNoTruncation) {
  EXPECT_EQ(Noisy(1e-8, 1e-9).observed(), 0.0);
  Noisy truncated(0.1, 0.0);
  ASSERT_GT(truncated.error(0.0), 1.0);
  EXPECT_EQ(truncated.observed(), 0.0);
}

TEST(ObservedRounding, IsKnownByModeWhateverTheyAreFollowedWith) {
  PathFrame frame;
  Track pair, single, other;
  pair.modes = {2, Track::guard};
  single.modes = {2};
  other.modes = {0, Track::no_mode};
  EXPECT_EQ(known_rounding(frame, single), 0.0);
  note_rounding(pair, 1e-15, frame);
  note_rounding(single, 1e-16, frame);
  EXPECT_EQ(known_rounding(frame, single), 1e-15);
  EXPECT_EQ(known_rounding(frame, pair), 1e-15);
  EXPECT_EQ(known_rounding(frame, other), 0.0);
}

}  // namespace
}  // namespace eigentrail::test::step_error_test
