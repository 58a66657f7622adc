// Estimates of the error that the dense output would have if modes were followed in other blocks or charts.
// They are compared with the actual error, and vanish where the functions of the other choice are
// polynomials.
#include "continuation/tracks/partner.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <functional>

#include "continuation/planted_points.hpp"
#include "eigentrail/continuation/dense_output.hpp"

namespace eigentrail::test::grouping_errors_test {
namespace {

/// Error of interpolated polynomials: rounding of series whose terms are a hundred times larger than their
/// sum.
constexpr double rounding = 1e-11;
constexpr double least_gap = 1e-3;

const std::vector<Matrix> veering_at_zero(double eps) {
  return {Matrix{{2.0, eps}, {eps, 2.0}}, Matrix{{1.0, 0.0}, {0.0, -1.0}}};
}

std::vector<Complex> veering_roots(double p, double eps) {
  return {(2.0 - std::hypot(p, eps)) * j, (2.0 + std::hypot(p, eps)) * j};
}

/// Error of the interpolant without the last coefficients of a single mode, as the trace's dense output is.
double error_made(const PathNode& left, const PathNode& right, std::size_t track, double h,
                  const std::function<Complex(double)>& exact) {
  const ComplexMatrix& a = left.tracks[track].functions;
  const ComplexMatrix& b = right.tracks[track].functions;
  const Eigen::Index count = a.cols() - 1;
  const HermiteInterpolant output(h, a.leftCols(count), b.leftCols(count));
  double worst = 0.0;
  for (int i = 1; i < 100; ++i) worst = std::max(worst, std::abs(output(0.01 * i)[0] - exact(0.01 * i * h)));
  return worst;
}

class ErrorOfVeering : public testing::TestWithParam<double> {
 protected:
  double eps = GetParam();
  static constexpr double h = 0.4;
  Planted family = Planted::frequencies(veering_at_zero(eps));
  PathNode left = family.point(-0.2, alone(veering_roots(-0.2, eps)));
  PathNode right = family.point(0.2, alone(veering_roots(0.2, eps)));
};

TEST_P(ErrorOfVeering, VanishesAsABlockAndIsLargeAlone) {
  const std::vector<Partner> partner{{false, 1, eps}};
  EXPECT_LT(error_as_block(left, right, 0, partner, h, least_gap), rounding / eps);
  const Vector singles = errors_as_singles(family.problem(), left, right, 0, h);
  ASSERT_EQ(singles.size(), 1);
  EXPECT_GT(singles[0], 1e-3);
}

INSTANTIATE_TEST_SUITE_P(HalfWidths, ErrorOfVeering, testing::Values(0.1, 0.03, 1e-2));

/// A veering of half-width 0.3 and steps of at most that length. The terms of the interpolant decrease, and
/// the estimate agrees with the actual error.
TEST(ErrorsAsSingles, EstimateTheErrorThatIsMade) {
  constexpr double eps = 0.3;
  Planted family = Planted::frequencies(veering_at_zero(eps));
  for (const double h : {0.3, 0.15, -0.2}) {
    const PathNode left = family.point(0.1, alone(veering_roots(0.1, eps)));
    const PathNode right = family.point(0.1 + h, alone(veering_roots(0.1 + h, eps)));
    for (std::size_t i = 0; i < 2; ++i) {
      const double estimate = error_as_block(left, right, i, {}, h, least_gap);
      const double made =
          error_made(left, right, i, h, [&](double d) { return veering_roots(0.1 + d, eps)[i]; });
      EXPECT_GT(estimate, 0.9 * made) << "h = " << h;
      EXPECT_LT(estimate, 5.0 * made + rounding) << "h = " << h;
    }
  }
}

TEST(ErrorsAsSingles, AreUnknownForThoseThatCoincide) {
  Planted family = Planted::frequencies(uncoupled(Matrix{{2.0, 0.5}, {2.0, 0.5}, {2.5, 0.3}}));
  const PathNode left = family.point(0.0, {{{2.0 * j, 2.0 * j, 2.5 * j}}});
  const PathNode right = family.point(0.2, {{{2.1 * j, 2.1 * j, 2.56 * j}}});
  const Vector errors = errors_as_singles(family.problem(), left, right, 0, 0.2);
  EXPECT_TRUE(std::isinf(errors[0]));
  EXPECT_TRUE(std::isinf(errors[1]));
  EXPECT_LT(errors[2], rounding);
}

TEST(ErrorsAsSingles, AreUnknownWhereTheBlockWasAnother) {
  Planted family = Planted::frequencies(uncoupled(Matrix{{2.0, 0.5}, {2.5, 0.3}}));
  const PathNode left = family.point(0.0, {{{2.0 * j}}});
  const PathNode right = family.point(0.2, {{{2.1 * j, 2.56 * j}}});
  const Vector errors = errors_as_singles(family.problem(), left, right, 0, 0.2);
  ASSERT_EQ(errors.size(), 2);
  EXPECT_TRUE(std::isinf(errors.minCoeff()));
}

/// (1 - p) s^2 + s = 0: s = -1 / (1 - p), and 1/s is linear in p.
TEST(ErrorsAsSingles, AreThoseInTheBetterChart) {
  Planted family({{Matrix{{1.0}}, Matrix{{-1.0}}}, {Matrix{{1.0}}}, {Matrix{{0.0}}}});
  const PathNode left = family.point(0.5, alone({Complex(-2.0)}));
  const PathNode right = family.point(0.8, alone({Complex(-5.0)}));
  EXPECT_LT(errors_as_singles(family.problem(), left, right, 0, 0.3)[0], rounding);
  EXPECT_LT(error_in_other_chart(family.problem(), left, right, 0, 0.3), rounding);
  EXPECT_GT(error_as_block(left, right, 0, {}, 0.3, least_gap), 1e-6);
}

TEST(ErrorInOtherChart, IsRelativeToTheEigenvalueThere) {
  // mu = 1/s = -0.25 + sqrt(p - 0.9375); s has a pole in addition to the branch point of mu.
  Planted family({{Matrix{{1.0}}, Matrix{{-1.0}}}, {Matrix{{0.5}}}, {Matrix{{1.0}}}});
  const auto mu = [](double p) { return -0.25 + std::sqrt(p - 0.9375); };
  constexpr double h = 0.015;
  const auto at = [&](double p, Chart chart) { return family.point(p, {{{Complex(1.0 / mu(p))}, chart}}); };
  const PathNode left = at(0.98, Chart::finite);
  const PathNode right = at(0.98 + h, Chart::finite);
  const double estimate = error_in_other_chart(family.problem(), left, right, 0, h);
  const double made = error_made(at(0.98, Chart::reciprocal), at(0.98 + h, Chart::reciprocal), 0, h,
                                 [&](double d) { return Complex(mu(0.98 + d)); }) /
                      std::abs(mu(0.98 + h));
  EXPECT_GT(estimate, 0.9 * made);
  EXPECT_LT(estimate, 5.0 * made + rounding);
  // The relative error in the finite chart is much larger.
  const double finite = error_as_block(left, right, 0, {}, h, least_gap) * std::abs(mu(0.98));
  EXPECT_GT(finite, 1e2 * estimate);
}

TEST(ErrorInOtherChart, IsUnknownForBlocksAndAtZero) {
  Planted family = Planted::frequencies(uncoupled(Matrix{{2.0, 0.5}, {2.5, 0.3}}));
  PathNode left = family.point(0.0, {{{2.0 * j, 2.5 * j}}, {{2.0 * j}}});
  const PathNode right = family.point(0.2, {{{2.1 * j, 2.56 * j}}, {{2.1 * j}}});
  EXPECT_TRUE(std::isinf(error_in_other_chart(family.problem(), left, right, 0, 0.2)));
  EXPECT_TRUE(std::isfinite(error_in_other_chart(family.problem(), left, right, 1, 0.2)));
  left.tracks[1].functions(0, 0) = 0.0;
  EXPECT_TRUE(std::isinf(error_in_other_chart(family.problem(), left, right, 1, 0.2)));
}

/// (w - 2)^3 = p: three cube roots, whose power means are polynomials.
std::vector<Complex> cube_roots(double p) {
  std::vector<Complex> s;
  for (int i = 0; i < 3; ++i) s.push_back(j * (2.0 + std::cbrt(p) * std::polar(1.0, 2.0 * M_PI / 3.0 * i)));
  return s;
}

TEST(ErrorAsBlock, OfThreeAroundATriplePointVanishes) {
  Planted family = Planted::frequencies({Matrix{{2.0, 1.0, 0.0}, {0.0, 2.0, 1.0}, {0.0, 0.0, 2.0}},
                                         Matrix{{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}});
  const PathNode left = family.point(0.05, alone(cube_roots(0.05)));
  const PathNode right = family.point(0.25, alone(cube_roots(0.25)));
  const std::vector<Partner> both{{false, 1, 0.05}, {false, 2, 0.05}};
  EXPECT_LT(error_as_block(left, right, 0, both, 0.2, least_gap), 1e-9);
  // Two of the three are not enough.
  EXPECT_GT(error_as_block(left, right, 0, {both[0]}, 0.2, least_gap), 1e-4);
  EXPECT_GT(error_as_block(left, right, 0, {}, 0.2, least_gap), 1e-4);
}

/// s^2 + s + 1 - p, on its way to the real axis at p = 0.75.
TEST(ErrorAsBlock, OfAPairWithItsConjugateVanishes) {
  Planted family({{Matrix{{1.0}}}, {Matrix{{1.0}}}, {Matrix{{1.0}}, Matrix{{-1.0}}}});
  const auto upper = [](double p) { return Complex(-0.5, std::sqrt(0.75 - p)); };
  const PathNode left = family.point(0.5, alone({upper(0.5)}));
  const PathNode right = family.point(0.74, alone({upper(0.74)}));
  EXPECT_LT(error_as_block(left, right, 0, {{true, 0, 0.01}}, 0.24, least_gap), 1e-10);
  EXPECT_GT(error_as_block(left, right, 0, {}, 0.24, least_gap), 1e-4);
}

TEST(ErrorAsBlock, SeesPartnersInTheChartOfTheTrack) {
  constexpr double eps = 0.03;
  Planted family = Planted::frequencies(veering_at_zero(eps));
  const auto at = [&](double p) {
    const std::vector<Complex> s = veering_roots(p, eps);
    return family.point(p, {{{s[0]}}, {{s[1]}, Chart::reciprocal}});
  };
  // 1/s of a series to p^5 is one to p^5: the square of the difference is a polynomial as before.
  EXPECT_LT(error_as_block(at(-0.2), at(0.2), 0, {{false, 1, eps}}, 0.4, least_gap), rounding / eps);
}

/// Those of equal parts have a series, that of their mean.
TEST(ErrorAsBlock, TakesMembersThatCoincideAsOne) {
  Planted family = Planted::frequencies(uncoupled(Matrix{{2.0, 0.5}, {2.0, 0.5}, {2.5, 0.3}}));
  const PathNode left = family.point(0.0, {{{2.5 * j}}, {{2.0 * j, 2.0 * j}}});
  const PathNode right = family.point(0.2, {{{2.56 * j}}, {{2.1 * j, 2.1 * j}}});
  EXPECT_EQ(distinct_eigenvalues(left.tracks[1]), 1);
  EXPECT_LT(error_as_block(left, right, 0, {{false, 1, 0.0}}, 0.2, least_gap), rounding);
}

TEST(DistinctEigenvalues, CountsAllWhereOnlySomeCoincide) {
  Planted family = Planted::frequencies(uncoupled(Matrix{{2.0, 0.5}, {2.0, 0.5}, {2.7, 0.3}}));
  EXPECT_EQ(distinct_eigenvalues(family.point(0.0, {{{2.0 * j, 2.0 * j, 2.7 * j}}}).tracks[0]), 3);
}

TEST(ErrorAsBlock, IsUnknownWhereOneEndHasMoreMembers) {
  Planted family = Planted::frequencies(uncoupled(Matrix{{2.0, 0.5}, {2.5, 0.3}}));
  const PathNode left = family.point(0.0, alone({2.0 * j}));
  const PathNode right = family.point(0.2, {{{2.1 * j, 2.56 * j}}});
  EXPECT_TRUE(std::isinf(error_as_block(left, right, 0, {}, 0.2, least_gap)));
}

/// Two eigenvalues whose distance at an end is far below the least gap: the estimate stays bounded.
TEST(ErrorAsBlock, CountsRootsAsNoCloserThanTheLeastGap) {
  constexpr double eps = 1e-5;
  Planted family = Planted::frequencies(
      {Matrix{{2.0, eps}, {eps, 2.0}}, Matrix{{1.0, 0.0}, {0.0, -1.0}}, Matrix{{0.3, 0.0}, {0.0, 0.1}}});
  const auto roots = [&](double p) {
    const Vector w = Eigen::SelfAdjointEigenSolver<Matrix>(
                         Matrix{{2.0 + p + 0.3 * p * p, eps}, {eps, 2.0 - p + 0.1 * p * p}})
                         .eigenvalues();
    return std::vector<Complex>{w[0] * j, w[1] * j};
  };
  const PathNode left = family.point(-1e-2, alone(roots(-1e-2)));
  const PathNode right = family.point(-1e-3, alone(roots(-1e-3)));
  const std::vector<Partner> partner{{false, 1, eps}};
  const double loose = error_as_block(left, right, 0, partner, 9e-3, 0.1);
  const double strict = error_as_block(left, right, 0, partner, 9e-3, 1e-9);
  EXPECT_LT(loose, 0.1 * strict);
  EXPECT_LT(loose, 1e-6);
}

}  // namespace
}  // namespace eigentrail::test::grouping_errors_test
