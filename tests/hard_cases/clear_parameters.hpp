// Parameters of a hard case at which its spectra are compared.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "hard_cases/catalogue.hpp"

namespace eigentrail::test {

inline double parameter_at(const HardCase& hard_case, double part) {
  return hard_case.from + part * (hard_case.to - hard_case.from);
}

/// Whether p keeps a thousandth of the range from all special points.
inline bool is_clear(const HardCase& hard_case, double p) {
  const double clearance = 1e-3 * std::abs(hard_case.to - hard_case.from);
  return std::none_of(hard_case.special.begin(), hard_case.special.end(),
                      [&](const SpecialPoint& point) { return std::abs(point.parameter - p) < clearance; });
}

/// Eight clear parameters, always the same, in the direction of the trace.
inline std::vector<double> clear_parameters(const HardCase& hard_case) {
  constexpr std::size_t n = 8;
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> along(0.0, 1.0);
  std::vector<double> parts;
  while (parts.size() < n) {
    const double part = along(engine);
    if (is_clear(hard_case, parameter_at(hard_case, part))) parts.push_back(part);
  }
  std::sort(parts.begin(), parts.end());
  for (double& part : parts) part = parameter_at(hard_case, part);
  return parts;
}

}  // namespace eigentrail::test
