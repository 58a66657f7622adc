// The blocks in which the modes of a spectrum start, for pencils with known double, triple and nearly real
// eigenvalues. The functions of a block are known to rounding, where the spectrum gives its eigenvalues only
// to a root of rounding.
#include "continuation/tracks/starting_tracks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "continuation/planted_points.hpp"
#include "eigentrail/modes/regroup.hpp"

namespace eigentrail::test::starting_tracks_test {
namespace {

constexpr double s_ref = 1e-3;
using Modes = std::vector<int>;

Matrix diagonal(const Vector& entries) {
  return entries.asDiagonal();
}

ReducedPencil undamped(const Matrix& K) {
  return {{Matrix::Identity(K.rows(), K.rows())}, {Matrix::Zero(K.rows(), K.rows())}, {K}};
}

/// Uncoupled modes s^2 + c_i s + k_i.
ReducedPencil oscillators(const Vector& c, const Vector& k) {
  return {{Matrix::Identity(k.size(), k.size())}, {diagonal(c)}, {diagonal(k)}};
}

std::vector<StartingMode> spectrum_of(const ReducedPencil& pencil) {
  Spectrum spectrum = compute_spectrum(pencil.M[0], pencil.C[0], pencil.K[0]);
  if (spectrum.status != SpectrumStatus::complete) throw std::runtime_error("no spectrum");
  return spectrum.modes;
}

std::vector<StartingGroup> groups_of(const ReducedPencil& pencil, int n_modes, double least_scale = 0.0) {
  return starting_groups(pencil, spectrum_of(pencil), n_modes, s_ref, least_scale);
}

InvariantPair corrected(const ReducedPencil& pencil, const StartingGroup& group) {
  ModeCounts counts;
  return correct_pair(PencilAtPoint(pencil), group.pair, s_ref, {}, counts);
}

TEST(StartingGroups, VectorsThatWereNotAskedForAreFound) {
  const Matrix K{{2.0, -1.0, 0.0}, {-1.0, 3.0, -1.0}, {0.0, -1.0, 4.0}};
  const ReducedPencil pencil = undamped(K);
  Spectrum values = compute_eigenvalues(pencil.M[0], pencil.C[0], pencil.K[0]);
  ASSERT_EQ(values.modes[0].z.size(), 0);
  for (const StartingGroup& group : starting_groups(pencil, values.modes, 3, s_ref)) {
    const ComplexVector z = group.pair.Z.col(0);
    const Complex s = group.roots[0];
    EXPECT_LT((s * s * z + K * z).norm(), 1e-8 * z.norm());
  }
}

TEST(StartingGroups, DoubleOneIsABlock) {
  const ReducedPencil pencil = undamped(diagonal(Vector{{4.0, 9.0, 4.0}}));
  const auto groups = groups_of(pencil, 3);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].modes, (Modes{0, 1}));
  EXPECT_FALSE(groups[0].pair.is_real);
  const InvariantPair pair = corrected(pencil, groups[0]);
  ASSERT_EQ(pair.status, PairStatus::converged);
  EXPECT_LT((pair.Lambda - 2.0 * j * ComplexMatrix::Identity(2, 2)).norm(), 1e-13);
}

TEST(StartingGroups, OneBehindTheLastThatIsTooCloseComesAlongAsAGuard) {
  const ReducedPencil pencil = undamped(diagonal(Vector{{4.0, 9.0, 4.0}}));
  const auto groups = groups_of(pencil, 1);
  ASSERT_EQ(groups.size(), 1U);
  EXPECT_EQ(groups[0].modes, (Modes{0, Track::guard}));
  EXPECT_EQ(groups[0].roots.size(), 2);
  EXPECT_EQ(groups[0].pair.size(), 2);
}

class CloseModes : public testing::TestWithParam<double> {};

/// Relative distances on either side of 1e-4.
TEST_P(CloseModes, AreABlockWithinTheShareOfTheirSize) {
  const double distance = GetParam();
  for (const double size : {1e-2, 1.0, 1e3}) {
    const double w = size * (1.0 + distance);
    const auto groups = groups_of(undamped(diagonal(Vector{{size * size, w * w, 9e8}})), 3);
    EXPECT_EQ(groups.size(), distance < 1e-4 ? 2U : 3U) << "size " << size;
  }
}

INSTANTIATE_TEST_SUITE_P(Distances, CloseModes, testing::Values(1e-10, 1e-6, 0.9e-4, 1.1e-4, 1e-2));

TEST(StartingGroups, NeighboursOfNeighboursBelongTogether) {
  // Each is 0.8e-4 from the next; the outer ones are farther apart than what is close.
  const Vector w{{1.0, 1.0 + 0.8e-4, 1.0 + 1.6e-4, 2.0}};
  const auto groups = groups_of(undamped(diagonal(w.cwiseAbs2())), 4);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].modes, (Modes{0, 1, 2}));
}

TEST(StartingGroups, TwoPairsOfTheSameFrequencyAndDifferentDampingAreApart) {
  const auto groups = groups_of(oscillators(Vector{{0.2, 0.4}}, Vector{{4.0, 4.0}}), 2);
  EXPECT_EQ(groups.size(), 2U);
}

TEST(StartingGroups, RealOneStartsAloneAndReal) {
  // s = -1 and -3; a pair -0.1 +- 2j.
  const ReducedPencil pencil = oscillators(Vector{{4.0, 0.2}}, Vector{{3.0, 4.01}});
  const auto groups = groups_of(pencil, 3);
  ASSERT_EQ(groups.size(), 3U);
  EXPECT_TRUE(groups[0].pair.is_real);
  EXPECT_EQ(groups[0].pair.Z.imag().norm(), 0.0);
  EXPECT_FALSE(groups[1].pair.is_real);
  EXPECT_TRUE(groups[2].pair.is_real);
  EXPECT_EQ(corrected(pencil, groups[0]).status, PairStatus::converged);
}

TEST(StartingGroups, PairCloseToTheRealAxisBringsItsConjugate) {
  // s = -1 +- 1e-5 j.
  const ReducedPencil pencil = oscillators(Vector{{2.0, 0.2}}, Vector{{1.0 + 1e-10, 9.01}});
  const auto groups = groups_of(pencil, 2);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_TRUE(groups[0].pair.is_real);
  EXPECT_EQ(groups[0].modes, (Modes{0, Track::no_mode}));
  EXPECT_EQ(groups[0].roots[1], std::conj(groups[0].roots[0]));
  const InvariantPair pair = corrected(pencil, groups[0]);
  ASSERT_EQ(pair.status, PairStatus::converged);
  EXPECT_EQ(pair.Lambda.imag().norm(), 0.0);
  EXPECT_NEAR(pair.Lambda.trace().real(), -2.0, 1e-13);
  EXPECT_NEAR(pair.Lambda.determinant().real(), 1.0 + 1e-10, 1e-13);
}

TEST(StartingGroups, OnTheRealAxisADoubleOneIsARealBlockOfTwoModes) {
  // s^2 + 2 s + 1: QZ has it as a pair or as two real ones, 1e-8 apart.
  const ReducedPencil pencil = oscillators(Vector{{2.0, 0.2}}, Vector{{1.0, 9.01}});
  const auto groups = groups_of(pencil, static_cast<int>(spectrum_of(pencil).size()));
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_TRUE(groups[0].pair.is_real);
  EXPECT_EQ(groups[0].pair.size(), 2);
  const InvariantPair pair = corrected(pencil, groups[0]);
  ASSERT_EQ(pair.status, PairStatus::converged);
  EXPECT_NEAR(pair.Lambda.determinant().real(), 1.0, 1e-13);
}

TEST(StartingGroups, GuardsBringTheirConjugatesAsGuards) {
  // Two pairs -1 +- 1e-5 j, of which one is followed.
  const ReducedPencil pencil = oscillators(Vector{{2.0, 2.0, 0.2}}, Vector{{1.0 + 1e-10, 1.0 + 2e-10, 9.01}});
  const auto groups = groups_of(pencil, 1);
  ASSERT_EQ(groups.size(), 1U);
  ASSERT_EQ(groups[0].pair.size(), 4);
  EXPECT_TRUE(groups[0].pair.is_real);
  Modes sorted = groups[0].modes;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(sorted, (Modes{Track::guard, Track::guard, Track::no_mode, 0}));
}

/// A triple eigenvalue with one eigenvector. The three eigenvalues of QZ differ by some 1e-5; the functions
/// of the block are known to rounding.
TEST(StartingGroups, TripleDefectiveOneIsToldByItsBlockAndNotBySingleModes) {
  const Matrix W{{2.0, 1.0, 0.0}, {0.0, 2.0, 1.0}, {0.0, 0.0, 2.0}};
  const Vector v{{1.0, 2.0, 3.0}};
  const Matrix Q = Matrix::Identity(3, 3) - 2.0 * v * v.transpose() / v.squaredNorm();
  const ReducedPencil pencil = undamped(Q * W * W * Q);
  const auto modes = spectrum_of(pencil);
  const auto groups = starting_groups(pencil, modes, 3, s_ref);
  ASSERT_EQ(groups.size(), 1U);
  EXPECT_EQ(groups[0].modes, (Modes{0, 1, 2}));
  const InvariantPair pair = corrected(pencil, groups[0]);
  ASSERT_EQ(pair.status, PairStatus::converged);
  ComplexMatrix N = pair.Lambda - 2.0 * j * ComplexMatrix::Identity(3, 3);
  EXPECT_LT(std::abs(N.trace()), 1e-12);
  EXPECT_LT((N * N * N).norm(), 1e-12);
  // For comparison, the eigenvalues of the spectrum itself.
  double miss = 0.0;
  for (const StartingMode& mode : modes) miss = std::max(miss, std::abs(mode.s - 2.0 * j));
  EXPECT_GT(miss, 1e-7);
}

/// Beside a branch point: eigenvalues +-1e-6, tiny against those elsewhere on the path but apart relative to
/// themselves.
TEST(StartingGroups, ThoseThatVanishWithTheStiffnessAreOneBlockOnTheScaleOfThePath) {
  const ReducedPencil pencil = undamped(diagonal(Vector{{-1e-12, 9.0}}));
  const auto by_itself = starting_groups(pencil, spectrum_of(pencil), 3, 1e-9);
  EXPECT_EQ(by_itself.size(), 3U);
  const auto groups = starting_groups(pencil, spectrum_of(pencil), 3, 1e-9, 1.0);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].modes, (Modes{0, 1}));
  EXPECT_TRUE(groups[0].pair.is_real);
  ModeCounts counts;
  const InvariantPair pair = correct_pair(PencilAtPoint(pencil), groups[0].pair, 1e-3, {}, counts);
  ASSERT_EQ(pair.status, PairStatus::converged);
  EXPECT_NEAR(pair.Lambda.trace().real(), 0.0, 1e-13);
  EXPECT_NEAR(pair.Lambda.determinant().real(), -1e-12, 1e-14);
}

TEST(StartingGroups, RigidBodyModesAreOneRealBlock) {
  // Two bodies that nothing holds beside one on a spring: s = 0 four times.
  const ReducedPencil pencil = undamped(diagonal(Vector{{0.0, 0.0, 4.0}}));
  const auto modes = spectrum_of(pencil);
  const auto groups = starting_groups(pencil, modes, static_cast<int>(modes.size()), s_ref);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_TRUE(groups[0].pair.is_real);
  EXPECT_EQ(groups[0].pair.size(), 4);
  const InvariantPair pair = corrected(pencil, groups[0]);
  ASSERT_EQ(pair.status, PairStatus::converged);
  EXPECT_LT((pair.Lambda * pair.Lambda).norm(), 1e-12);
}

TEST(StartingGroups, EveryModeIsInOneGroupAndEveryRootHasItsMode) {
  const Vector w{{1.0, 1.0, 1.5, 1.5 + 1e-5, 2.0, 3.0}};
  const auto groups = groups_of(undamped(diagonal(w.cwiseAbs2())), 6);
  Modes all;
  for (const StartingGroup& group : groups) {
    ASSERT_EQ(group.roots.size(), static_cast<Eigen::Index>(group.modes.size()));
    EXPECT_EQ(group.pair.size(), group.roots.size());
    for (std::size_t i = 0; i < group.modes.size(); ++i) {
      EXPECT_NEAR(std::abs(group.roots[static_cast<Eigen::Index>(i)]), w[group.modes[i]], 1e-7);
      all.push_back(group.modes[i]);
    }
  }
  std::sort(all.begin(), all.end());
  EXPECT_EQ(all, (Modes{0, 1, 2, 3, 4, 5}));
}

}  // namespace
}  // namespace eigentrail::test::starting_tracks_test
