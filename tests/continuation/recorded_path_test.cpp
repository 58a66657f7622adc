// The dense output of a path of several steps, compared with closed forms: places, parameters, eigenvalues.
#include "eigentrail/continuation/recorded_path.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace eigentrail::test::recorded_path_test {
namespace {

constexpr double rounding = 1e-13;

/// Mode 0: s = -0.1 + j (2 + p), alone. Its series at p.
ComplexMatrix single_at(double p) {
  return ComplexMatrix{{Complex(-0.1, 2.0 + p), Complex(0.0, 1.0)}};
}

DenseBlock block_of(std::vector<int> modes, ComplexMatrix left, ComplexMatrix right) {
  DenseBlock block;
  block.modes = std::move(modes);
  block.left = std::move(left);
  block.right = std::move(right);
  return block;
}

PathStep straight(double from, double to) {
  PathStep step;
  step.length = to - from;
  step.parameter = Matrix{{from, 1.0}, {to, 1.0}};
  step.blocks = {block_of({0}, single_at(from), single_at(to))};
  return step;
}

/// Nodes at 0, 0.5 and 2.
RecordedPath straight_path() {
  RecordedPath path;
  path.p = {0.0, 0.5, 2.0};
  path.eigenvalues = ComplexMatrix{{Complex(-0.1, 2.0)}, {Complex(-0.1, 2.5)}, {Complex(-0.1, 4.0)}};
  path.steps = {straight(0.0, 0.5), straight(0.5, 2.0)};
  return path;
}

/// p = 1 - (sigma - 1)^2 from sigma = 0 to 1.5: over the fold at p = 1, and back to 0.75. Mode: s = j (2 +
/// sigma).
RecordedPath folded_path() {
  RecordedPath path;
  const auto p_at = [](double sigma) { return 1.0 - std::pow(sigma - 1.0, 2); };
  const std::vector<double> nodes{0.0, 0.6, 1.5};
  path.eigenvalues.resize(3, 1);
  for (std::size_t i = 0; i < 3; ++i) {
    path.p.push_back(p_at(nodes[i]));
    path.eigenvalues(static_cast<Eigen::Index>(i), 0) = Complex(0.0, 2.0 + nodes[i]);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const double a = nodes[i];
    const double b = nodes[i + 1];
    PathStep step;
    step.length = b - a;
    step.parameter = Matrix{{p_at(a), -2.0 * (a - 1.0), -1.0}, {p_at(b), -2.0 * (b - 1.0), -1.0}};
    ComplexMatrix left = ComplexMatrix::Zero(1, 3);
    ComplexMatrix right = left;
    left << Complex(0.0, 2.0 + a), Complex(0.0, 1.0), 0.0;
    right << Complex(0.0, 2.0 + b), Complex(0.0, 1.0), 0.0;
    step.blocks = {block_of({0}, left, right)};
    path.steps.push_back(step);
  }
  return path;
}

TEST(RecordedPath, RangeIsThatOfItsNodes) {
  EXPECT_EQ(straight_path().lowest(), 0.0);
  EXPECT_EQ(straight_path().highest(), 2.0);
  EXPECT_EQ(straight_path().n_nodes(), 3U);
}

TEST(RecordedPath, WithoutPointsHasNoRangeAndNoPlaces) {
  const RecordedPath empty;
  EXPECT_TRUE(std::isnan(empty.lowest()));
  EXPECT_TRUE(std::isnan(empty.highest()));
  EXPECT_TRUE(empty.positions(1.0).empty());
}

TEST(RecordedPath, PassesAParameterOnceAlsoAtANode) {
  const RecordedPath path = straight_path();
  for (const double p : {0.0, 0.1, 0.5, 1.7, 2.0}) {
    const auto found = path.positions(p);
    ASSERT_EQ(found.size(), 1U) << p;
    EXPECT_NEAR(path.parameter_at(found[0]), p, rounding);
    EXPECT_LT(std::abs(path.eigenvalues_at(found[0])[0] - Complex(-0.1, 2.0 + p)), rounding) << p;
  }
  // A node belongs to the step that ends there.
  EXPECT_EQ(path.positions(0.5)[0], (PathPosition{0, 1.0}));
  EXPECT_TRUE(path.positions(-0.1).empty());
  EXPECT_TRUE(path.positions(2.1).empty());
}

TEST(RecordedPath, BehindAFoldPassesAgainInTheOrderOfTheTrace) {
  const RecordedPath path = folded_path();
  EXPECT_EQ(path.highest(), 0.84);  // of the nodes; the fold is none of them
  for (const double p : {0.76, 0.84, 0.9, 0.99}) {
    const auto found = path.positions(p);
    ASSERT_EQ(found.size(), 2U) << p;
    EXPECT_LT(found[0], found[1]);
    const double half = std::sqrt(1.0 - p);
    EXPECT_LT(std::abs(path.eigenvalues_at(found[0])[0] - Complex(0.0, 3.0 - half)), 1e-12) << p;
    EXPECT_LT(std::abs(path.eigenvalues_at(found[1])[0] - Complex(0.0, 3.0 + half)), 1e-12) << p;
  }
  EXPECT_EQ(path.positions(0.5).size(), 1U);
  EXPECT_TRUE(path.positions(1.01).empty());
}

TEST(RecordedPath, NodesAreAsTheyWereStored) {
  RecordedPath path = straight_path();
  path.eigenvalues(1, 0) = Complex(7.0, 7.0);
  EXPECT_EQ(path.eigenvalues_at({0, 1.0})[0], Complex(7.0, 7.0));
  EXPECT_EQ(path.eigenvalues_at({1, 0.0})[0], Complex(7.0, 7.0));
  EXPECT_EQ(path.parameter_at({1, 0.0}), 0.5);
}

TracePoint point_at(const PathNode& node, const std::vector<std::pair<int, Complex>>& modes,
                    const PathStep* step) {
  TracePoint point{node, {}, step};
  for (const auto& [mode, s] : modes) {
    ModeState state;
    state.mode = mode;
    state.s = s;
    point.modes.push_back(state);
  }
  return point;
}

TEST(PathRecorder, ModesThatDoNotExistAtAPointAreNoNumbers) {
  PathRecorder recorder;
  PathNode node;
  recorder.append(point_at(node, {{0, 1.0}}, nullptr));
  const PathStep step = straight(0.0, 0.5);
  node.p = 0.5;
  // A mode is born, the other one has gone.
  recorder.append(point_at(node, {{2, 3.0}}, &step));
  EXPECT_EQ(recorder.points(), 2);
  const RecordedPath path = recorder.path();
  ASSERT_EQ(path.eigenvalues.cols(), 3);
  ASSERT_EQ(path.steps.size(), 1U);
  EXPECT_EQ(path.eigenvalues(0, 0), Complex(1.0));
  EXPECT_EQ(path.eigenvalues(1, 2), Complex(3.0));
  for (const auto& [row, column] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 0), std::pair(1, 1)})
    EXPECT_TRUE(std::isnan(path.eigenvalues(row, column).real())) << row << ", " << column;
}

TEST(PathRecorder, GoesOnFromWhatWasRecorded) {
  const RecordedPath before = straight_path();
  PathRecorder recorder(before);
  EXPECT_EQ(recorder.points(), 3);
  PathNode node;
  node.p = 3.0;
  const PathStep step = straight(2.0, 3.0);
  recorder.append(point_at(node, {{0, Complex(-0.1, 5.0)}}, &step));
  const RecordedPath after = recorder.path();
  EXPECT_EQ(after.n_nodes(), 4U);
  EXPECT_EQ(after.highest(), 3.0);
  EXPECT_EQ(after.eigenvalues.topRows(3), before.eigenvalues);
  EXPECT_LT(std::abs(after.eigenvalues_at(after.positions(2.5)[0])[0] - Complex(-0.1, 4.5)), rounding);
}

/// Two modes that cross at t = 1/2 in a block, with frequencies 2 +- (t - 1/2).
PathStep step_with_block() {
  PathStep step = straight(0.0, 1.0);
  const ComplexMatrix left{{Complex(0.0, 2.0), 0.0, 0.0}, {-0.25, 1.0, -1.0}};
  const ComplexMatrix right{{Complex(0.0, 2.0), 0.0, 0.0}, {-0.25, -1.0, -1.0}};
  step.blocks = {block_of({0, 1}, left, right)};
  return step;
}

TEST(CountedEigenvalues, AreStepEigenvaluesAndTheirWorkAddsUp) {
  const PathStep step = step_with_block();
  const ComplexVector left{{Complex(0.0, 1.5), Complex(0.0, 2.5)}};
  const ComplexVector right = left.reverse();
  std::size_t work = 10;
  const ComplexVector once = step_eigenvalues(step, left, right, 0.3, &work);
  EXPECT_EQ(once, step_eigenvalues(step, left, right, 0.3));
  const std::size_t of_one = work - 10;
  EXPECT_GT(of_one, 0U);
  step_eigenvalues(step, left, right, 0.3, &work);
  EXPECT_EQ(work, 10 + 2 * of_one);
}

TEST(CountedEigenvalues, CostMoreWhereRootsComeClose) {
  const PathStep step = step_with_block();
  const ComplexVector left{{Complex(0.0, 1.5), Complex(0.0, 2.5)}};
  const ComplexVector right = left.reverse();
  std::size_t near = 0;
  std::size_t far = 0;
  step_eigenvalues(step, left, right, 0.499, &near);
  step_eigenvalues(step, left, right, 0.1, &far);
  EXPECT_GT(near, far);
}

TEST(CountedEigenvalues, OfSingleModesCostNoPolynomial) {
  std::size_t work = 0;
  step_eigenvalues(straight(0.0, 1.0), ComplexVector{{Complex(-0.1, 2.0)}},
                   ComplexVector{{Complex(-0.1, 3.0)}}, 0.3, &work);
  EXPECT_EQ(work, 0U);
}

}  // namespace
}  // namespace eigentrail::test::recorded_path_test
