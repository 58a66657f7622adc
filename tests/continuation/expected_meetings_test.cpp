// Meetings of eigenvalues that are expected on a step, and veerings beside it. Each must be found once, at
// the place of the closed form, and nothing else may be found.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "continuation/events/expected_meetings.hpp"
#include "continuation/planted_points.hpp"

namespace eigentrail::test::expected_meetings_test {
namespace {

constexpr double rounding = 1e-12;  ///< of simple roots of interpolated polynomials of order one
/// Of double roots, which are known to the square root of rounding.
constexpr double of_double_roots = 1e-6;
using Members = std::vector<int>;
using Roots = std::function<std::vector<Complex>(double)>;

/// A step from one p to another, its eigenvalues in one block or one by one.
struct PlantedStep {
  PlantedStep(Planted planted, const Roots& roots, double from, double to, bool in_one_block)
      : family(std::move(planted)),
        left(family.point(from, tracks(roots(from), in_one_block))),
        right(family.point(to, tracks(roots(to), in_one_block))),
        start(from),
        length(to - from) {}

  static std::vector<Together> tracks(const std::vector<Complex>& s, bool in_one_block) {
    return in_one_block ? std::vector<Together>{{s}} : alone(s);
  }

  std::vector<ExpectedMeeting> in_blocks() const { return expected_in_blocks(left, right, length).meetings; }
  std::vector<ExpectedMeeting> beside(double width) const {
    return expected_beside(left, right, length, width);
  }
  /// Places of meetings, as values of p.
  std::vector<Complex> places(const std::vector<ExpectedMeeting>& meetings) const {
    std::vector<Complex> p;
    for (const ExpectedMeeting& meeting : meetings) p.push_back(start + meeting.position);
    return p;
  }

  Planted family;
  PathNode left, right;
  double start, length;
};

/// Uncoupled frequencies w_i + v_i p, given by their coefficients.
PlantedStep lines(const Matrix& coefficients, double from, double to, bool in_one_block = true) {
  const auto roots = [&](double p) {
    std::vector<Complex> s;
    for (Eigen::Index i = 0; i < coefficients.rows(); ++i)
      s.push_back((coefficients(i, 0) + coefficients(i, 1) * p) * j);
    return s;
  };
  return {Planted::frequencies(uncoupled(coefficients)), roots, from, to, in_one_block};
}

/// Frequencies 2 +- sqrt(product(p)), which branch where the product vanishes.
PlantedStep branching(const std::vector<double>& product, double from, double to) {
  std::vector<Matrix> W{Matrix{{2.0, 1.0}, {product[0], 2.0}}};
  for (std::size_t k = 1; k < product.size(); ++k) W.push_back(Matrix{{0.0, 0.0}, {product[k], 0.0}});
  const auto roots = [&](double p) {
    double value = 0.0;
    for (std::size_t k = product.size(); k-- > 0;) value = value * p + product[k];
    const Complex root = std::sqrt(Complex(value));
    return std::vector<Complex>{j * (2.0 + root), j * (2.0 - root)};
  };
  return {Planted::frequencies(W), roots, from, to, true};
}

/// 2 +- sqrt((p - 0.1)^2 + eps^2) beside a mode far away.
PlantedStep veering(double eps, double from, double to, bool in_one_block) {
  const std::vector<Matrix> W{Matrix{{1.9, eps, 0.0}, {eps, 2.1, 0.0}, {0.0, 0.0, 9.0}},
                              Matrix{{1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, {0.0, 0.0, 0.2}}};
  const auto roots = [&](double p) {
    const double half = std::hypot(p - 0.1, eps);
    std::vector<Complex> s{(2.0 - half) * j, (2.0 + half) * j};
    if (!in_one_block) s.push_back((9.0 + 0.2 * p) * j);
    return s;
  };
  return {Planted::frequencies(W), roots, from, to, in_one_block};
}

/// 2 +- sqrt(p - 0.1) and a third frequency of 2.5, which meets one of the two at 0.35: its gaps have kinks
/// at 0.1.
TEST(ExpectedInBlocks, TheFirstIsEnoughWhereGapsHaveKinks) {
  const std::vector<Matrix> W{Matrix{{2.0, 1.0, 0.0}, {-0.1, 2.0, 0.0}, {0.0, 0.0, 2.5}},
                              Matrix{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}};
  const auto roots = [](double p) {
    const Complex root = std::sqrt(Complex(p - 0.1));
    return std::vector<Complex>{j * (2.0 + root), j * (2.0 - root), 2.5 * j};
  };
  const PlantedStep step(Planted::frequencies(W), roots, -0.1, 0.5, true);
  const MeetingsOnStep all = expected_in_blocks(step.left, step.right, step.length);
  ASSERT_FALSE(all.meetings.empty());
  EXPECT_EQ(all.complete_to, INFINITY);
  EXPECT_NEAR(step.places(all.meetings).back().real(), 0.35, 1e-3);
  const MeetingsOnStep first = expected_in_blocks(step.left, step.right, step.length, {false, true});
  ASSERT_FALSE(first.meetings.empty());
  EXPECT_EQ(first.meetings.front().position, all.meetings.front().position);
  EXPECT_NEAR(step.places(first.meetings).back().real(), 0.1, 1e-3);
  EXPECT_NEAR(first.complete_to, 0.2 / 0.6 + 0.01, 1e-4);
}

TEST(ExpectedInBlocks, TwoCloseTogetherAreTwo) {
  const PlantedStep step = branching({0.1 * 0.101, -0.201, 1.0}, -0.2, 0.3);
  const auto places = step.places(step.in_blocks());
  ASSERT_EQ(places.size(), 2U);
  EXPECT_NEAR(places[0].real(), 0.1, 1e-10);
  EXPECT_NEAR(places[1].real(), 0.101, 1e-10);
  // Closer roots may be one double root that rounding has split. They are reported as one place.
  const PlantedStep closer = branching({0.1 * 0.1001, -0.2001, 1.0}, -0.2, 0.3);
  const auto place = closer.places(closer.in_blocks());
  ASSERT_EQ(place.size(), 1U);
  EXPECT_NEAR(place[0].real(), 0.10005, 1e-4);
}

TEST(ExpectedInBlocks, AtTheRightEndIsOnTheStep) {
  const PlantedStep step = branching({-0.1, 1.0}, -0.2, 0.1);
  const auto found = step.in_blocks();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].position.real(), 0.3, rounding);
  EXPECT_LE(found[0].position.real(), step.length);
}

TEST(ExpectedInBlocks, ModesThatAreOneNeverMeet) {
  const PlantedStep step = lines(Matrix{{2.0, 0.5}, {2.0, 0.5}, {3.0, 0.1}}, 0.0, 0.6);
  EXPECT_TRUE(step.in_blocks().empty());
}

/// A guard mode that has met another one is not known from it behind: a step ends there as well, although it
/// is nobody's event (MeetingEvents.OfGuardsAreNone).
TEST(ExpectedInBlocks, MeetingsOfGuardsEndAStep) {
  PlantedStep step = lines(Matrix{{2.0, 1.0}, {2.2, 0.0}, {2.9, -1.0}}, 0.0, 0.9);
  step.left.tracks[0].modes = {Track::guard, Track::guard, 4};
  const auto found = step.in_blocks();
  ASSERT_EQ(found.size(), 3U);
  EXPECT_NEAR(found[0].position.real(), 0.2, of_double_roots);
  EXPECT_NEAR(found[1].position.real(), 0.45, of_double_roots);
  EXPECT_NEAR(found[2].position.real(), 0.7, of_double_roots);
}

TEST(ExpectedInBlocks, SingleModesHaveNone) {
  EXPECT_TRUE(lines(Matrix{{2.0, 1.0}, {2.6, -1.0}}, 0.0, 0.8, false).in_blocks().empty());
}

TEST(ExpectedBeside, WhatLiesBeforeOrBehindTheStepIsLeftToItsNeighbours) {
  EXPECT_TRUE(veering(0.01, 0.2, 0.4, false).beside(0.05).empty());
  EXPECT_TRUE(veering(0.01, -0.2, 0.0, false).beside(0.05).empty());
  // Close to an end both neighbouring steps may report it.
  EXPECT_EQ(veering(0.01, 0.11, 0.4, false).beside(0.05).size(), 1U);
  EXPECT_EQ(veering(0.01, -0.2, 0.09, false).beside(0.05).size(), 1U);
}

TEST(ExpectedBeside, ModesThatStayApartHaveNone) {
  const PlantedStep step =
      lines(Matrix{{2.0, 0.3}, {3.0, -0.2}, {4.0, 0.5}, {5.0, 0.0}, {6.0, 1.0}}, 0.0, 0.5, false);
  EXPECT_TRUE(step.beside(0.3).empty());
}

TEST(ExpectedBeside, ModesInDifferentChartsAreNotCompared) {
  constexpr double eps = 0.03;
  PlantedStep step = veering(eps, -0.05, 0.2, false);
  for (PathNode* node : {&step.left, &step.right}) {
    const Complex s = node->tracks[1].roots[0];
    const Complex third = node->tracks[2].roots[0];
    *node = step.family.point(node->p, {{{node->tracks[0].roots[0]}}, {{s}, Chart::reciprocal}, {{third}}});
  }
  EXPECT_TRUE(step.beside(0.1).empty());
}

/// A veering of two members of a block of three, the third nearby.
TEST(ExpectedBeside, BlockOfThreeTellsItsVeerings) {
  constexpr double eps = 0.02;
  const std::vector<Matrix> W{Matrix{{1.9, eps, 0.0}, {eps, 2.1, 0.0}, {0.0, 0.0, 2.5}},
                              Matrix{{1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, {0.0, 0.0, 0.2}}};
  const auto roots = [&](double p) {
    const double half = std::hypot(p - 0.1, eps);
    return std::vector<Complex>{(2.0 - half) * j, (2.0 + half) * j, (2.5 + 0.2 * p) * j};
  };
  const PlantedStep step(Planted::frequencies(W), roots, -0.05, 0.2, true);
  const auto found = step.beside(0.1);
  ASSERT_FALSE(found.empty());
  for (const ExpectedMeeting& meeting : found) {
    EXPECT_EQ(meeting.a.members, Members{0});
    EXPECT_EQ(meeting.b.members, Members{1});
    EXPECT_NEAR(step.places({meeting})[0].real(), 0.1, 1e-4);
    EXPECT_NEAR(std::abs(meeting.position.imag()), eps, 1e-4);
  }
}

/// Distances of eigenvalues do not show a veering: at both ends of the step they are almost the same as for
/// two modes that keep a constant distance and do not veer.
TEST(ExpectedBeside, ToldBySeriesAndNotByDistances) {
  const PlantedStep veers = veering(0.01, 0.05, 0.15, false);
  const PlantedStep parallel = lines(Matrix{{1.95, 0.0}, {2.05, 0.0}, {9.0, 0.2}}, 0.05, 0.15, false);
  const auto apart = [](const PathNode& node) {
    return std::abs(node.tracks[0].roots[0] - node.tracks[1].roots[0]);
  };
  EXPECT_NEAR(apart(veers.left), apart(parallel.left), 0.01);
  EXPECT_NEAR(apart(veers.right), apart(parallel.right), 0.01);
  EXPECT_EQ(veers.beside(0.1).size(), 1U);
  EXPECT_TRUE(parallel.beside(0.1).empty());
}

/// Frequencies 2 +- sqrt(p) and 9, from close behind the exceptional point at p = 0, where the series of each
/// of the two are those of a root: they seem to meet the third at once.
TEST(ExpectedBeside, NothingIsExpectedOfEigenvaluesThatHaveJustMet) {
  const std::vector<Matrix> W{Matrix{{2.0, 1.0, 0.0}, {0.0, 2.0, 0.0}, {0.0, 0.0, 9.0}},
                              Matrix{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}};
  Planted family = Planted::frequencies(W);
  const double from = 1e-12, to = 0.3;
  const auto point = [&](double p) {
    const double half = std::sqrt(p);
    return family.point(p, {{{(2.0 + half) * j, (2.0 - half) * j}}, {{9.0 * j}}});
  };
  PathNode left = point(from), right = point(to);
  const auto expected = [&] { return expected_beside(left, right, to - from, 0.5); };
  const auto found = expected();
  ASSERT_FALSE(found.empty()) << "the series alone do not tell";
  for (const ExpectedMeeting& meeting : found) EXPECT_TRUE(meeting.is_rough);
  left.tracks[0].met = {0, 1};
  EXPECT_TRUE(expected().empty());
}

}  // namespace
}  // namespace eigentrail::test::expected_meetings_test
