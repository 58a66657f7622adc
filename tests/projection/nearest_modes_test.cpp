// The eigenvalues nearest to a shift against the whole spectrum by QZ.
#include "projection/nearest_modes.hpp"

#include <gtest/gtest.h>

#include <random>

#include "eigentrail/modes/spectrum.hpp"
#include "support/families.hpp"
#include "support/spectra.hpp"

namespace eigentrail::test::nearest_modes_test {
namespace {

constexpr double accuracy = 1e-12;

Matrix stiffness(Eigen::Index n) {
  Matrix K = Matrix::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    K(i, i) = 2.0 + 0.1 * static_cast<double>(i);
    if (i > 0) K(i, i - 1) = K(i - 1, i) = -1.0;
  }
  return K;
}

SparsePencil pencil_of(const Matrix& M, const Matrix& C, const Matrix& K) {
  SparsePencil pencil{M.sparseView(), C.sparseView(), K.sparseView()};
  const auto symmetric = [](const Matrix& A) { return A == A.transpose(); };
  pencil.symmetric = symmetric(M) && symmetric(C) && symmetric(K);
  pencil.one_sided = pencil.symmetric || (symmetric(M) && symmetric(K) && C == -C.transpose());
  return pencil;
}

Matrix skew(Eigen::Index n, unsigned seed) {
  std::mt19937_64 engine(seed);
  const Matrix A = random_matrix(n, n, engine);
  return 0.1 * (A - A.transpose());
}

/// Every eigenvalue that was found is one of the spectrum, with its vectors; and within the radius nothing is
/// missing.
void expect_nearest(const Matrix& M, const Matrix& C, const Matrix& K, const Shift& shift, int count) {
  const SparsePencil pencil = pencil_of(M, C, K);
  const auto pencil_at = [&](Complex s) { return ComplexMatrix(s * s * M + s * C + K); };
  ModeFinder finder(accuracy);
  const std::optional<NearestModes> modes = finder.find(pencil, {shift, count});
  ASSERT_TRUE(modes);
  EXPECT_GE(modes->s.size(), count - 1);
  const Spectrum spectrum = compute_spectrum(M, C, K);
  int within = 0, found_within = 0;
  for (const StartingMode& mode : spectrum.modes)
    within += std::abs(mode.s - shift.value()) < 0.999 * modes->radius ? 1 : 0;
  for (Eigen::Index i = 0; i < modes->s.size(); ++i) {
    const Complex s = modes->s[i];
    double nearest = 1e300;
    for (const StartingMode& mode : spectrum.modes) nearest = std::min(nearest, std::abs(mode.s - s));
    EXPECT_LT(nearest, 1e-8 * std::abs(s)) << s;
    found_within += std::abs(s - shift.value()) < 0.999 * modes->radius ? 1 : 0;
    EXPECT_LT((pencil_at(s) * modes->right.col(i)).norm(), 1e-7 * std::abs(s)) << s;
  }
  EXPECT_EQ(found_within, within);
  EXPECT_EQ(modes->left.cols() > 0, !pencil.one_sided);
  // Every left vector belongs to one of the eigenvalues.
  for (Eigen::Index i = 0; i < modes->left.cols(); ++i) {
    double least = 1e300;
    for (const StartingMode& mode : spectrum.modes)
      least = std::min(least, (pencil_at(mode.s).transpose() * modes->left.col(i)).norm());
    EXPECT_LT(least, 1e-7);
  }
}

constexpr Eigen::Index size = 40;

TEST(NearestModes, WithoutDamping) {
  expect_nearest(Matrix::Identity(size, size), Matrix::Zero(size, size), stiffness(size), {}, 6);
}

TEST(NearestModes, WithoutDampingBeyondADivergence) {
  Matrix K = stiffness(size);
  K(3, 3) -= 4.0;
  expect_nearest(Matrix::Identity(size, size), Matrix::Zero(size, size), K, {}, 6);
}

TEST(NearestModes, GyroscopicWithoutDamping) {
  expect_nearest(Matrix::Identity(size, size), skew(size, 1), stiffness(size), {}, 6);
}

TEST(NearestModes, DampedAndGyroscopic) {
  expect_nearest(Matrix::Identity(size, size), skew(size, 2) + 0.05 * stiffness(size), stiffness(size), {},
                 6);
}

TEST(NearestModes, Circulatory) {
  expect_nearest(Matrix::Identity(size, size), 0.05 * stiffness(size), stiffness(size) + skew(size, 3), {},
                 6);
}

TEST(NearestModes, FirstOrder) {
  expect_nearest(Matrix::Zero(size, size), Matrix::Identity(size, size), stiffness(size) + skew(size, 4), {},
                 5);
}

TEST(NearestModes, AboutAFrequency) {
  expect_nearest(Matrix::Identity(size, size), skew(size, 5) + 0.02 * stiffness(size), stiffness(size),
                 {0.0, 1.7}, 5);
}

TEST(NearestModes, AboutAFrequencyWithoutDamping) {
  expect_nearest(Matrix::Identity(size, size), Matrix::Zero(size, size), stiffness(size), {0.0, 1.7}, 5);
}

TEST(NearestModes, AboutAFrequencyInFirstOrder) {
  expect_nearest(Matrix::Zero(size, size), Matrix::Identity(size, size),
                 0.2 * stiffness(size) + 10.0 * skew(size, 6), {0.0, 3.0}, 5);
}

/// A chain of equal masses and springs without a support, and its frequencies.
Matrix free_chain(double stiffness) {
  Matrix K = Matrix::Zero(size, size);
  for (Eigen::Index i = 1; i < size; ++i) {
    K(i, i) += stiffness;
    K(i - 1, i - 1) += stiffness;
    K(i, i - 1) = K(i - 1, i) = -stiffness;
  }
  return K;
}
double free_chain_frequency(double stiffness, Eigen::Index mode) {
  return 2.0 * std::sqrt(stiffness) * std::sin(0.5 * M_PI * static_cast<double>(mode) / size);
}

void expect_frequencies(const NearestModes& modes, double stiffness, Eigen::Index first, Eigen::Index last) {
  for (Eigen::Index j = first; j <= last; ++j) {
    const Complex s(0.0, free_chain_frequency(stiffness, j));
    EXPECT_LT((modes.s.array() - s).abs().minCoeff(), 1e-8) << stiffness << ", mode " << j;
  }
}

/// The chain has a mode at zero, on which the shift lies: the first place needs three factorizations, one
/// that fails, one close to zero that tells where the others are and one between, and each further one a
/// single one.
TEST(NearestModes, ShiftThatWasMovedOffARigidBodyMotionIsRemembered) {
  const Matrix M = Matrix::Identity(size, size), C = Matrix::Zero(size, size);
  ModeFinder finder(accuracy);
  int before = 0;
  for (const double k : {1.0, 1.2, 1.5, 2.0}) {
    const auto modes = finder.find(pencil_of(M, C, free_chain(k)), {{}, 5});
    ASSERT_TRUE(modes);
    expect_frequencies(*modes, k, 1, 4);
    EXPECT_EQ(finder.factorizations() - before, before == 0 ? 3 : 1);
    before = finder.factorizations();
  }
}

/// The shift lies on the third frequency of the first chain. At places where a frequency comes upon the moved
/// shift, it is given up.
TEST(NearestModes, RememberedShiftThatMeetsAnotherEigenvalueIsGivenUp) {
  const Matrix M = Matrix::Identity(size, size), C = Matrix::Zero(size, size);
  const Shift shift{0.0, free_chain_frequency(1.0, 3)};
  const double gap = shift.frequency - free_chain_frequency(1.0, 2);
  const double upon = std::pow(1.0 - 0.3 * gap / shift.frequency, 2);  // brings the third frequency there
  ModeFinder finder(accuracy);
  int before = 0;
  for (const double k : {1.0, 1.01, 0.9, upon, 0.8, 1.0}) {
    const auto modes = finder.find(pencil_of(M, C, free_chain(k)), {shift, 5});
    ASSERT_TRUE(modes);
    expect_frequencies(*modes, k, 2, 4);
    EXPECT_LE(finder.factorizations() - before, 3) << k;
    before = finder.factorizations();
  }
}

/// Free chains have a mode at zero, on which the shift lies.
TEST(NearestModes, RigidBodyMotion) {
  Matrix K = Matrix::Zero(size, size);
  for (Eigen::Index i = 1; i < size; ++i) {
    K(i, i) += 1.0;
    K(i - 1, i - 1) += 1.0;
    K(i, i - 1) = K(i - 1, i) = -1.0;
  }
  const SparsePencil pencil = pencil_of(Matrix::Identity(size, size), Matrix::Zero(size, size), K);
  ModeFinder finder(accuracy);
  const auto modes = finder.find(pencil, {{}, 5});
  ASSERT_TRUE(modes);
  for (Eigen::Index j = 1; j < 5; ++j) {
    const double exact = 2.0 * std::sin(0.5 * M_PI * static_cast<double>(j) / size);
    double nearest = 1e300;
    for (const Complex s : modes->s) nearest = std::min(nearest, std::abs(s - Complex(0.0, exact)));
    EXPECT_LT(nearest, 1e-10 * exact) << j;
  }
  EXPECT_GE(finder.factorizations(), 2);
}

/// All eigenvalues within a distance that is asked for.
TEST(NearestModes, CoversADistance) {
  const Matrix M = Matrix::Identity(size, size), C = skew(size, 7) + 0.01 * stiffness(size),
               K = stiffness(size);
  ModeFinder finder(accuracy);
  const auto modes = finder.find(pencil_of(M, C, K), {{}, 3, 1.5, 40});
  ASSERT_TRUE(modes);
  EXPECT_GE(modes->radius, 1.5);
  EXPECT_EQ(finder.factorizations(), 1);
}

}  // namespace
}  // namespace eigentrail::test::nearest_modes_test
