// Units decide nothing: the same families in other units of time, mass and length have the same points and
// the same events.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "properties/planted_family.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test {
namespace {

struct Units {
  std::string name;
  double time = 1.0, mass = 1.0;
  double length = 1.0;  ///< of every second coordinate: displacements beside angles
};

void PrintTo(const Units& units, std::ostream* out) {
  *out << units.name;
}

MatrixSeries scaled(MatrixSeries series, double factor, double length) {
  for (Matrix& A : series) {
    Vector units = Vector::Ones(A.rows());
    for (Eigen::Index i = 1; i < units.size(); i += 2) units[i] = length;
    A = (factor * units.asDiagonal() * A * units.asDiagonal()).eval();
  }
  return series;
}

/// Events by their place: the order in which those of one step are found is not that of their places.
TraceResult traced(const PlantedFamily& family, const Units& units) {
  const Family& m = family.matrices;
  const auto text = [&](const MatrixSeries& series, double power_of_time) {
    return matrices_text(scaled(series, units.mass * std::pow(units.time, power_of_time), units.length));
  };
  const std::string scene =
      family_scene(family.from, family.to,
                   "M = " + text(m.M, 0) + "\nC = " + text(m.C, 1) + "\nK = " + text(m.K, 2) + "\n");
  TraceResult result = record_trace(make_setting(scene)).result;
  std::sort(result.events.begin(), result.events.end(),
            [](const Event& a, const Event& b) { return a.p < b.p; });
  return result;
}

class InUnits : public testing::TestWithParam<Units> {};

TEST_P(InUnits, PointsAndEventsAreTheSame) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const PlantedFamily family = planted_family(seed);
    const TraceResult own = traced(family, {});
    const TraceResult other = traced(family, GetParam());
    ASSERT_EQ(other.status, own.status) << other.message;
    EXPECT_NEAR(other.nodes, own.nodes, 0.2 * own.nodes);
    ASSERT_EQ(other.events.size(), own.events.size());
    for (std::size_t i = 0; i < own.events.size(); ++i) {
      EXPECT_EQ(other.events[i].kind, own.events[i].kind);
      EXPECT_NEAR(other.events[i].p, own.events[i].p, 1e-6 * std::abs(family.to - family.from));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scaled, InUnits,
                         testing::Values(Units{"slow", 1e6}, Units{"fast", 1e-6}, Units{"heavy", 1.0, 1e6},
                                         Units{"light", 1.0, 1e-6}, Units{"long_units", 1.0, 1.0, 1e6},
                                         Units{"short_units", 1.0, 1.0, 1e-6}),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace eigentrail::test
