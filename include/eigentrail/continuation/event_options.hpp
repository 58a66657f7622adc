// The scene's [events] table: what counts as an event beyond stability itself.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "eigentrail/scene/scene.hpp"

namespace eigentrail {

struct EventOptions {
  /// Where the damping ratio -Re s/|s| of a pair is one of these, -1 < . < 1, not 0.
  std::vector<double> damping_ratios = {};
  /// Where Im s of a pair is one of these multiples (> 0) of the excitation frequency.
  std::vector<double> harmonics = {};
  /// The excitation frequency in rad/s, from the parameters' SI values; there when harmonics are.
  std::optional<Expression> excitation = {};
  bool extrema = true;  ///< extrema of the damping ratio
};

inline bool is_damping_ratio(double value) {
  return std::abs(value) < 1.0;
}

/// Defaults where the scene has no [events]; the excitation frequency is the traced parameter unless the
/// scene says another. `used` collects the parameters that it names. Throws InputError with the place of a
/// fault.
EventOptions read_event_options(const Scene& scene, const std::string& traced, std::set<int>& used);

}  // namespace eigentrail
