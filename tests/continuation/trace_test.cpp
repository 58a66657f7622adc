// The trace loop: identity of modes, status of traces that end early, independence of the tangent basis.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "eigentrail/modes/regroup.hpp"
#include "support/matrix_text.hpp"
#include "support/scenes.hpp"
#include "support/spectra.hpp"

namespace eigentrail::test::trace_test {
namespace {

TEST(Trace, RandomBasisAtEveryPointChangesNoEigenvalue) {
  const Setting setting = scene_setting("rotating_mass");
  const RecordedTrace recorded = record_trace(setting, BasisChoice::random);
  ASSERT_EQ(recorded.result.status, TraceStatus::completed) << recorded.result.message;
  PathProblem problem = setting.problem();
  RunCounts counts;
  counts.evaluations = setting.model->new_counts();
  for (const PathNode& node : recorded.nodes) {
    Prediction prediction{node.p, {node.path.x.col(0), node.path.lambda.col(0), true}, {}};
    for (const Track& track : node.tracks) {
      prediction.pairs.push_back(track.pair);
      prediction.pairs.back().Z = track.series.Z[0];
    }
    const PathPoint aligned = compute_point(problem, prediction, node.basis.T[0], counts);
    ASSERT_EQ(aligned.status, PointStatus::computed);
    std::vector<Complex> expected, found;
    for (std::size_t i = 0; i < node.tracks.size(); ++i) {
      for (const Complex s : node.tracks[i].roots) expected.push_back(s);
      for (const Complex s : pair_eigenvalues(aligned.pairs[i])) found.push_back(s);
    }
    ASSERT_EQ(found.size(), 2U);
    EXPECT_LT(matched_distance(expected, found), 1e-13) << "at " << node.p;
  }
}

TEST(Trace, RandomBasisTakesTheSameSteps) {
  const Setting setting = scene_setting("rotating_mass");
  EXPECT_EQ(record_trace(setting, BasisChoice::random).result.nodes, record_trace(setting).result.nodes);
}

/// ds/dp of a mode at a point.
Complex slope_of(const std::vector<ModeState>& modes, int mode) {
  for (const ModeState& state : modes) {
    if (state.mode == mode) return state.slope;
  }
  throw std::out_of_range("no such mode");
}

TEST(Trace, DerivativesAreRefinedBesideAVeering) {
  // Long steps at a loose tolerance predict poorly beside a veering of half-width 0.02, and the factors
  // belong to the prediction.
  const Setting setting = make_setting(
      "[trace]\nparameter = \"p\"\nfrom = -0.73\nto = 1\ntolerance = 1e-3\norder = 4\n"
      "[matrix_family]\nM = [ [[1, 0], [0, 1]] ]\nK = [ [[4, 0.02], [0.02, 4]], [[1, 0], [0, -1]] ]\n");
  const RecordedTrace recorded = completed_trace(setting);
  for (std::size_t i = 0; i < recorded.nodes.size(); ++i) {
    const PathNode& node = recorded.nodes[i];
    const double root = std::hypot(node.p, 0.02);
    for (const auto& [mode, sign] : {std::pair(0, -1.0), std::pair(1, 1.0)}) {
      const double expected = sign * node.p / root / (2.0 * std::sqrt(4.0 + sign * root));
      EXPECT_NEAR(slope_of(recorded.modes[i], mode).imag(), expected, 1e-10) << "at " << node.p;
    }
  }
}

TEST(Trace, OverdampedRootsOfOneFreedomAreTwoModes) {
  // The two real modes have the same shape. They are distinguished by their eigenvalues.
  const Setting setting = make_setting(
      "[trace]\nparameter = \"p\"\nfrom = 3\nto = 8\n[matrix_family]\nM = [ [[1]] ]\nC = [ [[0]], [[1]] ]\nK "
      "= [ [[1]] ]\n");
  const RecordedTrace recorded = completed_trace(setting);
  ASSERT_EQ(recorded.result.n_modes, 2);
  for (int i = 0; i <= 20; ++i) {
    const double p = 3.0 + i / 4.0;
    const double root = std::sqrt(p * p - 4.0);
    const ComplexVector s = recorded.eigenvalues_at(p);
    EXPECT_NEAR(s[0].real(), -2.0 / (p + root), 1e-6);
    EXPECT_NEAR(s[1].real(), -(p + root) / 2.0, 1e-5);
    EXPECT_EQ(s[0].imag(), 0.0);
  }
}

TEST(Trace, ClusterThatRoundingTearsApartIsReportedAtTheStart) {
  // One Jordan chain of length eight: K = S (4 + N) S^-1 with integer S. Its eigenvalues are known only to
  // the eighth root of rounding, so their blocks cannot be determined.
  constexpr Eigen::Index n = 8;
  Matrix chain = 4.0 * Matrix::Identity(n, n);
  chain.diagonal(1).setOnes();
  const Matrix S = Matrix::Ones(n, n).triangularView<Eigen::Lower>();
  Matrix inverse = Matrix::Identity(n, n);
  inverse.diagonal(-1).setConstant(-1.0);
  const Matrix K = S * chain * inverse;
  const Matrix I = Matrix::Identity(n, n);
  const RecordedTrace recorded = record_trace(make_setting(family_scene({{I}, {}, {K, I}}, 0.0, 1.0)));
  EXPECT_EQ(recorded.result.status, TraceStatus::multiple_mode) << recorded.result.message;
  EXPECT_FALSE(has_started(recorded.result.status));
  EXPECT_NE(recorded.result.message.find("p = 0"), std::string::npos) << recorded.result.message;
  EXPECT_TRUE(recorded.nodes.empty());
}

/// Two modes of different damping whose frequencies cross, coupled less than their dampings differ: the
/// exceptional points lie on one side of the real axis, and each mode goes straight on.
class PassingModes : public testing::TestWithParam<std::tuple<double, std::string>> {};

TEST_P(PassingModes, KeepTheirIdentityAtEveryTolerance) {
  const auto& [coupling, tolerance] = GetParam();
  std::ostringstream k;
  k << coupling;
  const Setting setting = make_setting(
      "[trace]\nparameter = \"p\"\nfrom = -0.5\nto = 0.6\ntolerance = " + tolerance +
      "\n[matrix_family]\nM = [ [[1, 0], [0, 1]] ]\nC = [ [[0.01, 0], [0, 0.02]] ]\nK = [ [[1, " + k.str() +
      "], [" + k.str() + ", 1]], [[1, 0], [0, -1]] ]\n");
  const RecordedTrace recorded = completed_trace(setting);
  double worst = 0.0;
  for (int i = 0; i <= 100; ++i) {
    const double p = std::min(-0.5 + 1.1 * i / 100.0, 0.6);
    // Without the coupling, which moves them by less than its square over the difference in damping.
    const Complex rising(-0.005, std::sqrt(1.0 + p - 0.005 * 0.005));
    const Complex falling(-0.01, std::sqrt(1.0 - p - 0.01 * 0.01));
    const ComplexVector s = recorded.eigenvalues_at(p);
    worst = std::max({worst, std::abs(s[0] - rising), std::abs(s[1] - falling)});
  }
  EXPECT_LT(worst, 1e-3) << "exchanged";
  for (const Event& event : recorded.result.events) {
    EXPECT_NE(event.kind, EventKind::collision) << event_line(event) << ": they never meet";
    EXPECT_NE(event.kind, EventKind::crossing) << event_line(event) << ": they never meet";
  }
}

INSTANTIATE_TEST_SUITE_P(Couplings, PassingModes,
                         testing::Combine(testing::Values(0.0, 1e-4, 5e-4),
                                          testing::Values("1e-4", "1e-6", "1e-8")));

TEST(Trace, FaultyOptionsOfALibraryUserThrow) {
  Setting setting = scene_setting("rotating_mass");
  const auto rejects = [&](auto change) {
    TraceOptions options = setting.options;
    change(options);
    EXPECT_THROW((void)trace(*setting.model, options, {}), std::invalid_argument);
  };
  rejects([](TraceOptions& o) { o.parameter = "omga"; });
  rejects([](TraceOptions& o) { o.order = 0; });
  rejects([](TraceOptions& o) { o.from = NAN; });
  rejects([](TraceOptions& o) { o.tolerance = 0.0; });
  rejects([](TraceOptions& o) { o.max_step = -1.0; });
}

TEST(Trace, RigidBodyModeAloneCanBeFollowed) {
  // s^2 + s = 0 has a simple root at zero, whose magnitude is rounding.
  const Setting setting = make_setting(
      "[trace]\nparameter = \"p\"\nfrom = 0\nto = 1\nmodes = 1\n[matrix_family]\nM = [ [[1]], [[1]] ]\nC = [ "
      "[[1]] ]\n"
      "K = [ [[0]] ]\n");
  const RecordedTrace recorded = completed_trace(setting);
}

/// There is a point on it, so that the eigenvalue, which varies like the fourth root of 1 - p, is known to
/// the rounding of p.
TEST(Trace, HasAPointOnAFold) {
  const RecordedTrace trace = completed_trace(pushed_pendulum({}, {{"tolerance", "1e-9"}}));
  ASSERT_EQ(trace.result.events.size(), 1U);
  EXPECT_EQ(trace.result.events[0].kind, EventKind::fold);
  EXPECT_NEAR(trace.result.events[0].p, 1.0, 1e-15);
  const double nearest = std::abs(std::max_element(trace.nodes.begin(), trace.nodes.end(),
                                                   [](const auto& a, const auto& b) { return a.p < b.p; })
                                      ->p -
                                  1.0);
  EXPECT_LE(nearest, 1e-15);
  for (const double depth : {1e-3, 1e-6, 1e-9}) {
    const double p = 1.0 - depth;
    const double expected = std::pow(9.81 * 9.81 * (1.0 - p) * (1.0 + p), 0.25);
    const double rounding = 2.0 * std::numeric_limits<double>::epsilon() / (4.0 * (1.0 - p));
    const auto found = trace.all_eigenvalues_at(p);
    ASSERT_EQ(found.size(), 2U);  // hanging, and standing on the way back
    EXPECT_NEAR(found[0][0].imag(), expected, (1e-8 + rounding) * expected) << depth;
    EXPECT_NEAR(std::abs(found[1][0].real()), expected, (1e-8 + rounding) * expected) << depth;
  }
}

TEST(Trace, StopsWhenTheObserverSaysSo) {
  const Setting setting = scene_setting("rotating_mass");
  int seen = 0;
  TraceObserver observer;
  observer.point = [&](const TracePoint&) { return ++seen < 5; };
  const TraceResult result = trace(*setting.model, setting.options, observer);
  EXPECT_EQ(result.status, TraceStatus::stopped);
  EXPECT_EQ(seen, 5);
}

}  // namespace
}  // namespace eigentrail::test::trace_test
