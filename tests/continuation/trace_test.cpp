// The trace loop: identity of modes, outcomes as values, independence of the choice of basis.
#include <gtest/gtest.h>

#include <cmath>

#include "support/scenes.hpp"

namespace eigentrail::test {
namespace {

TEST(Trace, RandomBasisAtEveryPointChangesNoEigenvalue) {
  const Setting setting = scene_setting("rotating_mass");
  const RecordedTrace recorded = record_trace(setting, BasisChoice::random);
  ASSERT_EQ(recorded.result.status, TraceStatus::completed) << recorded.result.message;
  PathProblem problem = setting.problem();
  RunCounts counts;
  counts.evaluations = setting.model->new_counts();
  for (const PathNode& node : recorded.nodes) {
    Prediction prediction{
        {node.path.x.col(0), node.path.lambda.col(0), true}, node.s.col(0), ComplexMatrix(3, 2)};
    for (int i = 0; i < 2; ++i) prediction.shapes.col(i) = node.shapes[static_cast<std::size_t>(i)].col(0);
    const PathPoint aligned = compute_point(problem, node.p, prediction, node.basis, counts);
    for (int i = 0; i < 2; ++i) {
      const Complex s = node.s(i, 0);
      EXPECT_LT(std::abs(aligned.modes[static_cast<std::size_t>(i)].s - s), 1e-13 * std::abs(s))
          << "at " << node.p;
    }
  }
}

TEST(Trace, RandomBasisTakesTheSameSteps) {
  const Setting setting = scene_setting("rotating_mass");
  EXPECT_EQ(record_trace(setting, BasisChoice::random).result.nodes, record_trace(setting).result.nodes);
}

TEST(Trace, UpAndDownAgree) {
  const RecordedTrace down = record_trace(scene_setting("rotating_mass", {{"from", "60"}, {"to", "10"}}));
  const RecordedTrace up =
      record_trace(scene_setting("rotating_mass", {{"from", "10"}, {"to", "60"}},
                                 {{"[\"offset + length\", 0, 0]", "[5.89, -0.58, 0.84]"}}));
  ASSERT_EQ(up.result.status, TraceStatus::completed) << up.result.message;
  for (int i = 0; i <= 50; ++i) {
    const double p = 10.0 + i;
    const ComplexVector a = down.eigenvalues_at(p);
    const ComplexVector b = up.eigenvalues_at(p);
    for (int k = 0; k < 2; ++k) EXPECT_LT(std::abs(a[k] - b[k]), 8e-8 * std::abs(a[k])) << "at " << p;
  }
}

TEST(Trace, EndsExactlyWhereItWasAskedTo) {
  const RecordedTrace recorded = record_trace(scene_setting("rotating_mass", {{"to", "37.7"}}));
  EXPECT_EQ(recorded.nodes.front().p, 100.0);
  EXPECT_EQ(recorded.nodes.back().p, 37.7);
}

TEST(Trace, FollowsTheModesOfLeastMagnitude) {
  const RecordedTrace recorded = record_trace(scene_setting("rotating_mass", {{"modes", "1"}}));
  EXPECT_EQ(recorded.result.n_modes, 1);
  EXPECT_EQ(recorded.result.n_available, 2);
  EXPECT_NEAR(recorded.nodes.front().s(0, 0).imag(), 44.72, 0.01);
}

TEST(Trace, ModesThatCrossKeepTheirIdentity) {
  // s^2 = -(1 +- p) with vectors that do not turn: the frequencies cross at p = 0.
  const Setting setting = make_setting(
      "[trace]\nparameter = \"p\"\nfrom = -0.5\nto = 0.5\n[matrix_family]\nM = [ [[1, 0], [0, 1]] ]\n"
      "K = [ [[1, 0], [0, 1]], [[0.17, 0.985], [0.985, -0.17]] ]\n");
  const RecordedTrace recorded = record_trace(setting);
  ASSERT_EQ(recorded.result.status, TraceStatus::completed) << recorded.result.message;
  const double slope = std::sqrt(0.17 * 0.17 + 0.985 * 0.985);
  for (int i = 0; i <= 40; ++i) {
    const double p = -0.5 + i / 40.0;
    EXPECT_NEAR(recorded.eigenvalues_at(p)[0].imag(), std::sqrt(1.0 + slope * p), 1e-5);
    EXPECT_NEAR(recorded.eigenvalues_at(p)[1].imag(), std::sqrt(1.0 - slope * p), 1e-5);
  }
}

TEST(Trace, ModesThatVeerKeepTheirOrder) {
  // Coupling 0.05: the frequencies come close and turn away, exchanging shapes over many steps.
  const Setting setting = make_setting(
      "[trace]\nparameter = \"p\"\nfrom = -0.5\nto = 0.5\n[matrix_family]\nM = [ [[1, 0], [0, 1]] ]\n"
      "K = [ [[1, 0.05], [0.05, 1]], [[1, 0], [0, -1]] ]\n");
  const RecordedTrace recorded = record_trace(setting);
  ASSERT_EQ(recorded.result.status, TraceStatus::completed) << recorded.result.message;
  for (int i = 0; i <= 40; ++i) {
    const double p = -0.5 + i / 40.0;
    const double root = std::sqrt(p * p + 0.0025);
    EXPECT_NEAR(recorded.eigenvalues_at(p)[0].imag(), std::sqrt(1.0 - root), 1e-5);
    EXPECT_NEAR(recorded.eigenvalues_at(p)[1].imag(), std::sqrt(1.0 + root), 1e-5);
  }
}

TEST(Trace, DerivativesAreRefinedBesideAVeering) {
  // Long steps at a loose tolerance predict poorly beside a veering of half-width 0.02, and the factors
  // belong to the prediction.
  const Setting setting = make_setting(
      "[trace]\nparameter = \"p\"\nfrom = -0.73\nto = 1\ntolerance = 1e-3\norder = 4\n"
      "[matrix_family]\nM = [ [[1, 0], [0, 1]] ]\nK = [ [[4, 0.02], [0.02, 4]], [[1, 0], [0, -1]] ]\n");
  const RecordedTrace recorded = record_trace(setting);
  ASSERT_EQ(recorded.result.status, TraceStatus::completed) << recorded.result.message;
  for (const PathNode& node : recorded.nodes) {
    const double root = std::hypot(node.p, 0.02);
    for (const auto& [mode, sign] : {std::pair(0, -1.0), std::pair(1, 1.0)}) {
      const double expected = sign * node.p / root / (2.0 * std::sqrt(4.0 + sign * root));
      EXPECT_NEAR(node.s(mode, 1).imag(), expected, 1e-10) << "at " << node.p;
    }
  }
}

TEST(Trace, OverdampedRootsOfOneFreedomAreTwoModes) {
  // The two real roots share their shape: identity is decided by the eigenvalue.
  const Setting setting = make_setting(
      "[trace]\nparameter = \"p\"\nfrom = 3\nto = 8\n[matrix_family]\nM = [ [[1]] ]\nC = [ [[0]], [[1]] ]\nK "
      "= [ [[1]] ]\n");
  const RecordedTrace recorded = record_trace(setting);
  ASSERT_EQ(recorded.result.status, TraceStatus::completed) << recorded.result.message;
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

TEST(Trace, EveryOutcomeAtTheStartIsAStatusWithAReason) {
  const auto family = [](const std::string& M, const std::string& K) {
    return make_setting("[trace]\nparameter = \"p\"\nfrom = 0\nto = 1\n[matrix_family]\nM = " + M +
                        "\nK = " + K + "\n");
  };
  const RecordedTrace singular =
      record_trace(family("[ [[1, 0], [0, 0]] ]", "[ [[1, 0], [0, 0]], [[1, 0], [0, 0]] ]"));
  EXPECT_EQ(singular.result.status, TraceStatus::singular_pencil);
  EXPECT_FALSE(has_started(singular.result.status));
  EXPECT_TRUE(singular.nodes.empty());
  const RecordedTrace defective =
      record_trace(family("[ [[1, 0], [0, 1]] ]", "[ [[1, 0.5], [-0.5, 2]], [[1, 0], [0, 0]] ]"));
  EXPECT_EQ(defective.result.status, TraceStatus::multiple_mode) << defective.result.message;
  EXPECT_FALSE(defective.result.message.empty());
}

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
  const RecordedTrace recorded = record_trace(setting);
  EXPECT_EQ(recorded.result.status, TraceStatus::completed) << recorded.result.message;
}

TEST(Trace, StopsWhenTheObserverSaysSo) {
  const Setting setting = scene_setting("rotating_mass");
  int seen = 0;
  TraceObserver observer;
  observer.node = [&](const PathNode&) { return ++seen < 5; };
  const TraceResult result = trace(*setting.model, setting.options, observer);
  EXPECT_EQ(result.status, TraceStatus::stopped);
  EXPECT_EQ(seen, 5);
}

TEST(Trace, GivesUpAfterTooManyPoints) {
  const RecordedTrace recorded = record_trace(scene_setting("rotating_mass", {{"max_nodes", "7"}}));
  EXPECT_EQ(recorded.result.status, TraceStatus::too_many_nodes);
  EXPECT_EQ(recorded.nodes.size(), 7U);
}

}  // namespace
}  // namespace eigentrail::test
