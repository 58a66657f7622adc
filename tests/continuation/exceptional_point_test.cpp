// Exceptional points at complex places against closed forms.
#include "continuation/events/exceptional_point.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

namespace eigentrail::test::exceptional_point_test {
namespace {

constexpr Complex i(0.0, 1.0);

/// mu^2 + C mu + K(h) with K = [1 + h, e; e, 1 - h].
ReducedPencil veering(double e, const Matrix& C = Matrix::Zero(2, 2)) {
  return {{Matrix::Identity(2, 2)}, {C}, {Matrix{{1.0, e}, {e, 1.0}}, Matrix{{1.0, 0.0}, {0.0, -1.0}}}, {}};
}

/// Eigenvalues at a complex place by the companion form.
ComplexVector eigenvalues_at(const ReducedPencil& pencil, Complex h) {
  const Eigen::Index n = pencil.size();
  ComplexMatrix K = ComplexMatrix::Zero(n, n);
  for (std::size_t k = pencil.K.size(); k-- > 0;) K = h * K + pencil.K[k].cast<Complex>();
  ComplexMatrix a = ComplexMatrix::Zero(2 * n, 2 * n);
  a.topRightCorner(n, n).setIdentity();
  a.bottomLeftCorner(n, n) = -K;
  a.bottomRightCorner(n, n) = -pencil.C[0].cast<Complex>();
  return Eigen::ComplexEigenSolver<ComplexMatrix>(a, false).eigenvalues();
}

/// Distance of the two eigenvalues nearest to mu.
double gap_at(const ReducedPencil& pencil, const ExceptionalPoint& point) {
  ComplexVector all = eigenvalues_at(pencil, point.h);
  std::sort(all.begin(), all.end(),
            [&](Complex a, Complex b) { return std::abs(a - point.mu) < std::abs(b - point.mu); });
  return std::abs(all[0] - all[1]);
}

/// mu^2 = -(1 +- sqrt(h^2 + e^2)): exceptional points at +- i e.
TEST(ExceptionalPoint, OfAVeeringIsFoundFromANearPlace) {
  for (const double e : {1e-1, 1e-3, 1e-6}) {
    const ReducedPencil pencil = veering(e);
    const auto point =
        find_exceptional_point(pencil, Chart::finite, Complex(0.1 * e, 0.8 * e), 1.01 * i, 3.0 * e, {});
    ASSERT_TRUE(point) << e;
    EXPECT_LT(std::abs(point->h - i * e), 1e-9 * e);
    EXPECT_LT(std::abs(point->mu - i), 1e-6);
    // mu_a, b = i (1 +- sqrt(h^2 + e^2) / 2): the square of half the distance is -(h^2 + e^2) / 4.
    EXPECT_LT(std::abs(point->slope - (-0.5 * i * e)), 1e-3 * e);
    if (e < 0.01) {
      EXPECT_LT(std::abs(point->next + i * e), 0.05 * e) << "the other one, on the other side of the axis";
    }
  }
}

/// One freedom, s^2 + 2 s + 1 - h^2 - e^2: real eigenvalues that nearly meet at h = 0.
TEST(ExceptionalPoint, OfOneFreedomIsFound) {
  constexpr double e = 2e-4;
  const ReducedPencil pencil{
      {Matrix{{1.0}}}, {Matrix{{2.0}}}, {Matrix{{1.0 - e * e}}, Matrix{{0.0}}, Matrix{{-1.0}}}, {}};
  const auto point = find_exceptional_point(pencil, Chart::finite, Complex(1e-5, 1.9e-4), -1.0, 1e-3, {});
  ASSERT_TRUE(point);
  EXPECT_LT(std::abs(point->h - i * e), 1e-9 * e);
  EXPECT_LT(std::abs(point->mu + 1.0), 1e-9);
  const auto below = eigenvalues_below(pencil, Chart::finite, *point);
  ASSERT_TRUE(below);
  EXPECT_NEAR(std::abs((*below)[0].mu - (*below)[1].mu), 2.0 * e, 1e-9);
  EXPECT_EQ((*below)[0].z.size(), 1);
}

TEST(ExceptionalPoint, ThatIsKnownIsNotFoundAgain) {
  const ReducedPencil pencil = veering(0.01);
  const auto other =
      find_exceptional_point(pencil, Chart::finite, Complex(0.001, 0.008), i, 0.1, {Complex(0.0, 0.01)});
  ASSERT_TRUE(other);
  EXPECT_LT(std::abs(other->h + 0.01 * i), 1e-10);
  const std::vector<Complex> both{Complex(0.0, 0.01), Complex(0.0, -0.01)};
  for (const double reach : {0.1, 1e9})
    EXPECT_FALSE(find_exceptional_point(pencil, Chart::finite, Complex(0.001, 0.008), i, reach, both));
}

/// Different damping and a weak coupling: two exceptional points on one side of the axis, 2e-4 apart.
TEST(ExceptionalPoint, TwoCloseOnesAreToldApart) {
  const ReducedPencil pencil = veering(1e-4, Vector{{0.02, 0.06}}.asDiagonal());
  // Without coupling the eigenvalues coincide where 1 + h - (0.01)^2 and 1 - h - (0.03)^2 do, off the axis.
  const Complex start(0.0, 0.02);
  const auto mean = mean_at(pencil, Chart::finite, 0.0, start, {Complex(-0.01, 1.0), Complex(-0.03, 1.0)});
  ASSERT_TRUE(mean);
  std::vector<Complex> known;
  for (int k = 0; k < 2; ++k) {
    const auto point = find_exceptional_point(pencil, Chart::finite, start, *mean, 0.02, known);
    ASSERT_TRUE(point) << k;
    EXPECT_LT(gap_at(pencil, *point), 1e-6);
    EXPECT_GT(point->h.imag(), 0.01);
    if (k == 0) {
      EXPECT_NEAR(std::abs(point->next - point->h), 2e-4, 2e-5);
    } else {
      EXPECT_NEAR(std::abs(known[0] - point->h), 2e-4, 1e-5);
    }
    known.push_back(point->h);
  }
}

/// Without coupling nothing coalesces, although the eigenvalues are equal there: either Newton's method does
/// not converge, or the next root is the same.
TEST(ExceptionalPoint, EqualEigenvaluesOfIndependentModesAreNone) {
  const ReducedPencil pencil = veering(0.0, Vector{{0.02, 0.06}}.asDiagonal());
  const auto point =
      find_exceptional_point(pencil, Chart::finite, Complex(0.0, 0.02), Complex(-0.02, 1.0), 0.02, {});
  EXPECT_TRUE(!point || std::abs(point->next - point->h) < 1e-5 * point->h.imag());
}

TEST(ExceptionalPoint, BelongsToTheTwoEigenvaluesBelowIt) {
  const double e = 0.02;
  const ReducedPencil pencil = veering(e);
  const auto point = find_exceptional_point(pencil, Chart::finite, 0.9 * e * i, i, 0.1, {});
  ASSERT_TRUE(point);
  const auto below = eigenvalues_below(pencil, Chart::finite, *point);
  ASSERT_TRUE(below);
  std::array<double, 2> found{(*below)[0].mu.imag(), (*below)[1].mu.imag()};
  std::sort(found.begin(), found.end());
  EXPECT_NEAR(found[0], std::sqrt(1.0 - e), 1e-10);
  EXPECT_NEAR(found[1], std::sqrt(1.0 + e), 1e-10);
  for (const EigenvalueBelow& one : *below) {
    const ComplexMatrix P = one.mu * one.mu * ComplexMatrix::Identity(2, 2) + pencil.K[0].cast<Complex>();
    EXPECT_LT((P * one.z).norm(), 1e-9);
  }
}

/// The same eigenvalues as 1 / s.
TEST(ExceptionalPoint, InTheOtherChart) {
  const ReducedPencil pencil = veering(0.01);
  const auto point = find_exceptional_point(pencil, Chart::reciprocal, 0.008 * i, -i, 0.1, {});
  ASSERT_TRUE(point);
  EXPECT_LT(std::abs(point->h - 0.01 * i), 1e-10);
  EXPECT_LT(std::abs(point->mu + i), 1e-3);
}

}  // namespace
}  // namespace eigentrail::test::exceptional_point_test
