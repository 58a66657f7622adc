// Branch points: passed on both paths from both sides, and left on the other path.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "continuation/on_path.hpp"

namespace eigentrail::test::branch_test {
namespace {

constexpr double tolerance = 1e-9;

/// Path of the spring pendulum, by its guess and the choice at the branch point.
Setting on_spring(double from, double to, const std::string& position, OptionTexts options = {}) {
  options.emplace_back("tolerance", "1e-9");
  return spring_pendulum(position, from, to, options);
}

/// -s^2 on the two paths.
double tilted_stiffness(double k) {
  return (k - critical_stiffness) * (k + critical_stiffness) / (2.0 * k);
}
double straight_stiffness(double k) {
  return (critical_stiffness - k) / 2.0;
}

/// Turns with its plane about the vertical: straight for every speed, tilted for omega^2 > g / l.
const double critical_speed = std::sqrt(9.81 / 1.5);

Setting whirling_pendulum(double from, const OptionTexts& options) {
  return make_setting("[parameters]\nomega = 1.0\n[trace]\ntolerance = 1e-9\nparameter = \"omega\"\nfrom = " +
                          exact_text(from) + R"(
to = 5
[frame]
angular_velocity = [0, 0, "omega"]
[gravity]
acceleration = [0, 0, -9.81]
[[point]]
name = "bob"
mass = 2.0
position = [0, 0, -1.5]
[[rod]]
from = [0, 0, 0]
to = "bob"
length = 1.5
[[fixed]]
point = "bob"
coordinate = "y"
)",
                      options);
}

/// Every mode at every passage through p has s^2 = -stiffness of one of the paths.
void expect_squares(const RecordedTrace& trace, double p, const std::vector<double>& stiffnesses) {
  const auto passages = trace.all_eigenvalues_at(p);
  ASSERT_EQ(passages.size(), stiffnesses.size()) << "at " << p;
  for (std::size_t i = 0; i < passages.size(); ++i) {
    int present = 0;
    for (const Complex s : passages[i]) {
      if (!std::isfinite(s.real())) continue;
      ++present;
      const double scale = std::max(std::abs(stiffnesses[i]), 1e-4);
      EXPECT_LT(std::abs(s * s + stiffnesses[i]), 4.0 * tolerance * scale) << "passage " << i << " at " << p;
    }
    EXPECT_EQ(present, stiffnesses[i] > 0.0 ? 1 : 2) << "passage " << i << " at " << p;
  }
}

/// Completed, with this pitchfork and nothing else, and a point on it.
void expect_pitchfork(const RecordedTrace& trace, double p) {
  ASSERT_EQ(trace.result.status, TraceStatus::completed) << trace.result.message;
  ASSERT_EQ(trace.result.events.size(), 1U);
  EXPECT_EQ(trace.result.events[0].kind, EventKind::branch_point);
  EXPECT_NEAR(trace.result.events[0].p, p, 1e-11);
  double nearest = INFINITY;
  for (const PathNode& node : trace.nodes) nearest = std::min(nearest, std::abs(node.p - p));
  EXPECT_LT(nearest, 1e-11);
}

const std::vector<double> beside{1e-8, 1e-5, 1e-2, 1.0, 5.0};

TEST(BranchPoint, IsPassedOnTheStraightPath) {
  for (const bool down : {true, false}) {
    const auto trace =
        record_trace(down ? on_spring(20, 6, hanging_straight) : on_spring(6, 20, hanging_straight));
    expect_pitchfork(trace, critical_stiffness);
    for (const double d : beside) {
      for (const double k : {critical_stiffness - d, critical_stiffness + d})
        expect_squares(trace, k, {straight_stiffness(k)});
    }
  }
}

TEST(BranchPoint, IsPassedOnTheTiltedPathWhichTurnsBack) {
  const auto trace = record_trace(on_spring(20, 6, hanging_tilted));
  expect_pitchfork(trace, critical_stiffness);
  EXPECT_EQ(trace.nodes.back().p, 20.0);
  EXPECT_NEAR(trace.nodes.back().path.x(0, 0), -trace.nodes.front().path.x(0, 0), 1e-9);
  for (const double d : beside) {
    const double k = critical_stiffness + d;
    expect_squares(trace, k, {tilted_stiffness(k), tilted_stiffness(k)});
  }
}

TEST(BranchPoint, IsLeftFromTheStraightPathToEitherSide) {
  for (const auto& [branch, side] : {std::pair("2", 1.0), std::pair("3", -1.0)}) {
    const auto trace = record_trace(on_spring(6, 20, hanging_straight, {{"branch", branch}}));
    expect_pitchfork(trace, critical_stiffness);
    EXPECT_EQ(trace.nodes.back().p, 20.0);
    const double cosine = critical_stiffness / 20.0;
    EXPECT_NEAR(trace.nodes.back().path.x(0, 0), side * 1.5 * std::sqrt(1.0 - cosine * cosine), 1e-10);
    for (const double d : beside) {
      expect_squares(trace, critical_stiffness - d, {straight_stiffness(critical_stiffness - d)});
      expect_squares(trace, critical_stiffness + d, {tilted_stiffness(critical_stiffness + d)});
    }
    ASSERT_EQ(trace.result.notes.size(), 1U);
    EXPECT_NE(trace.result.notes[0].find("branch 2 leaves it"), std::string::npos);
    EXPECT_NE(trace.result.notes[0].find("the trace took " + std::string(branch)), std::string::npos);
  }
}

TEST(BranchPoint, IsLeftFromTheTiltedPathTowardsTheEndFirst) {
  const auto onward = record_trace(on_spring(20, 6, hanging_tilted, {{"branch", "2"}}));
  expect_pitchfork(onward, critical_stiffness);
  EXPECT_EQ(onward.nodes.back().p, 6.0);
  const auto back = record_trace(on_spring(20, 6, hanging_tilted, {{"branch", "3, 1"}}));
  expect_pitchfork(back, critical_stiffness);
  EXPECT_EQ(back.nodes.back().p, 20.0);
  for (const double d : beside) {
    const double above = critical_stiffness + d;
    const double below = critical_stiffness - d;
    expect_squares(onward, above, {tilted_stiffness(above)});
    expect_squares(onward, below, {straight_stiffness(below)});
    expect_squares(back, above, {tilted_stiffness(above), straight_stiffness(above)});
  }
}

TEST(BranchPoint, MayBeWhereTheTraceBegins) {
  for (const std::string order : {"1", "2", "3", "4"}) {
    for (const auto& [branch, tilts] : {std::pair("1", false), std::pair("2", true)}) {
      const auto trace = record_trace(
          on_spring(critical_stiffness, 20, hanging_straight, {{"branch", branch}, {"order", order}}));
      expect_pitchfork(trace, critical_stiffness);
      for (const double d : beside) {
        const double k = critical_stiffness + d;
        expect_squares(trace, k, {tilts ? tilted_stiffness(k) : straight_stiffness(k)});
      }
    }
  }
}

/// At the end of this path no force acts: the only freedom has no stiffness.
TEST(BranchPoint, MayBeWhereAWhirlingPendulumBegins) {
  for (const std::string order : {"1", "2", "3", "4"}) {
    for (const std::string branch : {"1", "2", "3"}) {
      const auto trace =
          record_trace(whirling_pendulum(critical_speed, {{"branch", branch}, {"order", order}}));
      ASSERT_EQ(trace.result.status, TraceStatus::completed)
          << trace.result.message << ", order " << order << ", branch " << branch;
      expect_pitchfork(trace, critical_speed);
      for (const double d : {1e-5, 1e-2, 1.0}) {
        const double speed = critical_speed + d;
        const double hanging = (critical_speed - speed) * (critical_speed + speed);
        const double cosine = std::pow(critical_speed / speed, 2);
        expect_squares(trace, speed, {branch == "1" ? hanging : -hanging * (1.0 + cosine)});
      }
    }
  }
}

/// The reference magnitude comes from the only mode, which is slow at the start. So it is small, and hardly
/// any value counts as zero.
TEST(BranchPoint, BesideTheStartAsksForAReference) {
  const auto fails = record_trace(whirling_pendulum(critical_speed - 1e-3, {}));
  EXPECT_EQ(fails.result.status, TraceStatus::step_too_small);
  EXPECT_NE(fails.result.message.find("give a larger `reference`"), std::string::npos)
      << fails.result.message;
  const RecordedTrace passes =
      completed_trace(whirling_pendulum(critical_speed - 1e-3, {{"reference", "0.01"}}));
  expect_pitchfork(passes, critical_speed);
}

TEST(BranchPoint, MayBeWhereTheTraceEnds) {
  const auto trace = record_trace(on_spring(20, critical_stiffness, hanging_tilted));
  expect_pitchfork(trace, critical_stiffness);
  EXPECT_EQ(trace.nodes.back().p, critical_stiffness);
  EXPECT_NEAR(trace.nodes.back().path.x(0, 0), 0.0, 1e-8);
  for (const double d : beside)
    expect_squares(trace, critical_stiffness + d, {tilted_stiffness(critical_stiffness + d)});
}

/// Steep von Mises truss: unit springs from (-1, 0) and (1, 0) to an apex of unit mass, free at height 4.
/// Under its load it gives way to the side before it reaches the limit load, where L^3 = L0 w^2, L^2 = 1 +
/// w^2.
const double free_length = std::sqrt(17.0);

Setting steep_truss(const std::string& branch) {
  const std::string spring = "to = \"apex\"\nstiffness = 1.0\nfree_length = \"sqrt(17)\"\n";
  return make_setting(
      "[parameters]\nload = 0.0\n[trace]\nparameter = \"load\"\nfrom = 0\nto = 4\ntolerance = 1e-9\nbranch "
      "= " +
      branch +
      "\n[[point]]\nname = \"apex\"\nmass = 1.0\nposition = [0, 0, 4]\n[[spring]]\nfrom = [-1, 0, 0]\n" +
      spring + "[[spring]]\nfrom = [1, 0, 0]\n" + spring +
      "[[force]]\npoint = \"apex\"\ncomponents = [0, 0, \"-load\"]\n[[plane]]\npoint = \"apex\"\nnormal = "
      "[0, 1, 0]\n");
}

/// Loads at which the truss gives way sideways on its symmetric path, from above.
std::vector<double> sideways_loads() {
  std::vector<double> loads;
  for (auto [low, high] : {std::pair(3.0, 4.0), std::pair(0.1, 3.0)}) {
    const auto stiffness = [](double w) { return std::pow(1.0 + w * w, 1.5) - free_length * w * w; };
    const double sign = stiffness(high);
    for (int i = 0; i < 100; ++i) {
      const double w = 0.5 * (low + high);
      (stiffness(w) * sign > 0.0 ? high : low) = w;
    }
    loads.push_back(2.0 * low * (free_length / std::sqrt(1.0 + low * low) - 1.0));
  }
  return loads;
}

/// Forces and stiffness of the two springs at a place of the apex.
void springs_at(const Vector& x, Vector& force, Matrix& stiffness) {
  force = Vector::Zero(2);
  stiffness = Matrix::Zero(2, 2);
  for (const double support : {-1.0, 1.0}) {
    const Vector d{{x[0] - support, x[2]}};
    const double ratio = free_length / d.norm();
    force -= (1.0 - ratio) * d;
    stiffness += (1.0 - ratio) * Matrix::Identity(2, 2) + ratio / d.squaredNorm() * d * d.transpose();
  }
}

TEST(BranchPoint, OfATrussThatGivesWaySideways) {
  const std::vector<double> loads = sideways_loads();
  for (const std::string branch : {"1", "2", "3"}) {
    const RecordedTrace trace = completed_trace(steep_truss(branch));
    std::vector<double> found;
    for (const Event& event : trace.result.events) {
      if (event.kind == EventKind::branch_point) found.push_back(event.p);
    }
    ASSERT_EQ(found.size(), branch == "1" ? 2U : 1U);
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], loads[i], 1e-11);
    double farthest = 0.0;
    for (std::size_t i = 0; i < trace.nodes.size(); ++i) {
      const Vector x = trace.nodes[i].path.x.col(0);
      if (std::abs(x[0]) > std::abs(farthest)) farthest = x[0];
      Vector force;
      Matrix stiffness;
      springs_at(x, force, stiffness);
      EXPECT_LT((force - Vector{{0.0, trace.nodes[i].p}}).norm(), 1e-11) << "point " << i;
      for (const ModeState& state : trace.modes[i]) {
        const Complex determinant =
            (stiffness.cast<Complex>() + state.s * state.s * ComplexMatrix::Identity(2, 2)).determinant();
        EXPECT_LT(std::abs(determinant), 1e-11) << "point " << i << " mode " << state.mode;
      }
    }
    if (branch == "1") {
      EXPECT_LT(std::abs(farthest), 1e-9);
    }
    if (branch == "2") {
      EXPECT_GT(farthest, 0.5);
    }
    if (branch == "3") {
      EXPECT_LT(farthest, -0.5);
    }
  }
}

/// The two steps that end at the branch point have the same eigenvalues there.
TEST(BranchPoint, EigenvaluesAreContinuousAcrossIt) {
  const auto trace = record_trace(on_spring(20, 6, hanging_tilted, {{"branch", "2"}}));
  for (std::size_t i = 0; i + 1 < trace.steps.size(); ++i) {
    const auto at_end =
        step_eigenvalues(trace.steps[i], trace.eigenvalues_of_node(i), trace.eigenvalues_of_node(i + 1), 1.0);
    const auto at_begin = step_eigenvalues(trace.steps[i + 1], trace.eigenvalues_of_node(i + 1),
                                           trace.eigenvalues_of_node(i + 2), 0.0);
    for (Eigen::Index mode = 0; mode < at_end.size(); ++mode) {
      if (!std::isfinite(at_end[mode].real()) || !std::isfinite(at_begin[mode].real())) continue;
      // Where s vanishes, s^2 and not s is known to rounding.
      EXPECT_LT(std::abs(at_end[mode] * at_end[mode] - at_begin[mode] * at_begin[mode]), 1e-12)
          << "step " << i;
    }
  }
}

}  // namespace
}  // namespace eigentrail::test::branch_test
