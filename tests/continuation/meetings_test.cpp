// The nearest meeting of two eigenvalues, computed from the series at a point: kind, place, half-width and
// Puiseux coefficient, compared with closed forms.
#include "continuation/events/meetings.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/planted_points.hpp"

namespace eigentrail::test::meetings_test {
namespace {

constexpr double rounding = 1e-12;  ///< of gaps that are polynomials of order one
constexpr double reach = 1.0;
using Members = std::vector<int>;

/// Frequencies 2 +- sqrt(product(p)), by a matrix [[2, 1], [product(p), 2]]: roots of the product are
/// exceptional points.
Planted branching(const std::vector<double>& product, int order = 4) {
  std::vector<Matrix> W{Matrix{{2.0, 1.0}, {product[0], 2.0}}};
  for (std::size_t k = 1; k < product.size(); ++k) W.push_back(Matrix{{0.0, 0.0}, {product[k], 0.0}});
  return Planted::frequencies(W, order);
}

PathNode branching_point(Planted& family, double p, double product) {
  const Complex root = std::sqrt(Complex(product));
  return family.point(p, {{{j * (2.0 + root), j * (2.0 - root)}}});
}

/// Two uncoupled frequencies 2 + p and 2.6 - p.
Planted crossing() {
  return Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.6, -1.0}}));
}
PathNode crossing_point(Planted& family, double p) {
  return family.point(p, {{{(2.0 + p) * j, (2.6 - p) * j}}});
}

/// 2 +- sqrt(p^2 + eps^2).
Planted veering(double eps) {
  return Planted::frequencies({Matrix{{2.0, eps}, {eps, 2.0}}, Matrix{{1.0, 0.0}, {0.0, -1.0}}});
}
PathNode veering_point(Planted& family, double p, double eps) {
  return family.point(p, {{{(2.0 - std::hypot(p, eps)) * j, (2.0 + std::hypot(p, eps)) * j}}});
}

class SeenFrom : public testing::TestWithParam<double> {};

TEST_P(SeenFrom, ExceptionalPointLiesWhereTheBranchesJoin) {
  const double p = GetParam();
  Planted family = branching({0.0, 1.0});
  const PathNode node = branching_point(family, p, p);
  const Meeting meeting = nearest_meeting(node.tracks[0], {0}, {1}, reach);
  ASSERT_TRUE(meeting.found);
  EXPECT_EQ(meeting.kind, EventKind::collision);
  EXPECT_NEAR(meeting.offset, -p, rounding);
  EXPECT_EQ(meeting.half_width, 0.0);
  EXPECT_EQ(meeting.members, (Members{0, 1}));
  // s = j (2 +- sqrt(p)).
  EXPECT_LT(std::abs(meeting.puiseux * meeting.puiseux + 1.0), rounding);
}

TEST_P(SeenFrom, CrossingLiesWhereUncoupledModesAreEqual) {
  Planted family = crossing();
  const PathNode node = crossing_point(family, 0.3 + GetParam());
  const Meeting meeting = nearest_meeting(node.tracks[0], {0}, {1}, reach);
  ASSERT_TRUE(meeting.found);
  EXPECT_NEAR(meeting.offset, -GetParam(), rounding);
  EXPECT_EQ(meeting.half_width, 0.0);
  // Farther away the eigenvalues differ. Then the point does not show whether they have two eigenvectors
  // where they meet.
  if (std::abs(GetParam()) <= 1e-6) {
    EXPECT_EQ(meeting.kind, EventKind::crossing);
  }
}

INSTANTIATE_TEST_SUITE_P(Distances, SeenFrom, testing::Values(0.0, 1e-9, -1e-6, 1e-3, -0.02, 0.1, -0.2));

/// Frequencies 2 +- p of a matrix that has only one eigenvector where both are 2. The eigenvalues are smooth,
/// but the modes coalesce.
TEST(NearestMeeting, DoubleRootWithOneVectorIsACollision) {
  Planted family = branching({0.0, 0.0, 1.0});
  for (const double p : {0.0, 1e-9, -1e-8}) {
    const PathNode node = branching_point(family, p, p * p);
    const Meeting meeting = nearest_meeting(node.tracks[0], {0}, {1}, reach);
    ASSERT_TRUE(meeting.found) << p;
    EXPECT_EQ(meeting.kind, EventKind::collision) << p;
    // The place is a double root and so known to the square root of rounding.
    EXPECT_NEAR(p + meeting.offset, 0.0, 1e-7) << p;
  }
}

/// s^2 + s + 1 - p twice: two pairs meet at p = 0.75, s = -0.5. All four are one there, but each varies like
/// the square root of the distance.
TEST(NearestMeeting, OfTwoEqualPairsHasTheExponentOfOne) {
  const Matrix one = Matrix::Identity(2, 2);
  Planted family({{one}, {one}, {one, -one}});
  for (const double beside : {1e-9, -1e-9}) {
    const Complex root = std::sqrt(Complex(beside));
    const PathNode node =
        family.point(0.75 + beside, {{{-0.5 + root, -0.5 + root, -0.5 - root, -0.5 - root}}});
    const Meeting meeting = nearest_meeting(node.tracks[0], {0}, {2}, reach);
    ASSERT_TRUE(meeting.found) << beside;
    EXPECT_EQ(meeting.members.size(), 4U) << beside;
    EXPECT_EQ(meeting.cycle, 2) << beside;
    EXPECT_NEAR(std::abs(meeting.puiseux), 1.0, 1e-3) << beside;
  }
}

/// Frequencies 2 + p +- slope sqrt(p^2 + half_width^2) in coordinates that are not at right angles: two modes
/// that move together and meet at a small angle. Rounding of a frequency moves their crossing by rounding
/// over the slope.
class SmallAngle : public testing::Test {
 protected:
  static constexpr double slope = 2e-5;
  static Meeting meeting(double half_width, double p) {
    const Matrix V{{1.0, 0.6}, {0.3, 1.0}};
    const Matrix I = Matrix::Identity(2, 2);
    const auto seen = [&](const Matrix& own) { return Matrix(V * own * V.inverse()); };
    Planted family =
        Planted::frequencies({2.0 * I + seen(slope * half_width * Matrix{{0.0, 1.0}, {1.0, 0.0}}),
                              I + seen(slope * Matrix{{1.0, 0.0}, {0.0, -1.0}})});
    const double apart = slope * std::hypot(p, half_width);
    const PathNode node = family.point(p, {{{(2.0 + p - apart) * j, (2.0 + p + apart) * j}}});
    return nearest_meeting(node.tracks[0], {0}, {1}, 0.1);
  }
  static constexpr double places[] = {0.0, 1e-12, -7e-12, 3e-11, -6e-11};
};

TEST_F(SmallAngle, CrossingIsOneForCertain) {
  for (const double p : places) {
    const Meeting found = meeting(0.0, p);
    ASSERT_TRUE(found.found) << p;
    EXPECT_EQ(found.kind, EventKind::crossing) << p;
    EXPECT_TRUE(found.is_certain) << p;
  }
}

TEST_F(SmallAngle, VeeringBelowTheBoundOfRoundingIsNoCertainCrossing) {
  for (const double p : places) {
    const Meeting found = meeting(1.5e-9, p);
    ASSERT_TRUE(found.found) << p;
    EXPECT_FALSE(found.kind == EventKind::crossing && found.is_certain) << p;
  }
}

TEST_F(SmallAngle, VeeringAboveRoundingIsOneForCertain) {
  for (const double half_width : {1e-8, 1e-7, 1e-5}) {
    const Meeting found = meeting(half_width, 0.3 * half_width);
    ASSERT_TRUE(found.found) << half_width;
    EXPECT_EQ(found.kind, EventKind::veering) << half_width;
    EXPECT_TRUE(found.is_certain) << half_width;
    EXPECT_NEAR(found.half_width, half_width, 1e-3 * half_width + 1e-10);
  }
}

/// Modes of different damping whose frequencies cross at a real p. They coincide only at a complex p.
TEST(NearestMeeting, ModesThatPassEachOtherDoNotMeet) {
  constexpr double damping = 0.02;
  const auto diagonal = [](double a, double b) { return Matrix(Vector{{a, b}}.asDiagonal()); };
  Planted family({{Matrix::Identity(2, 2)},
                  {diagonal(0.0, 2.0 * damping)},
                  {diagonal(4.0, 6.76 + damping * damping), diagonal(4.0, -5.2), Matrix::Identity(2, 2)}});
  const PathNode node = family.point(0.28, {{{2.28 * j, -damping + 2.32 * j}}});
  EXPECT_FALSE(nearest_meeting(node.tracks[0], {0}, {1}, reach).found);
}

/// Between two exceptional points that are some ten times farther apart than rounding would split one double
/// root, the nearer one is found, and not a single one in the middle; its place is known less well than
/// others.
TEST(NearestMeeting, OfTwoExceptionalPointsJustAboveRoundingIsTheNearer) {
  constexpr double curvature = 1e-4;
  constexpr double half = 1e-4;
  Planted family = branching({-curvature * half * half, 0.0, curvature});
  for (const double p : {0.4 * half, -0.9 * half, half}) {
    const PathNode node = branching_point(family, p, curvature * (p * p - half * half));
    const Meeting meeting = nearest_meeting(node.tracks[0], {0}, {1}, 0.1);
    ASSERT_TRUE(meeting.found) << p;
    EXPECT_EQ(meeting.kind, EventKind::collision) << p;
    EXPECT_NEAR(p + meeting.offset, std::copysign(half, p), meeting.rounding) << p;
    EXPECT_LT(meeting.rounding, 0.3 * half) << p;
    // Of a single exceptional point of the same family the place is known to all digits.
    Planted single = branching({0.0, 1.0});
    const Meeting one = nearest_meeting(branching_point(single, 0.01, 0.01).tracks[0], {0}, {1}, 0.1);
    EXPECT_LT(one.rounding, 1e-5 * meeting.rounding);
  }
}

TEST(NearestMeeting, BeyondTheReachIsNone) {
  Planted family = crossing();
  const PathNode node = crossing_point(family, 0.0);
  EXPECT_TRUE(nearest_meeting(node.tracks[0], {0}, {1}, 0.2).found);
  EXPECT_FALSE(nearest_meeting(node.tracks[0], {0}, {1}, 0.1).found);
}

/// Two modes that coincide everywhere (a doublet) meet a third one together, whichever of the two is given.
TEST(NearestMeeting, OfADoubletBesideItsCrossingIsThatOfAllThree) {
  Planted family = Planted::frequencies(uncoupled(Matrix{{2.0, 0.5}, {2.5, -0.7}, {2.0, 0.5}}));
  constexpr double place = 0.5 / 1.2;
  const double p = place - 1e-8;
  const Complex twice = (2.0 + 0.5 * p) * j;
  const PathNode node = family.point(p, {{{twice, (2.5 - 0.7 * p) * j, twice}}});
  // The reach is small: it sets the scale on which the slopes of the two are compared.
  const Meeting meeting = nearest_meeting(node.tracks[0], {0}, {2}, 1e-7);
  ASSERT_TRUE(meeting.found);
  EXPECT_EQ(meeting.kind, EventKind::crossing);
  EXPECT_NEAR(p + meeting.offset, place, 1e-12);
  EXPECT_EQ(meeting.members, (Members{0, 1, 2}));
}

/// Only two of three eigenvalues meet, at a distance as above. The third must not be included.
TEST(NearestMeeting, LeavesOutAThirdThatOnlyComesNear) {
  Planted family = Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.1, 0.0}, {2.35, -0.1}}));
  const PathNode node = family.point(0.08, {{{2.08 * j, 2.1 * j, 2.342 * j}}});
  const Meeting meeting = nearest_meeting(node.tracks[0], {0}, {1}, reach);
  ASSERT_TRUE(meeting.found);
  EXPECT_EQ(meeting.members, (Members{0, 1}));
  EXPECT_NEAR(meeting.offset, 0.02, 1e-10);
}

/// Meetings of 1/s: both eigenvalues pass through infinity, at different places, and meet between them.
TEST(NearestMeeting, IsSeenInTheReciprocalChart) {
  // mu = -1 + p and -1.5 + 2 p, from (s mu - 1): no mass, C = mu, K = -1.
  const auto diagonal = [](double a, double b) { return Matrix(Vector{{a, b}}.asDiagonal()); };
  Planted family({{Matrix::Zero(2, 2)}, {diagonal(-1.0, -1.5), diagonal(1.0, 2.0)}, {diagonal(-1.0, -1.0)}});
  for (const double p : {0.45, 0.5}) {
    const Complex a = 1.0 / (-1.0 + p);
    const Complex b = 1.0 / (-1.5 + 2.0 * p);
    const PathNode node = family.point(p, {{{a, b}, Chart::reciprocal}});
    const Meeting meeting = nearest_meeting(node.tracks[0], {0}, {1}, reach);
    ASSERT_TRUE(meeting.found) << p;
    EXPECT_NEAR(p + meeting.offset, 0.5, rounding);
    if (p == 0.5) {
      EXPECT_EQ(meeting.kind, EventKind::crossing);
    }
  }
}

TEST(EarlierMeeting, IsNoneBesideTheAxisAndNoneAtThePoint) {
  Planted family = veering(0.05);
  const PathNode node = veering_point(family, 0.1, 0.05);
  EXPECT_EQ(earlier_meeting(node.tracks[0], {0}, {1}, 1.0), 0.0);
  Planted single = branching({0.0, 1.0});
  const PathNode on_it = branching_point(single, 0.0, 0.0);
  EXPECT_EQ(earlier_meeting(on_it.tracks[0], {0}, {1}, 1.0), 0.0);
}

}  // namespace
}  // namespace eigentrail::test::meetings_test
