#include "eigentrail/modes/spectrum.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "eigentrail/modes/regroup.hpp"
#include "support/families.hpp"
#include "support/spectra.hpp"

namespace eigentrail::test::spectrum_test {
namespace {

/// Members with Im s >= 0 and their conjugates.
std::vector<Complex> with_conjugates(const Spectrum& spectrum) {
  std::vector<Complex> all;
  for (const StartingMode& mode : spectrum.modes) {
    all.push_back(mode.s);
    if (mode.s.imag() > 0.0) all.push_back(std::conj(mode.s));
  }
  return all;
}

TEST(Spectrum, AgreesWithTheUnscaledCompanionForm) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const ReducedPencil pencil = at(random_family(7, seed), 0.0);
    const Spectrum spectrum = compute_spectrum(pencil.M[0], pencil.C[0], pencil.K[0]);
    ASSERT_EQ(spectrum.status, SpectrumStatus::complete);
    EXPECT_LT(matched_distance(with_conjugates(spectrum),
                               quadratic_eigenvalues(pencil.M[0], pencil.C[0], pencil.K[0])),
              1e-11);
  }
}

TEST(Spectrum, VectorsSatisfyThePencil) {
  const ReducedPencil pencil = at(random_family(7, 3), 0.0);
  for (const StartingMode& mode : compute_spectrum(pencil.M[0], pencil.C[0], pencil.K[0]).modes) {
    const ComplexMatrix P = mode.s * mode.s * pencil.M[0].cast<Complex>() +
                            mode.s * pencil.C[0].cast<Complex>() + pencil.K[0].cast<Complex>();
    EXPECT_LT((P * mode.z).norm(), 1e-12 * P.norm());
  }
}

/// Eigenvalues with and without vectors, by whichever way they are computed.
double difference_without_vectors(const Matrix& M, const Matrix& C, const Matrix& K) {
  const Spectrum with = compute_spectrum(M, C, K);
  const Spectrum without = compute_eigenvalues(M, C, K);
  EXPECT_EQ(without.status, with.status);
  EXPECT_EQ(without.n_infinite, with.n_infinite);
  EXPECT_EQ(without.modes.size(), with.modes.size());
  for (const StartingMode& mode : without.modes) EXPECT_EQ(mode.z.size(), 0);
  return matched_distance(with_conjugates(without), with_conjugates(with));
}

TEST(Eigenvalues, AreThoseOfTheSpectrum) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const ReducedPencil pencil = at(random_family(7, seed), 0.0);
    EXPECT_LT(difference_without_vectors(pencil.M[0], pencil.C[0], pencil.K[0]), 1e-11);
  }
}

TEST(Eigenvalues, AreThoseOfTheSpectrumWhereTheMassHasNoInverse) {
  const ReducedPencil pencil = at(random_family(7, 2), 0.0);
  Matrix M = pencil.M[0];
  M.row(3).setZero();
  M.col(3).setZero();
  EXPECT_GT(compute_eigenvalues(M, pencil.C[0], pencil.K[0]).n_infinite, 0);
  EXPECT_LT(difference_without_vectors(M, pencil.C[0], pencil.K[0]), 1e-10);
  M(3, 3) = 1e-9;
  EXPECT_EQ(compute_eigenvalues(M, pencil.C[0], pencil.K[0]).n_infinite, 0);
}

TEST(Eigenvalues, SingularPencilIsTold) {
  Matrix K = Matrix::Identity(3, 3);
  K(2, 2) = 0.0;
  EXPECT_EQ(compute_eigenvalues(K, Matrix::Zero(3, 3), K).status, SpectrumStatus::singular_pencil);
}

TEST(EigenvectorNear, SatisfiesThePencilFromAnEigenvalueAlone) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const ReducedPencil pencil = at(random_family(9, seed), 0.0);
    for (const StartingMode& mode : compute_eigenvalues(pencil.M[0], pencil.C[0], pencil.K[0]).modes) {
      const ComplexVector z = eigenvector_near(pencil.M[0], pencil.C[0], pencil.K[0], mode.s, 1e-3);
      const ComplexMatrix P = mode.s * mode.s * pencil.M[0].cast<Complex>() +
                              mode.s * pencil.C[0].cast<Complex>() + pencil.K[0].cast<Complex>();
      EXPECT_LT((P * z).norm(), 1e-8 * P.norm());
      EXPECT_NEAR(z.norm(), 1.0, 1e-14);
    }
  }
}

TEST(EigenvectorNear, IsRealForRealEigenvalues) {
  // s = -1 and s = -2 of the first freedom, beside a pair.
  const Matrix M = Matrix::Identity(2, 2);
  const Matrix C{{3.0, 0.0}, {0.0, 0.1}};
  const Matrix K{{2.0, 0.0}, {0.3, 5.0}};
  const ComplexVector z = eigenvector_near(M, C, K, -2.0, 1e-3);
  EXPECT_TRUE(z.imag().isZero(0.0));
  EXPECT_LT((4.0 * M * z - 2.0 * C * z + K * z).norm(), 1e-7);
}

TEST(EigenvectorNear, FindsTheVectorOfAVanishingEigenvalue) {
  // A freedom with damping and no stiffness: s = 0 exactly.
  const Matrix M = Matrix::Identity(2, 2);
  const Matrix C{{0.5, 0.0}, {0.0, 0.1}};
  const Matrix K{{4.0, -4.0}, {-4.0, 4.0}};
  const ComplexVector z = eigenvector_near(M, C, K, 0.0, 1e-3);
  EXPECT_LT((K * z).norm(), 1e-10);
}

/// A lightly damped chain with the time unit 1e-7 s: M s^2 + C s + K with entries apart by 1e14.
TEST(Spectrum, ScalingSavesTheDigitsThatAnUnscaledSolutionLoses) {
  const Eigen::Index n = 6;
  const double second = 1e7;  // in the time unit
  Matrix K = 2.0 * Matrix::Identity(n, n);
  K.diagonal(1).setConstant(-1.0);
  K.diagonal(-1).setConstant(-1.0);
  const Matrix M = Matrix::Identity(n, n);
  const Matrix C = 0.01 * K;
  // s in 1/s: s^2 + 0.01 mu s + mu = 0 with mu = 2 - 2 cos(i pi / (n + 1)); s in 1/(time unit) is s / second.
  std::vector<Complex> exact;
  for (int i = 1; i <= n; ++i) {
    const double mu = 2.0 - 2.0 * std::cos(i * M_PI / (n + 1.0));
    const Complex s = Complex(-0.005 * mu, std::sqrt(mu - std::pow(0.005 * mu, 2))) / second;
    exact.push_back(s);
    exact.push_back(std::conj(s));
  }
  const Matrix scaled_C = C / second;
  const Matrix scaled_K = K / (second * second);
  EXPECT_LT(matched_distance(exact, with_conjugates(compute_spectrum(M, scaled_C, scaled_K))), 1e-13);
  EXPECT_GT(matched_distance(exact, quadratic_eigenvalues(M, scaled_C, scaled_K)), 1e-5)
      << "the rival did not lose";
}

TEST(Spectrum, SingularPencilIsRecognized) {
  // The second freedom has no mass, damping or stiffness.
  const Matrix one{{1.0, 0.0}, {0.0, 0.0}};
  EXPECT_EQ(compute_spectrum(one, 0.1 * one, 4.0 * one).status, SpectrumStatus::singular_pencil);
}

TEST(Spectrum, SingularMassGivesInfiniteEigenvalues) {
  const Matrix M{{1.0, 0.0}, {0.0, 0.0}};
  const Matrix K{{4.0, 1.0}, {1.0, 2.0}};
  const Spectrum spectrum = compute_spectrum(M, Matrix::Zero(2, 2), K);
  ASSERT_EQ(spectrum.status, SpectrumStatus::complete);
  EXPECT_EQ(spectrum.n_infinite, 2);
  ASSERT_EQ(spectrum.modes.size(), 1U);
  EXPECT_NEAR(spectrum.modes[0].s.imag(), std::sqrt(3.5), 1e-13);
}

/// Members of `spectrum` and their conjugates by distance from `centre`, the nearest k.
std::vector<Complex> nearest_to(Complex centre, const Spectrum& spectrum, std::size_t k) {
  std::vector<Complex> all = with_conjugates(spectrum);
  std::sort(all.begin(), all.end(),
            [centre](Complex a, Complex b) { return std::abs(a - centre) < std::abs(b - centre); });
  all.resize(k);
  return all;
}

/// Residual of a block relative to the size of its terms.
double relative_residual(const ReducedPencil& pencil, const InvariantPair& pair) {
  const PencilAtPoint point(pencil);
  return point.residual(pair.Z, pair.Lambda).norm() / (point.magnitude(pair.Lambda.norm()) * pair.Z.norm());
}

std::vector<Complex> block_eigenvalues(const InvariantPair& pair) {
  const ComplexVector values = pair_eigenvalues(pair);
  return {values.begin(), values.end()};
}

/// Without a mass the unit of time is that of K over C: what counts as zero must not depend on it.
TEST(Spectrum, FirstOrderEquationsHaveTheScaleOfTheirUnit) {
  const Matrix none = Matrix::Zero(3, 3), E = Matrix::Identity(3, 3);
  const Matrix A{{0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, {0.0, -4.0, -0.1}};  // a zero beside an oscillation
  const double in_seconds = compute_spectrum(none, E, -A).scale;
  EXPECT_NEAR(in_seconds, A.norm() / E.norm(), 1e-14 * in_seconds);
  for (const double unit : {1e-6, 1e6})
    EXPECT_NEAR(compute_spectrum(none, E, -unit * A).scale, unit * in_seconds, 1e-14 * unit * in_seconds);
}

TEST(InvariantSubspace, HoldsTheEigenvaluesNearestToACentre) {
  // Clusters of two and three in a spectrum of twelve; six iterations separate what is ten times farther
  // away.
  Matrix K = Matrix::Identity(6, 6);
  K.diagonal() << 1.0, 1.001, 9.0, 9.001, 9.002, 30.0;
  K(0, 1) = K(3, 4) = 2e-4;
  const ReducedPencil pencil{{Matrix::Identity(6, 6)}, {1e-3 * K}, {K}};
  const Spectrum spectrum = compute_spectrum(pencil.M[0], pencil.C[0], pencil.K[0]);
  for (const auto& [centre, k] : {std::pair(Complex(0.0, 1.0), 2), std::pair(Complex(0.0, 3.0), 3)}) {
    const InvariantPair pair = invariant_subspace(pencil.M[0], pencil.C[0], pencil.K[0], centre, k, false);
    ASSERT_EQ(pair.size(), k);
    EXPECT_LT(relative_residual(pencil, pair), 1e-9);
    const auto expected = nearest_to(centre, spectrum, static_cast<std::size_t>(k));
    EXPECT_LT(matched_distance(expected, block_eigenvalues(pair)), 1e-8);
  }
}

TEST(InvariantSubspace, IsReliableWhereVectorsCoincide) {
  // K = [[1, 1/2], [-1/2, 2]] has one vector for two eigenvalues j sqrt(3/2): QZ's two are parallel.
  const ReducedPencil pencil{
      {Matrix::Identity(2, 2)}, {Matrix::Zero(2, 2)}, {Matrix{{1.0, 0.5}, {-0.5, 2.0}}}};
  const Complex s(0.0, std::sqrt(1.5));
  const InvariantPair pair = invariant_subspace(pencil.M[0], pencil.C[0], pencil.K[0], s, 2, false);
  // The shift lies 1e-5 beside the eigenvalue: solutions have the relative error eps / 1e-5, whatever the LU.
  constexpr double limit = 2.3e-11;
  EXPECT_LT(relative_residual(pencil, pair), limit);
  EXPECT_LT(std::abs(pair.Lambda.trace() / 2.0 - s), limit);
  EXPECT_GT(pair.Z.jacobiSvd().singularValues()[1], 0.1);
  const Spectrum rival = compute_spectrum(pencil.M[0], pencil.C[0], pencil.K[0]);
  ASSERT_EQ(rival.modes.size(), 2U);
  EXPECT_GT(std::abs(rival.modes[0].z.dot(rival.modes[1].z)), 1.0 - 1e-6);
}

TEST(InvariantSubspace, OfAPairNearTheRealAxisIsReal) {
  // s^2 + 2 s + 1 + gap^2 = 0 beside a faster mode.
  for (const double gap : {0.0, 1e-9, 1e-5}) {
    const ReducedPencil pencil{{Matrix::Identity(2, 2)},
                               {Matrix{{2.0, 0.1}, {0.0, 0.3}}},
                               {Matrix{{1.0 + gap * gap, 0.1}, {0.0, 400.0}}}};
    const InvariantPair pair = invariant_subspace(pencil.M[0], pencil.C[0], pencil.K[0], -1.0, 2, true);
    EXPECT_TRUE(pair.is_real);
    EXPECT_TRUE(pair.Z.imag().isZero(0.0) && pair.Lambda.imag().isZero(0.0));
    EXPECT_LT(relative_residual(pencil, pair), 1e-12) << "gap " << gap;
    EXPECT_NEAR(pair.Lambda.trace().real(), -2.0, 1e-11) << "gap " << gap;
    EXPECT_NEAR(pair.Lambda.real().determinant(), 1.0 + gap * gap, 1e-11) << "gap " << gap;
  }
}

TEST(Spectrum, NoFreedomsNoModes) {
  const Spectrum spectrum = compute_spectrum(Matrix(0, 0), Matrix(0, 0), Matrix(0, 0));
  EXPECT_TRUE(spectrum.modes.empty());
}

}  // namespace
}  // namespace eigentrail::test::spectrum_test
