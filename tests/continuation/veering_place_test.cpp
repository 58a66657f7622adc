// Veerings that were seen in series, at the place that the pencil has.
#include "continuation/events/exceptional_point.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace eigentrail::test::veering_place_test {
namespace {

constexpr Complex i(0.0, 1.0);

/// Frequencies whose squares are those of [4 + h, e, 0; e, 4 + 3 d, e; 0, e, 4 + ...]: see the tests.
ReducedPencil squares(const Matrix& K0, const Matrix& K1, double damping = 0.0) {
  const Eigen::Index n = K0.rows();
  Matrix C = Matrix::Zero(n, n);
  C(0, 0) = damping;
  return {{Matrix::Identity(n, n)}, {C}, {K0, K1}, {}};
}

/// With damping of one of the two the exceptional points differ: near i (e - 2 d) and -i (e + 2 d) for s = 2
/// i.
TEST(LocatedVeering, IsTheNearestOfTwoThatAreNoMirrorImages) {
  constexpr double e = 1e-3, d = 4e-4;
  const ReducedPencil pencil =
      squares(Matrix{{4.0, e}, {e, 4.0}}, Matrix{{1.0, 0.0}, {0.0, -1.0}}, 2.0 * d / 2.0);
  for (const double seen : {e - d, e + d}) {
    const auto place = located_veering(pencil, Chart::finite, {0.0, seen}, {1.9998 * i, 2.0002 * i}, 0.1 * d);
    ASSERT_TRUE(place) << seen;
    EXPECT_NEAR(place->half_width, seen, 1e-2 * d);
  }
}

/// A moving mode passes two that stand still and do not influence each other. Between both veerings the
/// series of those two seem to meet, as far off the axis as the veerings are away.
TEST(LocatedVeering, OfTwoThatDoNotMeetIsNone) {
  constexpr double e = 5e-5, d = 1.2e-4;
  const ReducedPencil pencil = squares(Matrix{{4.0 + d, e, 0.0}, {e, 4.0, e}, {0.0, e, 4.0 - d}},
                                       Matrix{{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 0.0}});
  const std::array<Complex, 2> standing{i * (2.0 + d / 4.0), i * (2.0 - d / 4.0)};
  EXPECT_FALSE(located_veering(pencil, Chart::finite, {0.0, 1.02e-4}, standing, 1e-6));
  const auto first =
      located_veering(pencil, Chart::finite, {d, 2.0 * e}, {i * (2.0 + d / 4.0), 2.0001 * i}, e);
  ASSERT_TRUE(first);
  EXPECT_NEAR(first->offset, d, 0.5 * d);
}

}  // namespace
}  // namespace eigentrail::test::veering_place_test
