// Cutting a step at the first meeting of eigenvalues that it passes. All places are known in closed form.
#include "continuation/events/landing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/planted_search.hpp"

namespace eigentrail::test::landing_test {
namespace {

/// A planted point from which a step is attempted and landed.
struct From {
  From(Planted family, double p, const std::vector<Together>& tracks)
      : planted(std::move(family)), origin{planted.family.point(p, tracks)} {}
  LandedStep land(double h, bool on_any_terms = false) {
    StepSolver solver(planted.solver, origin);
    return eigentrail::land(solver, solver.attempt(h).step.value(), on_any_terms).value();
  }
  PlantedSearch planted;
  StepOrigin origin;
};

/// s^2 + 2 d s + 1 - p: a pair that meets the real axis at p = 1 - d^2.
Planted towards_the_axis(double d) {
  return Planted({{Matrix{{1.0}}}, {Matrix{{2.0 * d}}}, {Matrix{{1.0}}, Matrix{{-1.0}}}});
}
std::vector<Together> pair_at(double d, double p) {
  const Complex root = std::sqrt(Complex(p - (1.0 - d * d)));
  return {{{-d + root, -d - root}}};
}

TEST(Land, EndsAStepOnACollision) {
  for (const double d : {0.5, 0.1}) {
    From from(towards_the_axis(d), 0.6, pair_at(d, 0.6));
    const LandedStep landed = from.land(0.41);
    EXPECT_NEAR(0.6 + landed.step.h, 1.0 - d * d, 1e-13);
    EXPECT_EQ(landed.step.right.p, 0.6 + landed.step.h);
    ASSERT_EQ(landed.meetings.size(), 1U);
    const MeetingOnEnd& met = landed.meetings[0];
    EXPECT_EQ(met.track, 0U);
    EXPECT_EQ(met.meeting.kind, EventKind::collision);
    EXPECT_EQ(met.meeting.members, (std::vector<int>{0, 1}));
    EXPECT_NEAR(std::abs(met.meeting.puiseux), 1.0, 1e-9);
    EXPECT_EQ(landed.step.meeting, std::vector<std::size_t>{0});
  }
}

TEST(Land, LeavesAStepAloneThatPassesNothing) {
  From from(towards_the_axis(0.5), 0.6, pair_at(0.5, 0.6));
  const LandedStep landed = from.land(0.1);
  EXPECT_EQ(landed.step.h, 0.1);
  EXPECT_TRUE(landed.meetings.empty());
  EXPECT_TRUE(landed.step.meeting.empty());
}

/// Frequencies 2 + p and 2.6 - p: a double root of the discriminant, known to the root of rounding only.
TEST(Land, EndsAStepOnACrossing) {
  From from(Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.6, -1.0}})), 0.0, {{{2.0 * j, 2.6 * j}}});
  const LandedStep landed = from.land(0.5);
  EXPECT_NEAR(landed.step.h, 0.3, 1e-10);
  ASSERT_EQ(landed.meetings.size(), 1U);
  EXPECT_EQ(landed.meetings[0].meeting.kind, EventKind::crossing);
}

/// Three lines in one block meet pairwise at 0.1, 0.2 and 0.3.
TEST(Land, EndsAStepOnTheFirstOfSeveral) {
  const Matrix w{{2.0, 1.0}, {2.1, 0.0}, {2.4, -1.0}};
  for (const double from_p : {0.0, 0.4}) {
    std::vector<Complex> s;
    for (Eigen::Index i = 0; i < 3; ++i) s.push_back((w(i, 0) + from_p * w(i, 1)) * j);
    From from(Planted::frequencies(uncoupled(w)), from_p, {{s}});
    const LandedStep landed = from.land(from_p == 0.0 ? 0.4 : -0.4);
    EXPECT_NEAR(from_p + landed.step.h, from_p == 0.0 ? 0.1 : 0.3, 1e-10);
    EXPECT_EQ(landed.meetings.size(), 1U);
  }
}

/// Two exceptional points so close that rounding moves each of them by more than what counts as on a point.
TEST(Land, EndsAStepOnTheFirstOfTwoCollisionsCloseToEachOther) {
  constexpr double curvature = 1e-4;
  for (const double half : {3e-4, 1e-4}) {
    const auto product = [&](double p) { return curvature * (p * p - half * half); };
    Planted family = Planted::frequencies(
        {Matrix{{2.0, 1.0}, {product(0.0), 2.0}}, Matrix::Zero(2, 2), Matrix{{0.0, 0.0}, {curvature, 0.0}}});
    const Complex root = std::sqrt(Complex(product(-0.1)));
    From from(std::move(family), -0.1, {{{j * (2.0 + root), j * (2.0 - root)}}});
    const LandedStep landed = from.land(0.25);
    ASSERT_EQ(landed.meetings.size(), 1U) << half;
    EXPECT_EQ(landed.meetings[0].meeting.kind, EventKind::collision) << half;
    EXPECT_NEAR(landed.step.h, 0.1 - half, 1e-4 * half);
  }
}

/// The step ends between two exceptional points, nearer to the one that it does not pass.
TEST(Land, EndsAStepOnACollisionInFrontOfOneThatIsJustBeyondTheEnd) {
  constexpr double half = 5e-5;
  const auto product = [&](double p) { return p * p - half * half; };
  const Complex root = std::sqrt(Complex(product(-0.25)));
  for (const double beyond : {0.1 * half, 0.6 * half}) {
    From from(Planted::frequencies({Matrix{{2.0, 1.0}, {product(0.0), 2.0}}, Matrix::Zero(2, 2),
                                    Matrix{{0.0, 0.0}, {1.0, 0.0}}}),
              -0.25, {{{j * (2.0 + root), j * (2.0 - root)}}});
    const LandedStep landed = from.land(0.25 + half - beyond);
    EXPECT_NEAR(landed.step.h, 0.25 - half, 1e-9) << beyond;
    EXPECT_EQ(landed.meetings.size(), 1U) << beyond;
  }
}

/// Two narrow veerings of one pair at 0 and 0.04, the first at the left end of the step. From the second one
/// the series show the first inaccurately; it is no earlier meeting of the step.
TEST(Land, TheKnownMeetingAtTheLeftEndHidesNone) {
  constexpr double eps = 1e-9;
  constexpr double second = 0.04;
  // 2 +- sqrt(f(p)^2 + eps^2) with f = p (p - second) (1 + p)^6.
  std::vector<Matrix> W{Matrix{{2.0, eps}, {eps, 2.0}}};
  std::vector<double> f{0.0, -second, 1.0};
  for (int i = 0; i < 6; ++i) {
    f.push_back(0.0);
    for (std::size_t k = f.size() - 1; k > 0; --k) f[k] += f[k - 1];
  }
  for (std::size_t k = 1; k < f.size(); ++k) W.push_back(Matrix{{f[k], 0.0}, {0.0, -f[k]}});
  From from(Planted::frequencies(W), 0.0, {{{(2.0 - eps) * j, (2.0 + eps) * j}}});
  from.origin.node.tracks[0].met = {0, 1};
  const LandedStep landed = from.land(0.2);
  EXPECT_NEAR(landed.step.h, second, 1e-10);
  ASSERT_EQ(landed.meetings.size(), 1U);
  EXPECT_EQ(landed.meetings[0].meeting.kind, EventKind::veering);
}

/// Two of one block meet where two others do.
TEST(Land, RecordsAllMeetingsOfOnePlace) {
  From from(Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.6, -1.0}, {5.0, 1.0}, {5.6, -1.0}})), 0.0,
            {{{2.0 * j, 2.6 * j}}, {{5.0 * j, 5.6 * j}}});
  const LandedStep landed = from.land(0.5);
  EXPECT_NEAR(landed.step.h, 0.3, 1e-10);
  ASSERT_EQ(landed.meetings.size(), 2U);
  EXPECT_NE(landed.meetings[0].track, landed.meetings[1].track);
}

/// A meeting of half-width eps is passed if it is wide, and gets a point if the output could not tell it from
/// a collision.
TEST(Land, EndsAStepOnANarrowVeeringAndPassesAWideOne) {
  for (const double eps : {0.05, 1e-2, 3e-4, 1e-5}) {
    const auto at = [eps](double p) {
      return std::vector<Together>{{{(2.0 - std::hypot(p, eps)) * j, (2.0 + std::hypot(p, eps)) * j}}};
    };
    From from(Planted::frequencies({Matrix{{2.0, eps}, {eps, 2.0}}, Matrix{{1.0, 0.0}, {0.0, -1.0}}}), -0.2,
              at(-0.2));
    const LandedStep landed = from.land(0.5);
    if (eps > 3e-3 * 0.5) {
      EXPECT_EQ(landed.step.h, 0.5) << eps;
      continue;
    }
    EXPECT_NEAR(landed.step.h, 0.2, 1e-10) << eps;
    ASSERT_EQ(landed.meetings.size(), 1U) << eps;
    EXPECT_EQ(landed.meetings[0].meeting.kind, EventKind::veering);
    EXPECT_NEAR(landed.meetings[0].meeting.half_width, eps, 1e-9 * eps + 1e-12);
  }
}

/// At one end of every step the eigenvalues must be distinct.
TEST(Land, BetweenTwoMeetingsEndsHalfWay) {
  const Matrix w{{2.0, 1.0}, {2.0, -1.0}, {2.4, -1.0}};
  From from(Planted::frequencies(uncoupled(w)), 0.0, {{{2.0 * j, 2.0 * j, 2.4 * j}}});
  from.origin.node.tracks[0].departure =
      Track::Departure{1e-6, ComplexVector{{(2.0 + 1e-6) * j, (2.0 - 1e-6) * j, (2.4 - 1e-6) * j}}};
  const LandedStep landed = from.land(0.3);
  EXPECT_NEAR(landed.step.h, 0.1, 1e-9);
  EXPECT_TRUE(landed.meetings.empty());
}

TEST(Land, CountsItsWorkAsThatOfEvents) {
  From from(towards_the_axis(0.5), 0.6, pair_at(0.5, 0.6));
  StepSolver solver(from.planted.solver, from.origin);
  const Step step = solver.attempt(0.3).step.value();
  RunCounts& counts = from.planted.family.counts;
  const std::uint64_t modes = counts.modes.factorizations;
  ASSERT_TRUE(land(solver, step, false));
  EXPECT_EQ(counts.modes.factorizations, modes);
  EXPECT_GT(counts.event_factorizations, 0U);
}

/// At the start no step leads to the point.
TEST(MeetingsAt, FindsWhatCoincidesAtAPointAndNothingElse) {
  PlantedSearch planted(
      Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.0, -1.0}, {2.3, 0.5}, {5.0, 0.0}})));
  const PathNode at_it = planted.family.point(0.0, {{{5.0 * j}}, {{2.0 * j, 2.3 * j, 2.0 * j}}});
  const auto meetings = meetings_at(planted.family.problem(), planted.frame, at_it);
  ASSERT_EQ(meetings.size(), 1U);
  EXPECT_EQ(meetings[0].track, 1U);
  EXPECT_EQ(meetings[0].meeting.kind, EventKind::crossing);
  EXPECT_EQ(meetings[0].meeting.members, (std::vector<int>{0, 2}));
  const PathNode beside = planted.family.point(1e-6, {{{(2.0 + 1e-6) * j, (2.0 - 1e-6) * j}}});
  EXPECT_TRUE(meetings_at(planted.family.problem(), planted.frame, beside).empty());
}

}  // namespace
}  // namespace eigentrail::test::landing_test
