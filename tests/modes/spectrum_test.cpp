#include "eigentrail/modes/spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/families.hpp"
#include "support/spectra.hpp"

namespace eigentrail::test {
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

TEST(Spectrum, IsSortedByMagnitude) {
  const ReducedPencil pencil = at(random_family(9, 4), 0.0);
  const Spectrum spectrum = compute_spectrum(pencil.M[0], pencil.C[0], pencil.K[0]);
  for (std::size_t i = 1; i < spectrum.modes.size(); ++i) {
    EXPECT_LE(std::abs(spectrum.modes[i - 1].s), std::abs(spectrum.modes[i].s));
  }
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

TEST(Spectrum, RigidBodyModesAreZeros) {
  const Matrix K{{1.0, -1.0}, {-1.0, 1.0}};
  const Spectrum spectrum = compute_spectrum(Matrix::Identity(2, 2), Matrix::Zero(2, 2), K);
  ASSERT_EQ(spectrum.status, SpectrumStatus::complete);
  EXPECT_NEAR(std::abs(spectrum.modes.front().s), 0.0, 1e-7);
  EXPECT_NEAR(spectrum.modes.back().s.imag(), std::sqrt(2.0), 1e-13);
}

TEST(Spectrum, NoFreedomsNoModes) {
  const Spectrum spectrum = compute_spectrum(Matrix(0, 0), Matrix(0, 0), Matrix(0, 0));
  EXPECT_TRUE(spectrum.modes.empty());
}

}  // namespace
}  // namespace eigentrail::test
