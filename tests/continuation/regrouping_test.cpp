// Joining modes to blocks, separating blocks, and changing charts at a point, compared with closed forms.
#include "continuation/tracks/regrouping.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/meeting_families.hpp"
#include "eigentrail/modes/invariants.hpp"
#include "eigentrail/modes/regroup.hpp"

namespace eigentrail::test::regrouping_test {
namespace {

constexpr double rounding = 1e-12;  ///< of series of modes some tenths apart, of order one
using Modes = std::vector<int>;

TEST(Regrouping, JoinsTwoModesThatMeetWithinTheStep) {
  Planted family = crossing();
  PathNode node = family.point(0.0, alone(at_zero));
  ASSERT_TRUE(join(family.problem(), node, 0, find_partners(node, 0, 0.4, 1.0), family.counts));
  ASSERT_EQ(node.tracks.size(), 3U);
  const Track& block = node.tracks.back();
  EXPECT_EQ(block.modes, (Modes{0, 1}));
  EXPECT_LT(distance(block.roots, ComplexVector{{2.0 * j, 2.6 * j}}), rounding);
  // tau = 2.3 j, delta = -(0.3 - p)^2.
  EXPECT_LT(distance(block.functions.row(0).transpose(), ComplexVector{{2.3 * j}}), rounding);
  EXPECT_LT(distance(block.functions.row(1).transpose(), ComplexVector{{-0.09, 0.6, -1.0}}), rounding);
  EXPECT_EQ(node.tracks[0].modes, Modes{2});
}

TEST(Regrouping, JoinsAPairWithItsConjugateToARealBlock) {
  Planted family = towards_the_axis(0.5);
  PathNode node = family.point(0.5, alone({upper(0.5, 0.5), far_away}));
  ASSERT_TRUE(join(family.problem(), node, 0, {{true, 0, 0.25}}, family.counts));
  const Track& block = node.tracks.back();
  EXPECT_TRUE(block.pair.is_real);
  EXPECT_EQ(block.modes, (Modes{0, Track::no_mode}));
  EXPECT_LT(std::abs(block.roots[0] - upper(0.5, 0.5)), rounding);
  EXPECT_EQ(block.roots[1], std::conj(block.roots[0]));
  EXPECT_LT(distance(block.functions.row(1).transpose(), ComplexVector{{-0.25, 1.0}}), rounding);
}

TEST(Regrouping, JoinsAcrossChartsInThatOfTheTrack) {
  Planted family = crossing();
  PathNode node = family.point(0.0, alone(at_zero));
  ASSERT_TRUE(change_chart(family.problem(), node, 1, family.counts));
  ASSERT_TRUE(join(family.problem(), node, 0, {{false, 1, 0.0}}, family.counts));
  EXPECT_EQ(node.tracks.back().pair.chart, Chart::finite);
  EXPECT_LT(distance(node.tracks.back().roots, ComplexVector{{2.0 * j, 2.6 * j}}), rounding);
}

TEST(Regrouping, DoesNotJoinMoreThanSixteen) {
  constexpr Eigen::Index count = 17;
  Matrix w(count, 2);
  for (Eigen::Index i = 0; i < count; ++i) w.row(i) << 2.0 + 0.1 * static_cast<double>(i), 0.1;
  Planted family = Planted::frequencies(uncoupled(w));
  std::vector<Complex> s;
  for (Eigen::Index i = 0; i < count; ++i) s.push_back(w(i, 0) * j);
  PathNode node = family.point(0.0, alone(s));
  std::vector<Partner> others;
  for (std::size_t i = 1; i < s.size(); ++i) others.push_back({false, i, 0.0});
  EXPECT_FALSE(join(family.problem(), node, 0, others, family.counts));
  EXPECT_EQ(node.tracks.size(), s.size());
  others.pop_back();
  EXPECT_TRUE(join(family.problem(), node, 0, others, family.counts));
  EXPECT_EQ(node.tracks.size(), 2U);
}

/// The same mode twice is no block, because its two columns are linearly dependent.
TEST(Regrouping, DoesNotJoinAModeWithItselfAndLeavesThePointAlone) {
  Planted family = crossing();
  PathNode node = family.point(0.0, alone({2.0 * j, 5.0 * j, 2.0 * j}));
  EXPECT_FALSE(join(family.problem(), node, 0, {{false, 2, 0.0}}, family.counts));
  ASSERT_EQ(node.tracks.size(), 3U);
  EXPECT_EQ(node.tracks[0].modes, Modes{0});
  EXPECT_EQ(node.tracks[2].roots.size(), 1);
}

/// tridiag(1 + p, -2, 1 - p) at p = 1 - 1e-4: ten real eigenvalues whose vectors are parallel to rounding.
/// From these, the rival, no block can be corrected.
TEST(Regrouping, FormsABlockOfParallelVectorsFromTheirSpace) {
  constexpr Eigen::Index n = 10;
  Matrix K0 = 2.0 * Matrix::Identity(n, n), K1 = Matrix::Zero(n, n);
  K0.diagonal(1).setConstant(-1.0);
  K0.diagonal(-1).setConstant(-1.0);
  K1.diagonal(1).setConstant(1.0);
  K1.diagonal(-1).setConstant(-1.0);
  Planted family({{Matrix::Zero(n, n)}, {Matrix::Identity(n, n)}, {K0, K1}});
  constexpr double p = 1.0 - 1e-4;
  std::vector<Complex> s;
  for (Eigen::Index k = 1; k <= n; ++k) {
    s.emplace_back(-2.0 + 2.0 * std::sqrt(1.0 - p * p) *
                              std::cos(static_cast<double>(k) * M_PI / static_cast<double>(n + 1)));
  }
  PathNode node = family.point(p, alone(s));
  std::vector<const InvariantPair*> singles;
  for (const Track& track : node.tracks) singles.push_back(&track.pair);
  const InvariantPair rival =
      correct_pair(PencilAtPoint(node.pencil), join_pairs(singles, true), family.problem().s_ref,
                   family.problem().corrector, family.counts.modes);
  EXPECT_NE(rival.status, PairStatus::converged);
  std::vector<Partner> others;
  for (std::size_t i = 1; i < s.size(); ++i) others.push_back({false, i, 0.0});
  ASSERT_TRUE(join(family.problem(), node, 0, others, family.counts));
  ASSERT_EQ(node.tracks.size(), 1U);
  // Its matrix knows the eigenvalues to the tenth root of rounding, their mean to rounding.
  EXPECT_LT(std::abs(node.tracks[0].pair.Lambda.trace() + 20.0), 1e-12);
  for (const Complex root : node.tracks[0].roots) EXPECT_LT(std::abs(root + 2.0), 0.2);
}

TEST(Regrouping, PartingAfterJoiningGivesBackTheSameSeries) {
  Planted family = crossing();
  PathNode node = family.point(0.0, alone(at_zero));
  const PathNode before = node;
  ASSERT_TRUE(join(family.problem(), node, 0, {{false, 1, 0.3}}, family.counts));
  part(family.problem(), nullptr, node, 0.05, 0.0, {1.0, 0.0}, family.counts);
  ASSERT_EQ(node.tracks.size(), 4U);
  for (const Track& track : node.tracks) {
    ASSERT_EQ(track.size(), 1);
    const Track& same = before.tracks[static_cast<std::size_t>(track.modes.at(0))];
    EXPECT_LT((track.functions - same.functions).norm(), rounding);
  }
}

TEST(Regrouping, DoesNotPartThoseWhoMeetWithinTheReachOnEitherSide) {
  Planted family = crossing();
  for (const double h : {0.05, -0.05}) {
    PathNode node = family.point(0.0, {{{2.0 * j, 2.6 * j}}});
    part(family.problem(), nullptr, node, h, 0.0, {5.5, 0.0}, family.counts);
    EXPECT_EQ(node.tracks.size(), 1U) << h;
    // The meeting lies 0.25 beyond the step on its side.
    part(family.problem(), nullptr, node, h, 0.0, {4.0, 0.0}, family.counts);
    EXPECT_EQ(node.tracks.size(), 2U) << h;
  }
}

TEST(Regrouping, PartsOnlyTheOneThatMeetsNobody) {
  Planted family = Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.2, 0.0}, {2.9, -0.1}}));
  PathNode node = family.point(0.0, {{{2.0 * j, 2.9 * j, 2.2 * j}}});
  part(family.problem(), nullptr, node, 0.2, 0.0, {1.0, 0.0}, family.counts);
  ASSERT_EQ(node.tracks.size(), 2U);
  EXPECT_EQ(node.tracks[0].modes, (Modes{0, 2}));
  EXPECT_EQ(node.tracks[1].modes, Modes{1});
  EXPECT_LT(distance(node.tracks[1].functions.row(0).transpose(), ComplexVector{{2.9 * j, -0.1 * j}}),
            rounding);
}

TEST(Regrouping, ConjugateThatIsNoLongerNeededIsDropped) {
  Planted family = towards_the_axis(0.5);
  const Complex s = upper(0.5, 0.5);
  PathNode node = family.point(0.5, {{{s, std::conj(s)}}});
  part(family.problem(), nullptr, node, 0.01, 0.0, {1.0, 0.0}, family.counts);
  ASSERT_EQ(node.tracks.size(), 1U);
  EXPECT_EQ(node.tracks[0].size(), 1);
  EXPECT_EQ(node.tracks[0].modes, Modes{0});
  EXPECT_LT(std::abs(node.tracks[0].roots[0] - s), rounding);
}

/// sqrt(p) at a distance of 1e-10 from its branch point: the block is nearly defective and must not be
/// separated, however short the step is.
TEST(Regrouping, DefectiveBlockIsNotTakenApart) {
  Planted family = Planted::frequencies({Matrix{{2.0, 1.0}, {0.0, 2.0}}, Matrix{{0.0, 0.0}, {1.0, 0.0}}});
  PathNode node = family.point(1e-10, {{{(2.0 + 1e-5) * j, (2.0 - 1e-5) * j}}});
  part(family.problem(), nullptr, node, 1e-14, 0.0, {1.0, 0.0}, family.counts);
  EXPECT_EQ(node.tracks.size(), 1U);
}

TEST(Regrouping, PartsThoseWhoWouldHaveBeenAccurateAloneOnTheLastStep) {
  Planted family = crossing();
  const PathNode left = family.point(-0.1, {{{1.9 * j, 2.7 * j}}});
  // They meet, but each eigenvalue is a polynomial and can be interpolated alone.
  for (const double accepted : {0.0, 1e-6}) {
    PathNode node = family.point(0.0, {{{2.0 * j, 2.6 * j}}});
    part(family.problem(), &left, node, 0.1, 0.1, {10.0, accepted}, family.counts);
    EXPECT_EQ(node.tracks.size(), accepted > 0.0 ? 2U : 1U) << accepted;
  }
}

TEST(Regrouping, ASingleModeThatCouldNotDoAloneKeepsItsPartner) {
  // Half-width 0.05, a step that ends on the veering.
  constexpr double eps = 0.05;
  Planted family = Planted::frequencies({Matrix{{2.0, eps}, {eps, 2.0}}, Matrix{{1.0, 0.0}, {0.0, -1.0}}});
  const auto both = [&](double p) {
    const double apart = std::hypot(p, eps);
    return std::vector<Together>{{{(2.0 - apart) * j, (2.0 + apart) * j}}};
  };
  const PathNode left = family.point(-0.3, both(-0.3));
  PathNode node = family.point(0.0, both(0.0));
  part(family.problem(), &left, node, 0.3, 0.3, {1.0, 1e-8}, family.counts);
  EXPECT_EQ(node.tracks.size(), 1U);
}

/// A block of the upper of two veering modes and of a mode that crosses it. The latter is a polynomial and
/// could be interpolated alone, the former could not.
TEST(Regrouping, DoesNotPartAPairOfWhichOneCouldNotDoAlone) {
  constexpr double eps = 0.05;
  Planted family = Planted::frequencies({Matrix{{2.0, eps, 0.0}, {eps, 2.0, 0.0}, {0.0, 0.0, 2.3}},
                                         Matrix{{1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, {0.0, 0.0, -1.0}}});
  const auto both = [&](double p) {
    return std::vector<Together>{{{(2.0 + std::hypot(p, eps)) * j, (2.3 - p) * j}}};
  };
  const PathNode left = family.point(-0.1, both(-0.1));
  PathNode node = family.point(0.1, both(0.1));
  part(family.problem(), &left, node, 0.2, 0.2, {1.0, 1e-8}, family.counts);
  EXPECT_EQ(node.tracks.size(), 1U);
}

/// Both whirls of an isotropic shaft in its own frame, s = +-j (1 - p), where they meet in zero up to
/// rounding. Each of them is a polynomial, also where rounding happens to leave no trace in the functions of
/// the block; but the series of one of them alone would be rounding over their distance.
TEST(Regrouping, DoesNotPartThoseWhoCountAsEqualAtThePoint) {
  const Matrix unit = Matrix::Identity(2, 2);
  Planted family({{unit}, {Matrix::Zero(2, 2), Matrix{{0.0, -2.0}, {2.0, 0.0}}}, {unit, 0.0 * unit, -unit}});
  const auto both = [](double p) { return std::vector<Together>{{{(1.0 - p) * j, (p - 1.0) * j}}}; };
  const PathNode left = family.point(0.75, both(0.75));
  for (const double beside : {std::exp2(-40), 0.125}) {
    PathNode node = family.point(1.0 - beside, both(1.0 - beside));
    ComplexMatrix& functions = node.tracks[0].functions;
    functions.setZero();
    functions.row(1).head(3) << -beside * beside, 2.0 * beside, -1.0;  // -(beside - h)^2
    node.tracks[0].roots = ComplexVector{{beside * j, -beside * j}};
    part(family.problem(), &left, node, 0.01, node.p - left.p, {1.0, 1e-6}, family.counts);
    ASSERT_EQ(node.tracks.size(), 1U);
    EXPECT_EQ(node.tracks[0].size(), beside > 0.1 ? 1 : 2) << beside;
  }
}

TEST(Regrouping, WhoIsWhoBehindAMeetingOutlivesJoiningAndParting) {
  Planted family = Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.0, -1.0}, {2.5, 0.3}}));
  PathNode node = family.point(0.0, {{{2.0 * j, 2.0 * j}}, {{2.5 * j}}});
  node.tracks[0].departure = Track::Departure{0.01, ComplexVector{{2.01 * j, 1.99 * j}}};
  node.tracks[0].met = {0, 1};
  ASSERT_TRUE(join(family.problem(), node, 1, {{false, 0, 0.0}}, family.counts));
  const Track joined = node.tracks[0];
  EXPECT_EQ(joined.modes, (Modes{2, 0, 1}));
  EXPECT_EQ(joined.met, (std::vector<int>{1, 2}));
  ASSERT_TRUE(joined.departure);
  EXPECT_LT(distance(joined.departure->roots, ComplexVector{{2.503 * j, 2.01 * j, 1.99 * j}}), rounding);
  // The third can be interpolated alone. For the two that coincide at this point this is not known.
  const PathNode left = family.point(-0.1, {{{2.47 * j, 1.9 * j, 2.1 * j}}});
  part(family.problem(), &left, node, 0.1, 0.1, {1.0, 1e-6}, family.counts);
  ASSERT_EQ(node.tracks.size(), 2U);
  const Track& pair = node.tracks[1];
  EXPECT_EQ(pair.modes, (Modes{0, 1}));
  EXPECT_EQ(pair.met, (std::vector<int>{0, 1}));
  ASSERT_TRUE(pair.departure);
  EXPECT_LT(distance(pair.departure->roots, ComplexVector{{2.01 * j, 1.99 * j}}), rounding);
}

TEST(Separate, GivesNothingWhereOthersAreAsClose) {
  Planted family = Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.1, 0.0}, {2.3, 0.3}, {6.0, 0.0}}));
  const PathNode node = family.point(0.0, {{{2.0 * j, 2.1 * j, 2.3 * j}}});
  // The third is twice as far from the second as that from the first.
  EXPECT_FALSE(separate(family.problem(), node, node.tracks[0], {0, 1}, family.counts));
  EXPECT_FALSE(separate(family.problem(), node, node.tracks[0], {0, 2}, family.counts));
  EXPECT_TRUE(separate(family.problem(), node, node.tracks[0], {1}, family.counts));
}

/// (1 - p) s^2 + 0.5 s + 1 = 0: mu = 1/s = -0.25 +- sqrt(p - 0.9375), zero at p = 1.
Planted vanishing_mass() {
  return Planted({{Matrix{{1.0}}, Matrix{{-1.0}}}, {Matrix{{0.5}}}, {Matrix{{1.0}}}});
}
double passing(double p) {
  return -0.25 + std::sqrt(p - 0.9375);
}

TEST(ChangeChart, GivesTheReciprocalSeriesAndBackTheSame) {
  Planted family = vanishing_mass();
  PathNode node = family.point(0.98, alone({Complex(1.0 / passing(0.98))}));
  node.tracks[0].arriving = {4};
  const Track before = node.tracks[0];
  ASSERT_TRUE(change_chart(family.problem(), node, 0, family.counts));
  const Track& other = node.tracks[0];
  EXPECT_EQ(other.pair.chart, Chart::reciprocal);
  EXPECT_NEAR(other.roots[0].real(), passing(0.98), rounding);
  EXPECT_EQ(other.modes, before.modes);
  EXPECT_EQ(other.arriving, before.arriving);
  const ComplexVector s = before.functions.row(0).transpose();
  const ComplexVector mu = other.functions.row(0).transpose();
  // Coefficients grow like 0.0425^-k.
  EXPECT_LT(distance(mu, reciprocal_series(s)), 1e-8 * mu.cwiseAbs().maxCoeff());
  ASSERT_TRUE(change_chart(family.problem(), node, 0, family.counts));
  const ComplexVector back = node.tracks[0].functions.row(0).transpose();
  EXPECT_LT(distance(back, s), 1e-9 * s.cwiseAbs().maxCoeff());
}

TEST(ChangeChart, IsRefusedToBlocksAndToZero) {
  Planted family = crossing();
  PathNode node = family.point(0.0, {{{2.0 * j, 2.6 * j}}});
  EXPECT_FALSE(change_chart(family.problem(), node, 0, family.counts));
  // At infinity 1/s is zero: there is no finite chart.
  Planted passing_infinity = vanishing_mass();
  PathNode at_infinity = passing_infinity.point(0.98, {{{1.0 / passing(0.98)}, Chart::reciprocal}});
  at_infinity.tracks[0].roots[0] = 0.0;
  EXPECT_FALSE(change_chart(passing_infinity.problem(), at_infinity, 0, passing_infinity.counts));
  EXPECT_EQ(at_infinity.tracks[0].pair.chart, Chart::reciprocal);
}

TEST(PrefersOtherChart, OnTheWayToInfinityAndNotBack) {
  Planted family = vanishing_mass();
  PathNode node = family.point(0.985, alone({Complex(1.0 / passing(0.985))}));
  EXPECT_TRUE(prefers_other_chart(node.tracks[0], 0.01));
  ASSERT_TRUE(change_chart(family.problem(), node, 0, family.counts));
  EXPECT_FALSE(prefers_other_chart(node.tracks[0], 0.01));
}

TEST(PrefersOtherChart, NotWhereTheEigenvalueHardlyMoves) {
  Planted family = vanishing_mass();
  const PathNode node = family.point(0.985, alone({Complex(1.0 / passing(0.985))}));
  EXPECT_FALSE(prefers_other_chart(node.tracks[0], 1e-4));
  // The other root stays finite.
  const PathNode other = family.point(0.985, alone({Complex(1.0 / (-0.5 - passing(0.985)))}));
  EXPECT_FALSE(prefers_other_chart(other.tracks[0], 0.01));
}

}  // namespace
}  // namespace eigentrail::test::regrouping_test
