// Blocks in the basis of the left end of their step: the eigenvalues do not change, and the interpolated
// functions are smooth whatever bases the two points had before.
#include "continuation/step/shared_basis.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>

#include "continuation/planted_points.hpp"
#include "core/matrix_series.hpp"
#include "eigentrail/modes/invariants.hpp"
#include "support/families.hpp"

namespace eigentrail::test::shared_basis_test {
namespace {

using Coefficients = std::vector<ComplexMatrix>;

constexpr double rounding = 1e-13;  ///< of a few products of matrices of order one
constexpr std::size_t count = 5;

Coefficients random_series(Eigen::Index rows, Eigen::Index columns, std::mt19937_64& engine) {
  Coefficients series;
  for (std::size_t k = 0; k < count; ++k) series.push_back(random_complex(rows, columns, engine));
  return series;
}

/// W0^H Z + W1^H Z Lambda, which a fixed basis makes the unit matrix.
Coefficients normalization(const ComplexMatrix& W, const Coefficients& Z, const Coefficients& Lambda) {
  const Eigen::Index n = Z[0].rows();
  const Coefficients ZL = multiply_series(Z, Lambda, count);
  Coefficients N;
  for (std::size_t k = 0; k < count; ++k)
    N.emplace_back(W.topRows(n).adjoint() * Z[k] + W.bottomRows(n).adjoint() * ZL[k]);
  return N;
}

/// A block (Z S, S^-1 Lambda S) with any series S that is regular at zero.
void turn(const Coefficients& S, Coefficients& Z, Coefficients& Lambda) {
  Z = multiply_series(Z, S, count);
  Lambda = multiply_series(inverse_series(S), multiply_series(Lambda, S, count), count);
}

class FixedBasis : public testing::TestWithParam<int> {
 protected:
  std::mt19937_64 engine{static_cast<unsigned>(GetParam())};
  Coefficients Z = random_series(6, GetParam(), engine);
  Coefficients Lambda = random_series(GetParam(), GetParam(), engine);
  ComplexMatrix W = random_complex(12, GetParam(), engine);
};

/// The inverses of random normalizations have condition numbers of up to some hundred. Each order of the
/// series multiplies the error by one of them.
constexpr double after_inverses = 1e-8;

TEST_P(FixedBasis, IsNormalizedAtEveryOrder) {
  fix_basis(W, Z, Lambda);
  const Coefficients N = normalization(W, Z, Lambda);
  EXPECT_LT((N[0] - ComplexMatrix::Identity(GetParam(), GetParam())).norm(), after_inverses);
  for (std::size_t k = 1; k < count; ++k) EXPECT_LT(N[k].norm(), after_inverses * Z[k].norm()) << k;
}

TEST_P(FixedBasis, KeepsTheEigenvalues) {
  Coefficients fixed = Lambda;
  fix_basis(W, Z, fixed);
  // Traces of powers are series that no basis changes.
  Coefficients power = Lambda;
  Coefficients fixed_power = fixed;
  for (int k = 0; k < GetParam(); ++k) {
    for (std::size_t i = 0; i < count; ++i) {
      const double size = std::max(1.0, fixed_power[i].norm());
      EXPECT_LT(std::abs(power[i].trace() - fixed_power[i].trace()), after_inverses * size) << i;
    }
    power = multiply_series(power, Lambda, count);
    fixed_power = multiply_series(fixed_power, fixed, count);
  }
}

TEST_P(FixedBasis, IsTheSameFromWhateverBasis) {
  Coefficients other_Z = Z;
  Coefficients other = Lambda;
  Coefficients S = random_series(GetParam(), GetParam(), engine);
  S[0] += 5.0 * ComplexMatrix::Identity(GetParam(), GetParam());
  turn(S, other_Z, other);
  fix_basis(W, Z, Lambda);
  fix_basis(W, other_Z, other);
  for (std::size_t k = 0; k < count; ++k) {
    EXPECT_LT((Z[k] - other_Z[k]).norm(), after_inverses * Z[k].norm()) << k;
    EXPECT_LT((Lambda[k] - other[k]).norm(), after_inverses * std::max(1.0, Lambda[k].norm())) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, FixedBasis, testing::Values(2, 3, 4));

/// z = (1, h), w = (1, 1): z / (1 + h) = (1 - h + h^2 - ..., h - h^2 + ...).
TEST(FixLength, DividesByTheSeriesOfTheLength) {
  Coefficients Z(count, ComplexMatrix::Zero(2, 1));
  Z[0](0, 0) = 1.0;
  Z[1](1, 0) = 1.0;
  fix_length(ComplexVector{{1.0, 1.0}}, Z);
  for (std::size_t k = 0; k < count; ++k) {
    const double sign = k % 2 == 0 ? 1.0 : -1.0;
    EXPECT_LT(std::abs(Z[k](0, 0) - sign), rounding) << k;
    EXPECT_LT(std::abs(Z[k](1, 0) - (k == 0 ? 0.0 : -sign)), rounding) << k;
  }
}

TEST(FixLength, HasNoneAcrossTheVector) {
  Coefficients Z(count, ComplexMatrix::Ones(2, 1));
  fix_length(ComplexVector{{1.0, -1.0}}, Z);
  EXPECT_FALSE(Z[0].allFinite());
}

/// x1 cos p + x2 sin p = 0 beside a free x3, x4: the tangent space turns.
Planted turning() {
  const Matrix M = Matrix::Identity(4, 4);
  const Matrix K = Vector{{1.0, 4.0, 9.0, 16.0}}.asDiagonal();
  return Planted({{M}, {}, {K}, {Matrix{{1.0, 0.2, 0.0, 0.0}}, Matrix{{0.0, 1.0, 0.3, 0.0}}}});
}

/// Frequencies 2 + eigenvalues of N(p): three that turn about each other. N is symmetric.
const Matrix N0{{0.1, 0.2, 0.0}, {0.2, -0.1, 0.1}, {0.0, 0.1, 0.05}};
const Matrix N1{{0.3, 0.0, 0.2}, {0.0, -0.2, 0.1}, {0.2, 0.1, 0.1}};

ComplexVector turning_roots(double p) {
  const Matrix W = 2.0 * Matrix::Identity(3, 3) + N0 + p * N1;
  return j * Eigen::SelfAdjointEigenSolver<Matrix>(W).eigenvalues().cast<Complex>();
}

std::vector<Complex> listed(const ComplexVector& roots) {
  return {roots.begin(), roots.end()};
}

class BlockOfThree : public testing::Test {
 protected:
  Planted family = Planted::frequencies({2.0 * Matrix::Identity(3, 3) + N0, N1});
  static constexpr double length = 0.2;
  PathNode left = family.point(0.1, {{listed(turning_roots(0.1))}});
  PathNode right = family.point(0.1 + length, {{listed(turning_roots(0.1 + length))}});

  double miss_in_the_middle(const ComplexMatrix& a, const ComplexMatrix& b) const {
    const ComplexVector expected = turning_roots(0.1 + 0.5 * length);
    const ComplexVector found = block_roots(HermiteInterpolant(length, a, b)(0.5));
    return (in_order_of(expected, found) - expected).cwiseAbs().maxCoeff();
  }

  /// Changes the basis of the block at the right end.
  void turn_right() {
    std::mt19937_64 engine(11);
    Coefficients S{random_complex(3, 3, engine)};
    Track& track = right.tracks[0];
    S.resize(track.series.Z.size(), ComplexMatrix::Zero(3, 3));
    track.series.Z = multiply_series(track.series.Z, S, S.size());
    const Coefficients product = multiply_series(track.series.Lambda, S, S.size());
    track.series.Lambda = multiply_series(inverse_series(S), product, S.size());
    track.functions = block_functions(track.series.Lambda);
  }
};

/// The interpolant of order 5 on a step of 0.2, singularities some 0.7 away: (0.1 / 0.7)^12.
constexpr double interpolation = 1e-9;

TEST_F(BlockOfThree, IsInterpolatedInOneBasis) {
  const DenseBlock block = block_on_step(left, right, 0);
  EXPECT_EQ(block.size(), 3);
  EXPECT_LT(miss_in_the_middle(block.left, block.right), interpolation);
  turn_right();
  const DenseBlock turned = block_on_step(left, right, 0);
  EXPECT_LT(miss_in_the_middle(turned.left, turned.right), interpolation);
  // In the original bases of the two points, which are unrelated, the interpolation fails.
  EXPECT_GT(miss_in_the_middle(left.tracks[0].functions, right.tracks[0].functions), 1e-2);
}

TEST(FunctionsOnStep, StayInTheChart) {
  // (1 - p) s^2 + 0.5 s + 1 = 0: mu = 1/s solves mu^2 + 0.5 mu + 1 - p = 0.
  Planted family({{Matrix{{1.0}}, Matrix{{-1.0}}}, {Matrix{{0.5}}}, {Matrix{{1.0}}}});
  const auto mu = [](double p) { return -0.25 + std::sqrt(0.0625 - 1.0 + p); };
  const PathNode left = family.point(0.98, {{{1.0 / mu(0.98)}, Chart::reciprocal}});
  const PathNode right = family.point(1.02, {{{1.0 / mu(1.02)}, Chart::reciprocal}});
  EXPECT_EQ(block_on_step(left, right, 0).chart, Chart::reciprocal);
  // Through infinity at p = 1; the branch point lies 0.0425 before the left end.
  const HermiteInterpolant functions = functions_on_step(left, right, 0, 0.04);
  EXPECT_LT(std::abs(functions(0.5)[0]), 1e-8);
  EXPECT_LT(std::abs(functions(0.75)[0] - mu(1.01)), 1e-8);
}

/// With constraints the right end's vectors are seen in the left end's basis.
TEST(BlockOnStep, OfAConstrainedSystemIsSmooth) {
  Planted family = turning();
  const auto all = [&](double p) {
    const PathPoint point = family.reduced(p);
    const Eigen::SelfAdjointEigenSolver<Matrix> solver(point.pencil.K[0]);
    return ComplexVector(j * solver.eigenvalues().cwiseSqrt().cast<Complex>());
  };
  constexpr double length = 0.2;
  const PathNode left = family.point(0.0, {{listed(all(0.0))}});
  const PathNode right = family.point(length, {{listed(all(length))}});
  const DenseBlock block = block_on_step(left, right, 0);
  const ComplexVector expected = all(0.5 * length);
  const ComplexVector found = block_roots(HermiteInterpolant(length, block.left, block.right)(0.5));
  EXPECT_LT((in_order_of(expected, found) - expected).norm(), 1e-8);
}

}  // namespace
}  // namespace eigentrail::test::shared_basis_test
