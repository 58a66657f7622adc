#include "eigentrail/accuracy/study.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/scenes.hpp"

namespace eigentrail::test::study_test {
namespace {

constexpr int samples = 60;

ReferenceSet references(const Setting& setting, int count = samples) {
  return reference_set(setting, sample_parameters(setting.options, count));
}

class ShippedScene : public testing::TestWithParam<const char*> {};

TEST_P(ShippedScene, KeepsEveryToleranceAtEveryOrder) {
  Setting setting = scene_setting(GetParam());
  const ReferenceSet reference = references(setting);
  EXPECT_EQ(reference.unsolved, 0);
  EXPECT_LT(reference.correction, 1e-28);
  for (const int order : {1, 3, 4}) {
    for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
      if (order == 1 && tolerance < 1e-6) continue;  // thousands of points
      setting.options.order = order;
      setting.options.tolerance = tolerance;
      const MeasuredRun run = measure_trace(setting, reference, 1);
      EXPECT_TRUE(run.completed) << run.message;
      EXPECT_EQ(run.measured, samples);
      EXPECT_LE(run.error, tolerance) << "order " << order << " at " << run.worst_parameter;
      EXPECT_GT(run.factorizations, 0U);
      EXPECT_GT(run.evaluations, 0U);
      EXPECT_GT(run.bytes, 0U);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Accuracy, ShippedScene,
                         testing::Values("pendulum", "spring_pendulum", "rotating_mass", "ziegler_column"),
                         [](const auto& name) { return std::string(name.param); });

/// Observed orders of convergence from a grid and one with half the step, for linear interpolation and
/// splines.
struct Orders {
  double linear, spline;
};

Orders observed_orders(const Setting& setting, const ReferenceSet& reference, Method method, int points) {
  const GridRuns coarse = measure_grid(setting, reference, method, points, 1);
  const GridRuns fine = measure_grid(setting, reference, method, 2 * points - 1, 1);
  EXPECT_TRUE(coarse.linear.completed && fine.spline.completed)
      << coarse.linear.message << fine.spline.message;
  return {std::log2(coarse.linear.error / fine.linear.error),
          std::log2(coarse.spline.error / fine.spline.error)};
}

TEST(GridRivals, ConvergeWithTheOrderOfTheirInterpolation) {
  const Setting setting = scene_setting("pendulum");
  const ReferenceSet reference = references(setting, 400);
  for (const Method method : {Method::qz, Method::zero_order, Method::secant, Method::tangent}) {
    const Orders orders = observed_orders(setting, reference, method, 51);
    EXPECT_NEAR(orders.linear, 2.0, 0.4) << method_name(method);
    EXPECT_NEAR(orders.spline, 4.0, 0.8) << method_name(method);
  }
}

TEST(GridRivals, BetterPredictorsSaveCorrectionsNotError) {
  const Setting setting = scene_setting("rotating_mass", {{"from", "100"}, {"to", "40"}});
  const ReferenceSet reference = references(setting);
  const MeasuredRun zero = measure_grid(setting, reference, Method::zero_order, 100, 1).spline;
  const MeasuredRun tangent = measure_grid(setting, reference, Method::tangent, 100, 1).spline;
  ASSERT_TRUE(zero.completed && tangent.completed) << zero.message << tangent.message;
  EXPECT_NEAR(zero.error, tangent.error, 1e-3 * zero.error);
  EXPECT_LE(tangent.factorizations, zero.factorizations);
}

TEST(GridRivals, NeedMorePointsThanTheTrace) {
  Setting setting = scene_setting("rotating_mass");
  const ReferenceSet reference = references(setting);
  const MeasuredRun own = measure_trace(setting, reference, 1);
  const MeasuredRun rival = measure_grid(setting, reference, Method::qz, 10 * own.points, 1).spline;
  ASSERT_TRUE(rival.completed) << rival.message;
  EXPECT_GT(rival.error, own.error);
}

TEST(GridRivals, AreMeasuredOnTheModesThatATraceFollows) {
  // The lower mode is constant, exact on any grid; the upper one is not.
  const std::string scene =
      "[trace]\nparameter = \"p\"\nfrom = 0\nto = 1\n"
      "[matrix_family]\nM = [[[1, 0], [0, 1]]]\nK = [[[1, 0], [0, 4]], [[0, 0], [0, 9]]]\n";
  Setting setting = make_setting(scene);
  const ReferenceSet reference = references(setting);
  for (const Method method : {Method::qz, Method::zero_order, Method::secant, Method::tangent}) {
    setting.options.modes.count = 1;
    EXPECT_LT(measure_grid(setting, reference, method, 6, 1).linear.error, 1e-14) << method_name(method);
    setting.options.modes = {};
    EXPECT_GT(measure_grid(setting, reference, method, 6, 1).linear.error, 1e-3) << method_name(method);
  }
}

TEST(Study, SamplesFillTheRange) {
  TraceOptions options;
  options.from = 3.0;
  options.to = -1.0;
  const std::vector<double> p = sample_parameters(options, 100);
  ASSERT_EQ(p.size(), 100U);
  double gap = std::max(p.front() + 1.0, 3.0 - p.back());
  for (std::size_t i = 1; i < p.size(); ++i) gap = std::max(gap, p[i] - p[i - 1]);
  EXPECT_GT(p.front(), -1.0);
  EXPECT_LT(p.back(), 3.0);
  EXPECT_LT(gap, 3.0 * 4.0 / 100);
}

TEST(Study, MeasuresOnAPathThatTurnsBack) {
  const Setting setting = pushed_pendulum({.to = 1.2}, {{"tolerance", "1e-6"}});
  const ReferenceSet reference = references(setting);
  const MeasuredRun run = measure_trace(setting, reference, 1);
  EXPECT_GT(run.measured, samples / 2);
  EXPECT_LE(run.error, 1e-6) << run.worst_parameter;
}

Setting family(const std::string& matrices) {
  return make_setting(
      "[trace]\nparameter = \"p\"\nfrom = -0.5\nto = 1.5\ntolerance = 1e-9\n[matrix_family]\n" + matrices);
}

struct Meeting {
  const char* name;
  const char* matrices;
};

/// Eigenvalues that meet, and a pair that becomes two real modes. Errors are those of the functions of the
/// blocks.
class MeetingModes : public testing::TestWithParam<Meeting> {};

TEST_P(MeetingModes, AreMeasuredToTheirTolerance) {
  const Setting setting = family(GetParam().matrices);
  const ReferenceSet reference = references(setting);
  EXPECT_EQ(reference.unsolved, 0);
  const MeasuredRun run = measure_trace(setting, reference, 1);
  EXPECT_TRUE(run.completed) << run.message;
  EXPECT_EQ(run.measured, samples);
  EXPECT_LE(run.error, 1e-9) << run.worst_parameter;
}

INSTANTIATE_TEST_SUITE_P(
    Accuracy, MeetingModes,
    testing::Values(
        Meeting{"crossing", "M = [[[1, 0], [0, 1]]]\nK = [[[2, 0], [0, 3]], [[1, 0], [0, -1]]]\n"},
        Meeting{"exceptional_point", "M = [[[1, 0], [0, 1]]]\nK = [[[2, 1], [0, 2]], [[0, 0], [1, 0]]]\n"},
        Meeting{"birth_of_real_modes", "M = [[[1]]]\nC = [[[0.1]]]\nK = [[[1]], [[-1]]]\n"}),
    [](const auto& name) { return std::string(name.param.name); });

TEST(Study, ToleranceHoldsBesideAnInfiniteEigenvalue) {
  // A mass passes through zero and so s through infinity. The error of 1/s relative to the least |1/s| on a
  // step is tens of times larger than relative to |1/s| at its ends and in the middle.
  Setting setting = family(
      "M = [[[0, 0], [0, 1]], [[1, 0], [0, 0]]]\nC = [[[1, 0], [0, 0.1]]]\nK = [[[1, 0.1], [0.1, 4]]]\n");
  const ReferenceSet reference = references(setting);
  EXPECT_EQ(reference.unsolved, 0);
  for (int order = 2; order <= 4; ++order) {
    setting.options.order = order;
    const MeasuredRun run = measure_trace(setting, reference, 1);
    EXPECT_EQ(run.measured, samples);
    EXPECT_LE(run.error, setting.options.tolerance) << "order " << order << " at " << run.worst_parameter;
  }
}

TEST(Study, HasARunForEverySetting) {
  Setting setting = scene_setting("pendulum");
  const StudyOptions options{
      .tolerances = {1e-4, 1e-6}, .orders = {2, 3}, .grids = {10}, .samples = 5, .repeat = 1};
  int last = 0;
  Threads one(1);
  const Study study = accuracy_study(setting, options, one, [&](int done, int all) {
    EXPECT_EQ(done, ++last);
    EXPECT_EQ(all, 14);
  });
  EXPECT_EQ(study.runs.size(), 14U);
  EXPECT_EQ(setting.options.tolerance, 1e-8);  // as the scene says, again
  EXPECT_TRUE(setting.options.certify);
}

TEST(StudyOptions, EveryFaultIsTold) {
  EXPECT_TRUE(find_faults(StudyOptions{}).empty());
  const StudyOptions wrong{.tolerances = {}, .orders = {5}, .grids = {4}, .samples = 0, .repeat = 0};
  EXPECT_EQ(find_faults(wrong).size(), 5U);
}

}  // namespace
}  // namespace eigentrail::test::study_test
