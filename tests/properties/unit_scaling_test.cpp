// Units decide nothing: the same families in other units of time, mass and length have the same points and
// the same events.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "hard_cases/catalogue.hpp"
#include "properties/planted_family.hpp"
#include "properties/scaled_model.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::unit_scaling_test {
namespace {

const OptionTexts options{{"max_nodes", "2000"}};

/// Events by their place: the order in which those of one step are found is not that of their places.
TraceResult traced(Setting setting, const Units& units) {
  const std::unique_ptr<Model> own = std::move(setting.model);
  setting.model = std::make_unique<ScaledModel>(*own, units);
  TraceResult result = record_trace(setting).result;
  std::sort(result.events.begin(), result.events.end(),
            [](const Event& a, const Event& b) { return a.p < b.p; });
  return result;
}

/// The same in its own units, traced once.
const TraceResult& traced(const std::string& scene) {
  static std::map<std::string, TraceResult> known;
  const auto at = known.find(scene);
  return at != known.end() ? at->second : known[scene] = traced(make_setting(scene, options), {});
}

/// A fifth of the points, and two: one step that rounding has taken again.
double allowed(int nodes) {
  return std::max(0.2 * nodes, 2.0);
}

class InUnits : public testing::TestWithParam<Units> {};

TEST_P(InUnits, PointsAndEventsAreTheSame) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const PlantedFamily family = planted_family(seed);
    const std::string scene = family.as_case().scene;
    const TraceResult& own = traced(scene);
    const TraceResult other = traced(make_setting(scene, options), GetParam());
    ASSERT_EQ(other.status, own.status) << other.message;
    EXPECT_NEAR(other.nodes, own.nodes, allowed(own.nodes));
    ASSERT_EQ(other.events.size(), own.events.size());
    for (std::size_t i = 0; i < own.events.size(); ++i) {
      EXPECT_EQ(other.events[i].kind, own.events[i].kind);
      EXPECT_NEAR(other.events[i].p, own.events[i].p, 1e-6 * std::abs(family.to - family.from));
    }
  }
}

/// Scenes with constraints have coordinates of one unit. Blocks that pass through zero, and one that runs
/// through infinity beside a finite mode, take as many factorizations.
TEST_P(InUnits, HardCasesTakeAsManyPointsAndHaveTheSameEvents) {
  for (const HardCase& hard_case : hard_cases()) {
    SCOPED_TRACE(hard_case.name);
    Setting setting = make_setting(hard_case.scene, options);
    if (GetParam().beside_angles && setting.model->n_constraints() > 0) continue;
    const TraceResult& own = traced(hard_case.scene);
    const TraceResult other = traced(std::move(setting), GetParam());
    EXPECT_EQ(other.status, own.status) << other.message;
    EXPECT_NEAR(other.nodes, own.nodes, allowed(own.nodes));
    EXPECT_EQ(other.events.size(), own.events.size());
    const std::string& name = hard_case.name;
    if (name != "whirl_through_zero" && name != "whirl_damped" && name != "mass_through_zero") continue;
    const double count = factorizations(own.counts);
    EXPECT_NEAR(factorizations(other.counts), count, 0.2 * count);
  }
}

INSTANTIATE_TEST_SUITE_P(Scaled, InUnits, testing::ValuesIn(other_units()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace eigentrail::test::unit_scaling_test
