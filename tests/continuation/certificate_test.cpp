// A step is certified ("the certificate closes") if every mode is continued, and it is not certified ("stays
// open") if modes are exchanged. The modal assurance criterion, the usual test, does not detect such an
// exchange.
#include "eigentrail/continuation/certificate.hpp"
#include "eigentrail/continuation/point_modes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "continuation/planted_points.hpp"
#include "continuation/point/point_solver.hpp"
#include "continuation/step/modal_certificate.hpp"
#include "core/matrix_series.hpp"
#include "eigentrail/modes/matching.hpp"
#include "eigentrail/modes/regroup.hpp"
#include "support/families.hpp"
#include "support/matrix_text.hpp"
#include "support/scenes.hpp"
#include "support/spectra.hpp"

namespace eigentrail::test::certificate_test {
namespace {

/// K = [[4 + p, eps], [eps, 4 - p]]: s^2 = -(4 +- sqrt(p^2 + eps^2)), a veering at p = 0.
Setting veering(double eps) {
  const Matrix I = Matrix::Identity(2, 2);
  return make_setting(
      family_scene({{I}, {}, {Matrix{{4.0, eps}, {eps, 4.0}}, Matrix{{1.0, 0.0}, {0.0, -1.0}}}}, -1.0, 1.0));
}

/// Rows of constant matrices that do not commute: three modes that all turn.
Setting smooth_family() {
  return make_setting(
      "[trace]\nparameter = \"p\"\nfrom = 0\nto = 1\n[matrix_family]\n"
      "M = [ [[2, 0.1, 0], [0.1, 1, 0], [0, 0, 1.5]] ]\n"
      "C = [ [[0.1, 0.3, 0], [-0.3, 0.2, 0.1], [0, -0.1, 0.1]] ]\n"
      "K = [ [[3, 0.5, 0.2], [0.4, 9, -0.3], [0.1, 0.2, 20]], [[1, 0.3, 0], [0.2, -1, 0.4], [0.5, 0, 2]] "
      "]\n");
}

/// Two points with the same blocks: predicted from the left one by its series and corrected, as a trace does.
class Step {
 public:
  /// Starts with all modes at `from`, each in a track of its own.
  Step(Setting setting, double from, double to) : setting_(std::move(setting)), problem_(setting_.problem()) {
    const PathPoint point = point_from_guess(problem_, from, counts);
    left = differentiate_point(problem_, point, counts).value();
    go_to(to);
  }

  /// The first two modes as one block from here on.
  void join(double to) {
    const InvariantPair both = join_pairs({&left.tracks[0].pair, &left.tracks[1].pair}, false);
    InvariantPair pair = correct_pair(PencilAtPoint(left.pencil), both, problem_.s_ref, {}, counts.modes);
    if (pair.status != PairStatus::converged) throw std::runtime_error("the block did not converge");
    left.tracks.erase(left.tracks.begin(), left.tracks.begin() + 2);
    left.tracks.insert(left.tracks.begin(), differentiate_track(problem_, left, std::move(pair), counts));
    go_to(to);
  }

  void go_to(double to) {
    length = to - left.p;
    const PathFrame frame{PathRange{problem_.traced, left.p, to}};
    right = PointSolver(problem_, frame, counts).follow(all_tracks(left), length).value().node;
  }

  /// Distance of a track from all other eigenvalues, conjugates included.
  double gap(std::size_t track) const {
    double nearest = INFINITY;
    for (const Complex s : left.tracks[track].roots) {
      nearest = std::min(nearest, 2.0 * std::abs(s.imag()));
      for (std::size_t other = 0; other < left.tracks.size(); ++other) {
        if (other == track) continue;
        for (const Complex t : left.tracks[other].roots)
          nearest = std::min({nearest, std::abs(s - t), std::abs(s - std::conj(t))});
      }
    }
    return nearest;
  }

  bool certified(std::size_t track) {
    return certify_step(StepPencil(left, right, length), left.tracks[track], right.tracks[track], gap(track),
                        counts);
  }

  PathNode left, right;
  double length = 0.0;
  RunCounts counts;

 private:
  Setting setting_;  // owns the model that the problem refers to
  PathProblem problem_;
};

TEST(Certificate, ClosesOnASmoothStepOfSingleModes) {
  Step step(smooth_family(), 0.2, 0.4);
  ASSERT_EQ(step.left.tracks.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(step.certified(i)) << "mode " << i;
  EXPECT_GE(step.counts.certificate_factorizations, 3U);
  EXPECT_LE(step.counts.certificate_factorizations, 3U * 15U) << "halved three times at most";
}

/// A damped chain of masses, whose matrices have bands of width one, or its coordinates turned by a
/// reflection, which fills the matrices and leaves all norms as they are.
Setting chain_family(bool is_turned) {
  constexpr Eigen::Index n = 70;
  const auto springs = [](const auto& stiffness) {
    Matrix K = Matrix::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double k = stiffness(static_cast<double>(i));
      K(i, i) += k;
      if (i > 0) K.block(i - 1, i - 1, 2, 2) += Matrix{{k, -k}, {-k, 0.0}};
    }
    return K;
  };
  Matrix Q = Matrix::Identity(n, n);
  if (is_turned) Q -= Matrix::Constant(n, n, 2.0 / n);
  const auto turned = [&](const Matrix& A) { return Matrix(Q.transpose() * A * Q); };
  const Matrix damping = springs([](double i) { return 0.01 * (1.0 + std::sin(i)); });
  const Matrix stiffness = springs([](double i) { return 10.0 + i; });
  const Matrix change = springs([](double i) { return std::cos(i); });
  return make_setting(family_scene(
      {{turned(Matrix::Identity(n, n))}, {turned(damping)}, {turned(stiffness), turned(change)}}, 0.0, 1.0));
}

/// The factors of a banded pencil are others, and the certificate is the same.
TEST(Certificate, IsTheSameByBandsAsByFullMatrices) {
  Step banded(chain_family(false), 0.0, 0.03);
  Step full(chain_family(true), 0.0, 0.03);
  ASSERT_TRUE(StepPencil(banded.left, banded.right, 0.03).at(0.5)->at.bands);
  ASSERT_FALSE(StepPencil(full.left, full.right, 0.03).at(0.5)->at.bands);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_TRUE(banded.certified(i)) << i;
    EXPECT_TRUE(full.certified(i)) << i;
  }
  EXPECT_EQ(banded.counts.certificate_factorizations, full.counts.certificate_factorizations);
  std::swap(banded.right.tracks[2], banded.right.tracks[3]);
  EXPECT_FALSE(banded.certified(2));
  EXPECT_FALSE(banded.certified(3));
}

struct NarrowVeering {
  double eps, from, to;
};

class CertificateAtVeering : public testing::TestWithParam<NarrowVeering> {
 protected:
  /// Upper or lower of the two at p, in closed form.
  Complex mode(double p, double sign) const {
    return {0.0, std::sqrt(4.0 + sign * std::hypot(p, GetParam().eps))};
  }
  Step step{veering(GetParam().eps), GetParam().from, GetParam().to};
};

TEST_P(CertificateAtVeering, StaysOpenForSinglesThatAreExchangedAndModalAssurancePasses) {
  const auto [eps, from, to] = GetParam();
  ASSERT_LT(std::abs(step.left.s(0, 0) - mode(from, -1.0)), 1e-12);
  // Long steps carry each track straight through the veering to the eigenvalue of the other mode.
  ASSERT_LT(std::abs(step.right.s(0, 0) - mode(to, 1.0)), 1e-12) << "the step did not exchange the modes";
  ASSERT_LT(std::abs(step.right.s(1, 0) - mode(to, -1.0)), 1e-12) << "the step did not exchange the modes";
  EXPECT_FALSE(step.certified(0));
  EXPECT_FALSE(step.certified(1));
  // The modal assurance criterion sees no change of the shapes.
  for (std::size_t i = 0; i < 2; ++i) {
    const Matrix assurance = modal_assurance(step.left.tracks[i].series.Z[0],
                                             step.right.tracks[i].series.Z[0], Matrix::Identity(2, 2));
    EXPECT_GT(assurance(0, 0), 0.99) << "mode " << i;
  }
}

TEST_P(CertificateAtVeering, ClosesForTheBlock) {
  step.join(GetParam().to);
  ASSERT_EQ(step.left.tracks.size(), 1U);
  ASSERT_EQ(step.left.tracks[0].size(), 2);
  EXPECT_TRUE(step.certified(0));
}

INSTANTIATE_TEST_SUITE_P(Steps, CertificateAtVeering,
                         testing::Values(NarrowVeering{1e-2, -0.3, 0.3}, NarrowVeering{1e-3, -0.3, 0.3},
                                         NarrowVeering{1e-3, -0.23, 0.4}, NarrowVeering{1e-3, -0.4, 0.11},
                                         NarrowVeering{1e-6, -0.3, 0.3}, NarrowVeering{1e-6, -0.317, 0.211},
                                         NarrowVeering{1e-9, -0.3, 0.2}, NarrowVeering{1e-12, -0.1, 0.2}));

/// The veering in coordinates that differ by 1e4, where the plain norm of a change is as large: the norms
/// that are used in its place do not close the test of an exchange.
TEST(Certificate, StaysOpenForSinglesThatAreExchangedInBadlyScaledCoordinates) {
  const auto scaled = [](double eps) {
    const double e = 1e4 * eps;
    return make_setting(family_scene(
        {{Matrix{{1.0, 0.0}, {0.0, 1e8}}}, {}, {Matrix{{4.0, e}, {e, 4e8}}, Matrix{{1.0, 0.0}, {0.0, -1e8}}}},
        -1.0, 1.0));
  };
  for (const double eps : {1e-2, 1e-3, 1e-6}) {
    Step step(scaled(eps), -0.3, 0.3);
    EXPECT_FALSE(step.certified(0)) << eps;
    EXPECT_FALSE(step.certified(1)) << eps;
    step.join(0.3);
    EXPECT_TRUE(step.certified(0)) << eps;
  }
  Step resolved(scaled(0.2), -0.1, -0.05);
  EXPECT_TRUE(resolved.certified(0) && resolved.certified(1));
}

/// A chain of masses whose springs are soft and 1e8 times stiffer in turn, and stiffen together by a fifth.
/// In the plain norm the change is as large as the ratio of the stiffnesses, and no number of halvings helps.
TEST(Certificate, ClosesInOnePieceWhereStiffAndSoftFreedomsChangeTogether) {
  constexpr int n = 24;
  Matrix K = Matrix::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    const double k = (i % 2 == 0 ? 1.0 : 1e8) * (1.0 + 0.03 * i);
    K(i, i) += k;
    if (i == 0) continue;
    K(i - 1, i - 1) += k;
    K(i, i - 1) -= k;
    K(i - 1, i) -= k;
  }
  const Matrix I = Matrix::Identity(n, n);
  Step step(make_setting(family_scene({{I}, {}, {K, K + 0.1 * I}}, 0.0, 1.0)), 0.0, 0.2);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::uint64_t before = step.counts.certificate_factorizations;
    EXPECT_TRUE(step.certified(i)) << i;
    EXPECT_LE(step.counts.certificate_factorizations - before, 3U) << i;
  }
}

TEST(Certificate, StaysOpenForSinglesAcrossAnExceptionalPointAndClosesForTheBlock) {
  // K = [[1, p], [-p, 2]]: both modes coalesce at p = 1/2 and go on as a growing and a decaying oscillation.
  const auto setting = [] {
    return make_setting(
        "[trace]\nparameter = \"p\"\nfrom = 0\nto = 1\n[matrix_family]\nM = [ [[1, 0], [0, 1]] ]\n"
        "K = [ [[1, 0], [0, 2]], [[0, 1], [-1, 0]] ]\n");
  };
  Step step(setting(), 0.3, 0.4);
  EXPECT_TRUE(step.certified(0) && step.certified(1)) << "before the point";
  step.join(0.6);
  EXPECT_TRUE(step.certified(0));
  // Single modes before the point, combined with single modes behind it, in whatever order.
  Step singles(setting(), 0.3, 0.4);
  const Step behind(setting(), 0.6, 0.61);
  singles.right = behind.left;
  singles.length = 0.3;
  EXPECT_FALSE(singles.certified(0));
  EXPECT_FALSE(singles.certified(1));
}

/// mu = 1/s of p s^2 + 3 s + 2 = 0 passes zero with the mass.
TEST(Certificate, ClosesInTheReciprocalChartWhereTheMassIsSingular) {
  Planted family({{Matrix{{0.0}}, Matrix{{1.0}}}, {Matrix{{3.0}}}, {Matrix{{2.0}}}});
  const auto at = [&](double p) {
    const double mu = 0.25 * (std::sqrt(9.0 - 8.0 * p) - 3.0);
    return family.point(p, {{{1.0 / mu}, Chart::reciprocal}});
  };
  const PathNode left = at(0.1), right = at(-0.1);
  EXPECT_LT(left.s(0, 0).real(), 0.0);
  EXPECT_GT(right.s(0, 0).real(), 0.0);
  EXPECT_TRUE(
      certify_step(StepPencil(left, right, -0.2), left.tracks[0], right.tracks[0], 1.43, family.counts));
}

/// Of every track of a step, whether the certificate of all modes at once closes.
std::vector<bool> certified_together(Step& step) {
  return certify_all(StepPencil(step.left, step.right, step.length), step.right, 0, step.counts);
}

TEST(ModalCertificate, ClosesOnASmoothStepOfAllModes) {
  Step step(smooth_family(), 0.2, 0.4);
  EXPECT_EQ(certified_together(step), std::vector<bool>(3, true));
  EXPECT_GE(step.counts.certificate_bases, 1U);
  EXPECT_LE(step.counts.certificate_bases, 3U) << "halved once at most";
  EXPECT_EQ(step.counts.certificate_factorizations, 0U);
}

TEST(ModalCertificate, StaysOpenWhereModesJumpOverAVeering) {
  // Each track arrives with the eigenpair of the other mode, because the corrector converges to the pair that
  // is nearest to the prediction.
  for (const double eps : {1e-2, 1e-4, 1e-8}) {
    Step step(veering(eps), -0.3, 0.3);
    EXPECT_EQ(certified_together(step), std::vector<bool>(2, false)) << eps;
  }
  Step wide(veering(1.0), -0.1, 0.1);
  EXPECT_EQ(certified_together(wide), std::vector<bool>(2, true)) << "the modes turn together";
}

TEST(ModalCertificate, StaysOpenForABlockWhereTheEndIsAnotherOne) {
  Step step(smooth_family(), 0.2, 0.4);
  Step other(smooth_family(), 0.2, 0.4);
  step.join(0.4);
  std::rotate(other.left.tracks.begin(), other.left.tracks.begin() + 1, other.left.tracks.end());
  other.join(0.4);  // the second and the third mode
  step.right.tracks[0] = other.right.tracks[0];
  EXPECT_FALSE(certified_together(step)[0]);
}

/// x' = A(p) x with six real eigenvalues 1e-3 apart that move in common by 1 and turn against each other,
/// beside six more: lag states of a wing. `coupling` makes the coordinates far from normal.
Setting common_cluster(double coupling) {
  Matrix A0 = Matrix::Zero(12, 12), A1 = A0;
  for (int i = 0; i < 12; ++i) {
    A0(i, i) = i < 6 ? -5.0 - 1e-3 * i : -20.0 - 7.0 * i;
    A1(i, i) = i < 6 ? -1.0 : 0.3;
    for (int k = 0; i < 6 && k < 6; ++k) {
      A0(i, 6 + k) = coupling * std::sin(19.0 + i + 3.0 * k);
      A1(6 + i, k) = 1e-3 * std::sin(20.0 + 3.0 * i + k) / coupling;
    }
  }
  return make_setting("[trace]\nparameter = \"p\"\nfrom = 0\nto = 1\n[matrix_family]\nA = " + text({A0, A1}) +
                      "\n");
}

/// Members of a cluster that move a hundred times their distance: one by one and all at once, in an adapted
/// norm, none of them may be taken for another one.
TEST(Certificate, StaysOpenForMembersOfAClusterThatAreExchanged) {
  for (const double coupling : {1.0, 100.0}) {
    Step step(common_cluster(coupling), 0.0, 0.05);
    for (std::size_t first = 0; first < 5; ++first) {
      std::swap(step.right.tracks[first], step.right.tracks[first + 1]);
      const std::vector<bool> together = certified_together(step);
      for (const std::size_t i : {first, first + 1}) {
        EXPECT_FALSE(step.certified(i)) << i << ", coupling " << coupling;
        EXPECT_FALSE(together[i]) << i << ", coupling " << coupling;
      }
      std::swap(step.right.tracks[first], step.right.tracks[first + 1]);
    }
  }
}

/// What they move in common, fifty times their distance, needs no block.
TEST(ModalCertificate, ClosesForMembersOfAClusterThatMoveInCommon) {
  Step step(common_cluster(1.0), 0.0, 0.05);
  ASSERT_EQ(step.left.tracks.size(), 12U);
  EXPECT_EQ(certified_together(step), std::vector<bool>(12, true));
}

TEST(Certificate, ClosesForACoupledModeFarFromNormalInAFewPieces) {
  Step step(common_cluster(100.0), 0.0, 0.001);
  const auto own = [](const Track& track) { return track.roots[0].real() < -10.0; };
  for (std::size_t i = 0; i < step.left.tracks.size(); ++i) {
    if (own(step.left.tracks[i])) {
      EXPECT_TRUE(step.certified(i)) << step.left.tracks[i].roots[0];
    }
  }
  EXPECT_LE(step.counts.certificate_factorizations, 2U * step.left.tracks.size());
}

/// Two modes in a veering as one block, beside which the others stay.
TEST(ModalCertificate, ClosesForABlockOfModesThatExchangeTheirShapes) {
  for (const double eps : {1e-2, 1e-4, 1e-8}) {
    Step step(veering(eps), -0.3, -0.29);
    step.join(0.3);
    EXPECT_EQ(certified_together(step), std::vector<bool>{true}) << eps;
  }
}

TEST(ModalCertificate, NeedsAllTracksOfItsPart) {
  Step step(smooth_family(), 0.2, 0.4);
  StepPencil pencil(step.left, step.right, step.length);
  EXPECT_EQ(certify_all(pencil, step.right, 1, step.counts), std::vector<bool>(3, false)) << "another part";
  step.left.tracks.pop_back();
  step.right.tracks.pop_back();
  EXPECT_EQ(certified_together(step), std::vector<bool>(2, false));
}

/// States in units that differ by powers of ten: the bounds are about the same.
TEST(ModalCertificate, ClosesInAsManyPiecesInAnyUnits) {
  const auto bases = [](double unit) {
    const Matrix K0{{3.0, 0.5 * unit, 0.2}, {0.4 / unit, 9.0, -0.3 / unit}, {0.1, 0.2 * unit, 20.0}};
    const Matrix K1{{1.0, 0.3 * unit, 0.0}, {0.2 / unit, -1.0, 0.4 / unit}, {0.5, 0.0, 2.0}};
    Step step(make_setting(family_scene({{Matrix::Identity(3, 3)}, {}, {K0, K1}}, 0.0, 1.0)), 0.0, 0.6);
    EXPECT_EQ(certified_together(step), std::vector<bool>(3, true)) << unit;
    return step.counts.certificate_bases;
  };
  for (const double unit : {1e-4, 1e-2, 1e2, 1e4}) EXPECT_EQ(bases(unit), bases(1.0)) << unit;
}

/// s = -p and -1 + p meet at p = 1/2, coupled by nothing: the test of neither closes over the crossing,
/// wherever it lies between the samples.
TEST(ModalCertificate, StaysOpenWhereEigenvaluesCross) {
  for (const double to : {0.6, 0.75, 0.9, 1.0}) {
    Step step(make_setting("[trace]\nparameter = \"p\"\nfrom = 0\nto = 1\n[matrix_family]\n"
                           "A = [ [[0, 0], [0, -1]], [[-1, 0], [0, 1]] ]\n"),
              0.1, to);
    EXPECT_EQ(certified_together(step), std::vector<bool>(2, false)) << to;
  }
}

/// mu = 1/s of one mode is followed in place of s: its test is that of s.
TEST(ModalCertificate, ClosesForATrackInTheOtherChart) {
  Step step(smooth_family(), 0.2, 0.4);
  for (PathNode* node : {&step.left, &step.right}) {
    Track& track = node->tracks[1];
    track.pair.chart = Chart::reciprocal;
    track.series.Lambda = inverse_series(track.series.Lambda);
  }
  EXPECT_EQ(certified_together(step), std::vector<bool>(3, true));
}

TEST(StepPencil, HasTheEigenvaluesOfThePathBetweenItsPoints) {
  // The tangent basis turns along the path: the pencils agree up to a change of basis.
  Step step(scene_setting("rotating_mass"), 100.0, 90.0);
  const StepPencil pencil(step.left, step.right, step.length);
  const Setting setting = scene_setting("rotating_mass");
  RunCounts counts;
  for (const double t : {0.0, 0.3, 0.5, 1.0}) {
    const auto sample = pencil.at(t);
    std::vector<Complex> expected;
    for (const InvariantPair& pair : point_from_guess(setting.problem(), 100.0 - 10.0 * t, counts).pairs) {
      expected.push_back(pair.eigenvalue());
      expected.push_back(std::conj(pair.eigenvalue()));
    }
    EXPECT_LT(matched_distance(expected, quadratic_eigenvalues(sample->at.M, sample->at.C, sample->at.K)),
              1e-9)
        << "t = " << t;
  }
}

TEST(Certificate, ClosesWhereTheTangentBasisTurns) {
  Step step(scene_setting("rotating_mass"), 100.0, 90.0);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_TRUE(step.certified(i)) << "mode " << i;
  step.join(90.0);
  EXPECT_TRUE(step.certified(0)) << "as a block";
}

}  // namespace
}  // namespace eigentrail::test::certificate_test
