// Crossings of modes of independent parts, each with one freedom: places and derivatives in closed form.
#include "continuation/events/part_crossings.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/trace/trace_state.hpp"
#include "continuation/tracks/starting_tracks.hpp"
#include "eigentrail/modes/spectrum.hpp"
#include "support/matrix_text.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::part_crossings_test {
namespace {

constexpr Complex j{0.0, 1.0};

/// Keeps references to itself.
struct Parts {
  explicit Parts(Setting given)
      : setting(std::move(given)),
        problem(trace_problem(*setting.model, setting.options, BasisChoice::aligned)),
        frame{PathRange{problem.traced, setting.options.from, setting.options.to}},
        points(problem, frame, counts),
        log{events, frame.range, problem.thresholds},
        search{points, setting.options, criteria, log, 1} {
    problem.s_ref = 1e-3;
    problem.s_max = 1e6;
  }

  /// The point at p: of every part the complex mode with Im s > 0, or both real ones, numbered in this order.
  PathNode at(double p) {
    const Vector guess = problem.model.initial_guess(parameters_at(problem, p));
    PathPoint point = reduce_at(problem, p, {guess, Vector()}, Matrix(), counts);
    for (std::size_t i = 0; i < problem.parts->count(); ++i) {
      const ReducedPencil& own = point.pencil.of(static_cast<int>(i));
      const Spectrum spectrum = compute_spectrum(own.M[0], own.C[0], own.K[0]);
      for (const StartingMode& mode : spectrum.modes) {
        InvariantPair start;
        start.is_real = mode.s.imag() == 0.0;
        start.part = static_cast<int>(i);
        start.Z = mode.z;
        if (start.is_real) start.Z.imag().setZero();
        start.Lambda = ComplexMatrix::Constant(1, 1, mode.s);
        point.pairs.push_back(
            correct_pair(PencilAtPoint(own), start, problem.s_ref, problem.corrector, counts.modes));
        EXPECT_EQ(point.pairs.back().status, PairStatus::converged);
      }
    }
    PathNode node = differentiate_point(problem, point, counts).value();
    for (std::size_t i = 0; i < node.tracks.size(); ++i)
      node.tracks[i].modes = node.tracks[i].arriving = {static_cast<int>(i)};
    return node;
  }

  std::vector<Event> find(double from, double to) {
    left = at(from);
    Step step;
    step.left = &left;
    step.right = at(to);
    step.h = to - from;
    return find_part_crossings(search, step).events;
  }

  /// Whether the modes of an event are those with these eigenvalues at the left end of the step.
  bool is_of(const Event& event, const std::vector<Complex>& roots) const {
    const auto belongs = [&](int mode) {
      const Complex s = left.tracks[static_cast<std::size_t>(mode)].roots[0];
      return std::any_of(roots.begin(), roots.end(), [&](Complex a) { return std::abs(a - s) < 1e-9; });
    };
    return event.modes.size() == roots.size() && std::is_sorted(event.modes.begin(), event.modes.end()) &&
           std::all_of(event.modes.begin(), event.modes.end(), belongs);
  }

  Setting setting;
  RunCounts counts;
  PathProblem problem;
  PathFrame frame;
  PointSolver points;
  std::vector<Criterion> criteria;
  std::vector<Event> events;
  EventLog log;
  EventSearch search;
  PathNode left;
};

/// s^2 + c_i s + (w_i + v_i p)^2, in their own coordinates or, with an orthogonal `turn`, in others.
struct Oscillator {
  double c, w, v;
};
Setting oscillators(const std::vector<Oscillator>& all, const Matrix& turn = {}) {
  const auto matrix = [&](const auto& entry) {
    Vector diagonal(static_cast<Eigen::Index>(all.size()));
    for (std::size_t i = 0; i < all.size(); ++i) diagonal[static_cast<Eigen::Index>(i)] = entry(all[i]);
    const Matrix A = diagonal.asDiagonal();
    return turn.size() > 0 ? Matrix(turn.transpose() * A * turn) : A;
  };
  return make_setting(family_scene({{matrix([](const Oscillator&) { return 1.0; })},
                                    {matrix([](const Oscillator& o) { return o.c; })},
                                    {matrix([](const Oscillator& o) { return o.w * o.w; }),
                                     matrix([](const Oscillator& o) { return 2.0 * o.w * o.v; }),
                                     matrix([](const Oscillator& o) { return o.v * o.v; })}},
                                   -1.0, 1.0));
}

TEST(FindPartCrossings, GivesPlaceAndEigenvalueInBothDirections) {
  Parts parts(oscillators({{0.0, 2.0, 1.0}, {0.0, 2.6, -1.0}, {0.0, 5.0, 0.5}}));
  ASSERT_EQ(parts.problem.parts->count(), 3U);
  for (const bool backward : {false, true}) {
    const std::vector<Event> found = backward ? parts.find(0.45, 0.05) : parts.find(0.05, 0.45);
    ASSERT_EQ(found.size(), 1U);
    const Event& event = found[0];
    EXPECT_EQ(event.kind, EventKind::crossing);
    EXPECT_NEAR(event.p, 0.3, 1e-12);
    EXPECT_LT(std::abs(event.s - 2.3 * j), 1e-12);
    const double p = backward ? 0.45 : 0.05;
    EXPECT_TRUE(parts.is_of(event, {(2.0 + p) * j, (2.6 - p) * j}));
    // The mean of both does not change.
    EXPECT_LT(std::abs(event.sensitivity[parts.problem.traced]), 1e-10);
  }
}

TEST(FindPartCrossings, OneBehindTheEndIsOnTheNextStepOrBehindTheRange) {
  Parts parts(oscillators({{0.0, 2.0, 1.0}, {0.0, 2.6, -1.0}}));  // at 0.3
  EXPECT_EQ(parts.find(0.1, 0.3).at(0).node, 1);
  EXPECT_EQ(parts.find(0.1, 0.3 - 1e-6).at(0).node, 2);
  EXPECT_TRUE(parts.find(0.3 + 1e-6, 0.5).empty());  // before the first one
  Parts ending(
      oscillators({{0.0, 2.0, 1.0}, {0.0, 4.0 + 1e-6, -1.0}}));  // 5e-7 behind 1, where the range ends
  EXPECT_TRUE(ending.find(0.8, 1.0).empty());
}

TEST(FindPartCrossings, FindsNothingBesideAStep) {
  Parts parts(oscillators({{0.0, 2.0, 1.0}, {0.0, 2.6, -1.0}}));
  EXPECT_TRUE(parts.find(0.0, 0.29).empty());
  EXPECT_TRUE(parts.find(0.31, 0.5).empty());
}

TEST(FindPartCrossings, UnitesAllModesOfOnePlace) {
  Parts parts(oscillators({{0.0, 2.0, 1.0}, {0.0, 2.6, -1.0}, {0.0, 2.3, 0.0}}));
  const std::vector<Event> found = parts.find(0.0, 0.5);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(parts.is_of(found[0], {2.0 * j, 2.6 * j, 2.3 * j}));
}

/// Equal parts coincide throughout, which is no crossing, also where their eigenvalues differ by rounding. A
/// third mode crosses both at once: in the search it crosses the one that is traced, in the result of a trace
/// both.
TEST(FindPartCrossings, OfEqualPartsAreNone) {
  const Matrix turn{{2.0 / 3.0, -2.0 / 3.0, 1.0 / 3.0},
                    {1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0},
                    {2.0 / 3.0, 1.0 / 3.0, -2.0 / 3.0}};
  for (const bool mixed : {false, true}) {
    const std::vector<Oscillator> all{{0.0, 2.0, 1.0}, {0.0, 2.0, 1.0}, {0.0, 2.6, -1.0}};
    Parts parts(oscillators(all, mixed ? turn : Matrix()));
    ASSERT_EQ(parts.problem.parts->count(), 2U);
    EXPECT_EQ(parts.problem.parts->freedoms(), 3);
    EXPECT_TRUE(parts.find(0.0, 0.2).empty());
    const std::vector<Event> found = parts.find(0.0, 0.5);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].modes.size(), 2U);
    EXPECT_NEAR(found[0].p, 0.3, 1e-12);
    const RecordedTrace trace = record_trace(oscillators(all, mixed ? turn : Matrix()));
    ASSERT_EQ(trace.result.events.size(), 1U);
    EXPECT_EQ(trace.result.events[0].modes, (std::vector<int>{0, 1, 2}));
  }
}

/// Im s agrees at one place, Re s does not: they pass beside each other.
TEST(FindPartCrossings, NeedsBothComponentsToAgree) {
  for (const double c : {0.2, 1e-3}) {
    Parts damped(oscillators({{c, 2.0, 1.0}, {0.0, 2.6, -1.0}}));
    EXPECT_TRUE(damped.find(0.0, 0.5).empty()) << c;
  }
  Parts alike(oscillators({{0.2, 2.0, 1.0}, {0.2, 2.6, -1.0}}));
  const std::vector<Event> found = alike.find(0.0, 0.5);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].p, 0.3, 1e-12);
  EXPECT_NEAR(found[0].s.real(), -0.1, 1e-12);
}

/// s^2 + 4 s + (1 + p)^2 and s^2 + 6 s + 1.5^2: the slower real modes cross where
/// (1 + p)^2 = 4 a - a^2, with -a the slower root of the other.
TEST(FindPartCrossings, OfRealModesToo) {
  Parts parts(oscillators({{4.0, 1.0, 1.0}, {6.0, 1.5, 0.0}}));
  const double a = 3.0 - std::sqrt(9.0 - 2.25);
  const double p = std::sqrt(4.0 * a - a * a) - 1.0;
  const std::vector<Event> found = parts.find(p - 0.1, p + 0.15);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].p, p, 1e-11);
  EXPECT_LT(std::abs(found[0].s + a), 1e-11);
}

/// Two masses on springs, p and q: they cross at p / m = q / n. Its place moves with q by m / n.
TEST(FindPartCrossings, KnowsHowThePlaceMoves) {
  Parts parts(
      make_setting("[parameters]\np = 5.0\nq = 6.0\nm = 2.0\nn = 3.0\n[trace]\nparameter = \"p\"\nfrom = 3\n"
                   "to = 5\n[matrix_family]\nM = [[[\"m\", 0], [0, \"n\"]]]\n"
                   "K = [[[0, 0], [0, \"q\"]], [[1, 0], [0, 0]]]\n"));
  ASSERT_TRUE(parts.problem.parts);
  const std::vector<Event> found = parts.find(3.7, 4.6);
  ASSERT_EQ(found.size(), 1U);
  const Event& event = found[0];
  EXPECT_NEAR(event.p, 4.0, 1e-10);
  const Setting& setting = parts.setting;
  EXPECT_NEAR(event.shift[setting.parameter("q")], 2.0 / 3.0, 1e-8);
  EXPECT_NEAR(event.shift[setting.parameter("m")], 2.0, 1e-8);
  EXPECT_NEAR(event.shift[setting.parameter("n")], -4.0 / 3.0, 1e-8);
  // Half of ds/dq = j / (2 sqrt(q n)): only one of the two moves.
  EXPECT_LT(std::abs(event.sensitivity[setting.parameter("q")] - 0.25 / std::sqrt(18.0) * j), 1e-9);
}

}  // namespace
}  // namespace eigentrail::test::part_crossings_test
