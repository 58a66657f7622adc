// The test by sums of eigenvalues whether every mode is followed exactly once, and the search for modes of a
// spectrum that no track has.
#include <gtest/gtest.h>

#include "continuation/planted_points.hpp"
#include "continuation/tracks/completeness.hpp"
#include "continuation/tracks/regrouping.hpp"
#include "support/families.hpp"

namespace eigentrail::test::checksum_test {
namespace {

/// A damped, gyroscopic and circulatory system: the pencil has no structure that the test could use.
FamilyMatrices general(Eigen::Index n, unsigned seed) {
  const ReducedPencil family = random_family(n, seed);
  return {{family.M[0]}, {family.C[0]}, {family.K[0]}};
}

/// Every mode of a family by itself.
struct Followed {
  explicit Followed(const FamilyMatrices& matrices) : family(matrices) {
    const PathPoint point = family.reduced(0.0);
    spectrum = compute_spectrum(point.pencil.M[0], point.pencil.C[0], point.pencil.K[0]);
    std::vector<Complex> s;
    for (const StartingMode& mode : spectrum.modes) s.push_back(mode.s);
    node = family.point(0.0, alone(s));
  }
  bool holds() const { return checksum_holds(node, family.problem()); }
  std::vector<StartingMode> missing() const { return missing_modes(node, spectrum, 1e-3, {}); }

  Planted family;
  Spectrum spectrum;
  PathNode node;
};

TEST(Checksum, HoldsHoweverTheModesAreFollowed) {
  Followed all(general(6, 4));
  ASSERT_TRUE(join(all.family.problem(), all.node, 0, {{false, 1, 0.0}}, all.family.counts));
  EXPECT_TRUE(all.holds());
  ASSERT_TRUE(change_chart(all.family.problem(), all.node, 0, all.family.counts));
  EXPECT_TRUE(all.holds());
  ASSERT_TRUE(join(all.family.problem(), all.node, 1, {{true, 1, 0.0}}, all.family.counts));
  EXPECT_TRUE(all.holds());
}

class ChecksumWithout : public testing::TestWithParam<std::size_t> {};

TEST_P(ChecksumWithout, OneModeFails) {
  Followed some(general(6, 5));
  some.node.tracks.erase(some.node.tracks.begin() + static_cast<std::ptrdiff_t>(GetParam()));
  EXPECT_FALSE(some.holds());
}

TEST_P(ChecksumWithout, OneModeInPlaceOfAnotherFails) {
  Followed doubled(general(6, 5));
  doubled.node.tracks[GetParam()] = doubled.node.tracks[(GetParam() + 1) % 6];
  EXPECT_FALSE(doubled.holds());
}

INSTANTIATE_TEST_SUITE_P(Modes, ChecksumWithout, testing::Values(0, 2, 5));

/// The sums do not depend on the order of the modes, so an exchange is not detected. The certificate does
/// that.
TEST(Checksum, DoesNotSeeAnExchange) {
  Followed exchanged(general(6, 6));
  std::swap(exchanged.node.tracks[1], exchanged.node.tracks[4]);
  EXPECT_TRUE(exchanged.holds());
}

/// A pair of 1 rad/s beside pairs of 1e4 rad/s: an error of the slow pair is lost in rounding of the sums of
/// powers of s, but not of 1/s.
TEST(Checksum, SeesTheSlowestOfFastModes) {
  const Matrix K = Vector{{1.0, 1e8, 4e8}}.asDiagonal();
  Followed all({{Matrix::Identity(3, 3)}, {}, {K}});
  EXPECT_TRUE(all.holds());
  Track& slow = all.node.tracks[0];
  slow.roots[0] *= 1.01;
  EXPECT_FALSE(all.holds());
}

TEST(Checksum, LeavesOutTheSumsOfASingularMass) {
  // One freedom without mass: a real eigenvalue, and one at infinity.
  const auto diagonal = [](double a, double b) { return Matrix(Vector{{a, b}}.asDiagonal()); };
  Followed all({{diagonal(1.0, 0.0)}, {diagonal(0.2, 1.0)}, {diagonal(4.0, 3.0)}});
  // In the sums of 1/s the infinite eigenvalue counts zero.
  EXPECT_EQ(all.node.tracks.size(), 2U);
  EXPECT_TRUE(all.holds());
  all.node.tracks[1].roots[0] *= 1.01;
  EXPECT_FALSE(all.holds());
  all.node.tracks.pop_back();
  EXPECT_FALSE(all.holds());
}

/// With a singular stiffness, too: sums of 1 / (s - shift).
TEST(Checksum, HoldsWithRigidBodyMotionAndSingularMass) {
  const auto diagonal = [](double a, double b, double c) { return Matrix(Vector{{a, b, c}}.asDiagonal()); };
  Followed all({{diagonal(1.0, 0.0, 1.0)}, {diagonal(0.2, 1.0, 0.3)}, {diagonal(4.0, 3.0, 0.0)}});
  ASSERT_EQ(all.node.tracks.size(), 4U);
  EXPECT_TRUE(all.holds());
  for (int i = 0; i < 4; ++i) {
    const Track first = all.node.tracks.front();
    all.node.tracks.erase(all.node.tracks.begin());
    EXPECT_FALSE(all.holds()) << i;
    all.node.tracks.push_back(first);
  }
}

TEST(MissingModes, AreThoseThatNoTrackHas) {
  Followed some(general(8, 7));
  const Complex first = some.node.tracks[2].roots[0];
  const Complex second = some.node.tracks[6].roots[0];
  some.node.tracks.erase(some.node.tracks.begin() + 6);
  some.node.tracks.erase(some.node.tracks.begin() + 2);
  const auto missing = some.missing();
  ASSERT_EQ(missing.size(), 2U);
  EXPECT_LT(std::abs(missing[0].s - first), 1e-10);
  EXPECT_LT(std::abs(missing[1].s - second), 1e-10);
}

TEST(MissingModes, ADoubledTrackStandsForOne) {
  Followed doubled(general(6, 8));
  const Complex lost = doubled.node.tracks[3].roots[0];
  doubled.node.tracks[3] = doubled.node.tracks[4];
  const auto missing = doubled.missing();
  ASSERT_EQ(missing.size(), 1U);
  EXPECT_LT(std::abs(missing[0].s - lost), 1e-10);
}

TEST(MissingModes, OfADoubleEigenvalueIsTheOtherOne) {
  const Matrix K = Vector{{4.0, 4.0, 9.0}}.asDiagonal();
  Followed all({{Matrix::Identity(3, 3)}, {}, {K}});
  EXPECT_TRUE(all.missing().empty());
  all.node.tracks.erase(all.node.tracks.begin());
  const auto missing = all.missing();
  ASSERT_EQ(missing.size(), 1U);
  EXPECT_LT(std::abs(missing[0].s - 2.0 * j), 1e-10);
}

TEST(MissingModes, ARealBlockStandsForItsPair) {
  Followed all(general(5, 9));
  ASSERT_TRUE(join(all.family.problem(), all.node, 2, {{true, 2, 0.0}}, all.family.counts));
  EXPECT_TRUE(all.missing().empty());
}

}  // namespace
}  // namespace eigentrail::test::checksum_test
