// Equilibria and their series where a parameter has a value, with or without trimmed parameters.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "eigentrail/steady/equilibrium.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test {

inline std::string trim(const std::string& unknown, const std::string& condition) {
  return "\n[[trim]]\nunknown = \"" + unknown + "\"\ncondition = \"" + condition + "\"\n";
}

struct Solved {
  Equilibrium at;
  Vector unknowns;
};

/// The equilibrium from the scene's guess.
inline Solved solve(const Setting& setting, const std::string& parameter, double value) {
  Solved result{at_rest(setting, {{parameter, value}}), {}};
  result.unknowns = result.at.lambda.tail(setting.model->n_trims());
  return result;
}

/// The error of a series of order q at distances h and h / 2 from p0 is of order q + 1, in the coordinates
/// and in the unknowns.
inline void expect_orders_of_series(const Setting& setting, const std::string& parameter, double p0, double h,
                                    double tolerance = 0.35) {
  EvaluationCounts counts = setting.model->new_counts();
  const Solved start = solve(setting, parameter, p0);
  ASSERT_EQ(start.at.status, SteadyStatus::converged) << start.at.report.message;
  Vector parameters = setting.scene.parameters.declared_values();
  parameters[setting.parameter(parameter)] = p0;
  VectorSeries direction = VectorSeries::Zero(parameters.size(), 2);
  direction.col(0) = parameters;
  direction(setting.parameter(parameter), 1) = 1.0;
  for (int order = 1; order <= 4; ++order) {
    Path path;
    ASSERT_FALSE(differentiate_equilibrium(*setting.model, start.at, direction, order, path, counts));
    const auto misses = [&](double distance) {
      const Solved there = solve(setting, parameter, p0 + distance);
      return std::pair(
          (evaluate_series(path.x, distance) - there.at.x).norm(),
          (evaluate_series(path.lambda, distance).tail(there.unknowns.size()) - there.unknowns).norm());
    };
    const auto [x, u] = misses(h);
    const auto [x_half, u_half] = misses(0.5 * h);
    EXPECT_NEAR(std::log2(x / x_half), order + 1.0, tolerance) << "order " << order;
    if (start.unknowns.size() > 0) {
      EXPECT_NEAR(std::log2(u / u_half), order + 1.0, tolerance) << "order " << order;
    }
  }
}

}  // namespace eigentrail::test
