// Eigenvalue branches of a block along a step: how many there are, and who is who behind a meeting. They do
// not depend on the order in which places are sampled.
#include "continuation/tracks/eigenvalue_branches.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "continuation/planted_points.hpp"

namespace eigentrail::test::eigenvalue_branches_test {
namespace {

constexpr double rounding = 1e-12;  ///< of interpolated polynomials of order one
using Members = std::vector<int>;

/// The frequencies of a family in the order that eigenvalue branches should have.
using Frequencies = std::function<Vector(double)>;

std::vector<Complex> imaginary(const Vector& w) {
  std::vector<Complex> s;
  for (const double one : w) s.push_back(one * j);
  return s;
}

/// A step of all modes of an undamped family in one block.
struct BlockStep {
  BlockStep(const std::vector<Matrix>& W, const Frequencies& w, double from, double to)
      : family(Planted::frequencies(W)),
        left(family.point(from, {{imaginary(w(from))}})),
        right(family.point(to, {{imaginary(w(to))}})),
        length(to - from),
        start(from),
        frequencies(w) {}

  EigenvalueSampler sampler() const { return {left, right, 0, length}; }
  ComplexVector expected(double t) const { return j * frequencies(start + t * length).cast<Complex>(); }

  Planted family;
  PathNode left, right;
  double length, start;
  Frequencies frequencies;
};

/// Frequencies 2 + p and 2.6 - p, the lower one first all the way.
BlockStep crossing(double from = 0.0, double to = 0.8) {
  const auto by_size = [](double p) {
    return Vector{{std::min(2.0 + p, 2.6 - p), std::max(2.0 + p, 2.6 - p)}};
  };
  return {uncoupled(Matrix{{2.0, 1.0}, {2.6, -1.0}}), by_size, from, to};
}

BlockStep veering(double eps) {
  return {{Matrix{{2.0, eps}, {eps, 2.0}}, Matrix{{1.0, 0.0}, {0.0, -1.0}}},
          [eps](double p) {
            return Vector{{2.0 - std::hypot(p, eps), 2.0 + std::hypot(p, eps)}};
          },
          -0.5,
          0.4};
}

/// Three that cross at different places, by size.
BlockStep three() {
  const auto by_size = [](double p) {
    Vector w{{2.0 + 0.5 * p, 2.2, 2.5 - 0.7 * p}};
    std::sort(w.begin(), w.end());
    return w;
  };
  return {uncoupled(Matrix{{2.0, 0.5}, {2.2, 0.0}, {2.5, -0.7}}), by_size, 0.0, 0.6};
}

/// s = j (2 + 0.5 p), twice, and -damping + j (2.5 - 0.7 p): they pass each other at p = 0.42 at the distance
/// `damping`.
struct PassingStep {
  explicit PassingStep(double damping)
      : family(matrices(damping)),
        left(family.point(0.0, {{roots(0.0, damping)}})),
        right(family.point(0.6, {{roots(0.6, damping)}})) {}

  static std::vector<Complex> roots(double p, double damping) {
    const Complex twice = j * (2.0 + 0.5 * p);
    return {twice, -damping + j * (2.5 - 0.7 * p), twice};
  }
  static FamilyMatrices matrices(double damping) {
    const auto diagonal = [](double two, double one) { return Matrix(Vector{{two, one, two}}.asDiagonal()); };
    return {{Matrix::Identity(3, 3)},
            {diagonal(0.0, 2.0 * damping)},
            {diagonal(4.0, 6.25 + damping * damping), diagonal(2.0, -3.5), diagonal(0.25, 0.49)}};
  }

  Planted family;
  PathNode left, right;
};

class PassAtADistance : public testing::TestWithParam<double> {};

TEST_P(PassAtADistance, ThoseThatCoincideThroughoutAreOneEigenvalueBranch) {
  const PassingStep step(GetParam());
  EigenvalueSampler sampler(step.left, step.right, 0, 0.6);
  const std::vector<EigenvalueBranch> branches = eigenvalue_branches_of(step.left.tracks[0], 0, sampler);
  ASSERT_EQ(branches.size(), 2U);
  EXPECT_EQ(branches[0].members, (Members{0, 2}));
  EXPECT_EQ(branches[1].members, Members{1});
}

INSTANTIATE_TEST_SUITE_P(Distances, PassAtADistance, testing::Values(0.3, 0.03, 1e-3));

TEST(EigenvalueSampler, OrderOfSamplingDoesNotMatter) {
  const BlockStep step = three();
  std::vector<double> order;
  for (int i = 0; i <= 40; ++i) order.push_back(0.025 * i);
  std::vector<ComplexVector> forwards;
  EigenvalueSampler first = step.sampler();
  for (const double t : order) forwards.push_back(first(t));
  std::mt19937_64 engine(5);
  for (int round = 0; round < 5; ++round) {
    std::vector<std::size_t> shuffled(order.size());
    for (std::size_t i = 0; i < shuffled.size(); ++i) shuffled[i] = i;
    std::shuffle(shuffled.begin(), shuffled.end(), engine);
    EigenvalueSampler again = step.sampler();
    for (const std::size_t i : shuffled) {
      EXPECT_EQ((again(order[i]) - forwards[i]).norm(), 0.0) << "t = " << order[i] << " in round " << round;
    }
  }
}

/// Two of three that cross in the middle of the step, which is sampled before the places behind it. There
/// rounding decides which of them is which.
TEST(EigenvalueSampler, PlacesBehindACrossingThatWasSampledKeepTheirSides) {
  const auto by_size = [](double p) {
    Vector w{{2.0 + p, 2.2, 2.9 - p}};
    std::sort(w.begin(), w.end());
    return w;
  };
  const BlockStep step(uncoupled(Matrix{{2.0, 1.0}, {2.2, 0.0}, {2.9, -1.0}}), by_size, 0.0, 0.9);
  for (int i = 0; i < 20; ++i) {
    EigenvalueSampler sampler = step.sampler();
    sampler(0.025 * i);
    sampler(0.5);
    for (const double t : {0.5625, 0.625, 0.75, 1.0})
      EXPECT_LT((sampler(t) - step.expected(t)).norm(), rounding) << t << " behind " << 0.025 * i;
  }
}

TEST(EigenvalueBranchesOf, ModesThatCoincideAtTheLeftEndOnlyAreTwo) {
  BlockStep step = crossing(0.3, 0.8);
  step.left.tracks[0].departure = Track::Departure{0.01, ComplexVector{{2.31 * j, 2.29 * j}}};
  EigenvalueSampler sampler = step.sampler();
  EXPECT_EQ(eigenvalue_branches_of(step.left.tracks[0], 0, sampler).size(), 2U);
}

/// A veering of half-width 1e-6. Samples of the step must be refined there, so that it counts as two
/// eigenvalue branches.
TEST(EigenvalueBranchesOf, NarrowVeeringIsTwo) {
  const BlockStep step = veering(1e-6);
  EigenvalueSampler sampler = step.sampler();
  EXPECT_EQ(eigenvalue_branches_of(step.left.tracks[0], 0, sampler).size(), 2U);
}

TEST(EigenvalueBranchesOf, ADistanceOfRoundingIsNone) {
  // 2 + p and 2 + p + 1e-14.
  const BlockStep step{uncoupled(Matrix{{2.0, 1.0}, {2.0 + 1e-14, 1.0}}),
                       [](double p) {
                         return Vector{{2.0 + p, 2.0 + p}};
                       },
                       0.0, 0.5};
  EigenvalueSampler sampler = step.sampler();
  EXPECT_EQ(eigenvalue_branches_of(step.left.tracks[0], 0, sampler).size(), 1U);
}

/// A point on a crossing at p = 0.3, seen 0.02 behind it.
class DepartureFromACrossing : public testing::Test {
 protected:
  DepartureFromACrossing() { track.departure = Track::Departure{0.02, ComplexVector{{2.32 * j, 2.28 * j}}}; }
  Planted family = Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.6, -1.0}}));
  PathNode node = family.point(0.3, {{{2.3 * j, 2.3 * j}}});
  Track& track = node.tracks[0];
};

TEST_F(DepartureFromACrossing, IsTakenAsItIsWithinATenthOfTheStep) {
  for (const double h : {0.2, 0.5, 10.0}) {
    double position = 0.0;
    EXPECT_EQ(departing_roots(track, h, position), track.departure->roots);
    EXPECT_DOUBLE_EQ(position, 0.02 / h);
  }
}

TEST_F(DepartureFromACrossing, IsLookedAtNearerByOnAShorterStep) {
  for (const double h : {0.1, 1e-2, 1e-4}) {
    double position = 0.0;
    const ComplexVector roots = departing_roots(track, h, position);
    EXPECT_LE(position, farthest_departure);
    EXPECT_GT(position, 0.0);
    const double p = 0.3 + position * h;
    // At the point delta is a rounding error of about 1e-16, so its square root is about 1e-8.
    EXPECT_LT(distance(roots, ComplexVector{{(2.0 + p) * j, (2.6 - p) * j}}), 2e-8) << h;
    EXPECT_GT(roots[0].imag(), roots[1].imag()) << h;
  }
}

TEST_F(DepartureFromACrossing, IsWhereEigenvalueBranchesBegin) {
  const PathNode right = family.point(0.8, {{{2.8 * j, 1.8 * j}}});
  for (const bool swapped : {false, true}) {
    if (swapped) std::reverse(track.departure->roots.begin(), track.departure->roots.end());
    EigenvalueSampler sampler(node, right, 0, 0.5);
    const int up = swapped ? 1 : 0;
    EXPECT_LT(std::abs(sampler(0.6)[up] - 2.6 * j), rounding);
    EXPECT_LT(std::abs(sampler(1.0)[1 - up] - 1.8 * j), rounding);
  }
}

/// The two crossing eigenvalues are distinguished although a third one of their block is far away.
TEST(DepartingRoots, OfTwoBesideAThirdKeepTheirOrder) {
  Planted family = Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.6, -1.0}, {3.1, 0.2}}));
  const Complex third = (3.1 + 0.2 * 0.3) * j;
  PathNode node = family.point(0.3, {{{2.3 * j, 2.3 * j, third}}});
  for (const double sign : {1.0, -1.0}) {
    for (const double h : {0.1, 0.01, 1e-3}) {
      Track& track = node.tracks[0];
      track.departure = Track::Departure{
          0.02, ComplexVector{{(2.3 + 0.02 * sign) * j, (2.3 - 0.02 * sign) * j, third + 0.004 * j}}};
      double position = 0.0;
      const ComplexVector roots = departing_roots(track, h, position);
      const double d = position * h * sign;
      EXPECT_LT(
          distance(roots, ComplexVector{{(2.3 + d) * j, (2.3 - d) * j, third + 0.2 * position * h * j}}),
          0.1 * position * h)
          << "h = " << h << ", " << (sign > 0.0 ? "straight" : "the other way");
    }
  }
}

TEST(DepartingRoots, BehindAnExceptionalPointShrinkLikeTheRootOfTheDistance) {
  Planted family = Planted::frequencies({Matrix{{2.0, 1.0}, {0.0, 2.0}}, Matrix{{0.0, 0.0}, {1.0, 0.0}}});
  PathNode node = family.point(0.0, {{{2.0 * j, 2.0 * j}}});
  Track& track = node.tracks[0];
  track.departure = Track::Departure{0.04, ComplexVector{{2.2 * j, 1.8 * j}}};
  double position = 0.0;
  const ComplexVector roots = departing_roots(track, 0.01, position);
  const double half = std::sqrt(position * 0.01);
  EXPECT_LT(distance(roots, ComplexVector{{(2.0 + half) * j, (2.0 - half) * j}}), 1e-8);
}

}  // namespace
}  // namespace eigentrail::test::eigenvalue_branches_test
