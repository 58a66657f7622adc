// Boundaries of scenes that are given as texts, and the deviation of their dense output from closed forms.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "eigentrail/core/text.hpp"
#include "eigentrail/stability/boundary.hpp"

namespace eigentrail::test {

/// The window [0, 1] x [0, 1] unless `request` says otherwise.
inline BoundaryResult boundaries_of(const std::string& scene, BoundaryRequest request) {
  const BoundarySetup setup = prepare_boundary(parse_scene(scene, "test.toml"), request);
  return find_boundaries(*setup.model, setup.options);
}

/// A family of matrices in P and Q with the given lines of [matrix_family].
inline std::string plane_scene(double from, double to, const std::string& matrices,
                               const std::string& parameters = "P = 0.0\nQ = 0.0\n") {
  return "[parameters]\n" + parameters + "[trace]\nparameter = \"P\"\nfrom = " + std::to_string(from) +
         "\nto = " + std::to_string(to) + "\n[matrix_family]\n" + matrices;
}

/// A system of independent freedoms s^2 + c s + k with these expressions.
inline std::string freedoms(const std::vector<std::pair<std::string, std::string>>& c_and_k,
                            double from = -1.0, double to = 1.0) {
  const auto diagonal = [&](auto&& entry) {
    std::string matrix = "[[";
    for (std::size_t i = 0; i < c_and_k.size(); ++i) {
      matrix += i == 0 ? "[" : ", [";
      for (std::size_t j = 0; j < c_and_k.size(); ++j)
        matrix += (j == 0 ? "" : ", ") + (i == j ? "\"" + entry(c_and_k[i]) + "\"" : std::string("0"));
      matrix += "]";
    }
    return matrix + "]]";
  };
  return plane_scene(from, to,
                     "M = " + diagonal([](const auto&) { return std::string("1"); }) +
                         "\nC = " + diagonal([](const auto& entry) { return entry.first; }) +
                         "\nK = " + diagonal([](const auto& entry) { return entry.second; }) + "\n");
}

/// The second parameter Q over [-1, 1].
inline BoundaryRequest square_window(double tolerance = 1e-9) {
  BoundaryRequest request;
  request.second = "Q";
  request.from = -1.0;
  request.to = 1.0;
  request.overrides = {{"tolerance", exact_text(tolerance)}};
  return request;
}

/// Ziegler's column (data/scenes/ziegler_column.toml): P is the load from 0 to 3, Q the damping.
inline BoundaryResult ziegler_boundaries(double from, double to, double tolerance) {
  BoundaryRequest request;
  request.second = "Q";
  request.from = from;
  request.to = to;
  request.overrides = {{"tolerance", exact_text(tolerance)}};
  return boundaries_of(plane_scene(0.0, 3.0,
                                   "M = [[[3, 1], [1, 1]]]\nC = [[[\"2 * Q\", \"-Q\"], [\"-Q\", \"Q\"]]]\n"
                                   "K = [[[\"2 - P\", \"P - 1\"], [-1, 1]]]\n"),
                       request);
}

/// The largest |miss(P, Q, tau, delta)| of the dense output at about `count` places of a curve.
inline double largest_miss(const BoundaryCurve& curve, int count,
                           const std::function<double(const Eigen::Vector4d&)>& miss) {
  const int per_step = count / static_cast<int>(curve.steps.size()) + 1;
  double worst = 0.0;
  for (const BoundaryStep& step : curve.steps) {
    for (int i = 0; i <= per_step; ++i)
      worst = std::max(worst, std::abs(miss(evaluate_step(step, static_cast<double>(i) / per_step))));
  }
  return worst;
}

inline std::vector<BoundaryCurve> curves_of_kind(const BoundaryResult& result, BoundaryKind kind) {
  std::vector<BoundaryCurve> found;
  for (const BoundaryCurve& curve : result.curves) {
    if (curve.kind == kind) found.push_back(curve);
  }
  return found;
}

}  // namespace eigentrail::test
