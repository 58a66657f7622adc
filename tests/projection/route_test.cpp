// Which models are projected: the choice by counted work, and that it changes only the time.
#include "eigentrail/projection/route.hpp"

#include <gtest/gtest.h>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/projection/project.hpp"
#include "support/large_families.hpp"
#include "support/large_scenes.hpp"

namespace eigentrail::test::route_test {
namespace {

TraceSetup plate(int cells, int modes) {
  return large_setup(rotating_plate({cells}), 0.0, 1.0, modes, 1e-6);
}

Route route_of_plate(int cells, int modes) {
  const TraceSetup setup = plate(cells, modes);
  return route_of(*setup.model, setup.options);
}

Route route_of_ladder(int bays, const OptionTexts& options) {
  const Setting setting = make_setting(ladder(bays), options);
  return route_of(*setting.model, setting.options);
}

TEST(Routes, FamiliesAreProjectedWhereThatDoesLess) {
  EXPECT_FALSE(route_of_plate(6, 4).is_projected);  // 72 freedoms
  EXPECT_TRUE(route_of_plate(10, 4).is_projected);  // 200
  EXPECT_TRUE(route_of_plate(10, 12).is_projected);
  // The space of 80 modes is not smaller than the model.
  EXPECT_FALSE(route_of_plate(10, 80).is_projected);
}

/// The choice follows from the two numbers, and they are of the same size where both take as long.
TEST(Routes, TheChoiceIsThatOfTheCountedWork) {
  for (const int modes : {2, 8, 30}) {
    double last = 0.0;
    for (int cells = 5; cells <= 14; ++cells) {
      const Route route = route_of_plate(cells, modes);
      ASSERT_TRUE(route.work.has_value());
      const double ratio = route.work->dense / route.work->projected;
      EXPECT_EQ(route.is_projected, ratio > worth_projecting) << cells << " cells, " << modes << " modes";
      EXPECT_GE(ratio, 0.99 * last) << "a larger model is projected if a smaller one is";
      last = ratio;
    }
    EXPECT_GT(last, worth_projecting);
  }
}

/// Filled factors make a projection dear: there are several, of complex numbers.
TEST(Routes, FactorizationsCount) {
  const TraceSetup setup = plate(12, 4);
  ProjectionEstimate estimate = estimate_projection(*setup.model, setup.options);
  const TraceWork thin = trace_work(estimate, setup.options);
  const auto n = static_cast<double>(estimate.freedoms);
  estimate.factor_operations = n * n * n / 3.0;
  estimate.factor_bytes = 0.5 * n * n * sizeof(double);
  const TraceWork full = trace_work(estimate, setup.options);
  EXPECT_EQ(full.dense, thin.dense);
  EXPECT_GT(full.projected, thin.projected + 4.0 * estimate.factor_operations);
}

TEST(Routes, ScenesOfBeamsAreProjectedWhereThatDoesLess) {
  EXPECT_FALSE(route_of_ladder(2, {{"modes", "4"}}).is_projected);  // 132 freedoms
  EXPECT_TRUE(route_of_ladder(7, {{"modes", "4"}}).is_projected);   // 462
  EXPECT_FALSE(route_of_ladder(7, {}).is_projected);                // all modes: with all freedoms
  EXPECT_THROW(route_of_ladder(26, {}), InputError);
}

TEST(Routes, SmallScenesHaveNoChoice) {
  const Setting setting = scene_setting("hinged_blade", {{"modes", "2"}});
  EXPECT_FALSE(route_of(*setting.model, setting.options).work.has_value());
}

TEST(Routes, DenseModelsAreLeftAsTheyAre) {
  TraceSetup setup = plate(6, 4);
  const Model* before = setup.model.get();
  project_if_large(setup.model, setup.options);
  EXPECT_EQ(setup.model.get(), before);
}

/// Near the threshold both ways lead to the same eigenvalues.
TEST(Routes, TheChoiceDoesNotChangeEigenvalues) {
  const TraceSetup setup = plate(7, 4);
  Setting dense, projected;
  dense.options = projected.options = setup.options;
  projected.model = projected_family(setup, setup.options);
  dense.model = plate(7, 4).model;
  const RecordedTrace one = record_trace(dense), other = record_trace(projected);
  for (const double p : {0.0, 0.37, 0.71, 1.0}) {
    const ComplexVector s = one.eigenvalues_at(p), t = other.eigenvalues_at(p);
    for (Eigen::Index i = 0; i < 4; ++i)
      EXPECT_LT((t.array() - s[i]).abs().minCoeff(), 2e-6 * std::abs(s[i])) << p;
  }
}

}  // namespace
}  // namespace eigentrail::test::route_test
