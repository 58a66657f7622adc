// The scene's [events] table: what counts as the boundary of stability.
#pragma once

#include <cmath>
#include <optional>

#include "eigentrail/scene/scene.hpp"

namespace eigentrail {

struct EventOptions {
  /// A mode is stable while its damping ratio -Re s/|s| exceeds this one, -1 < . < 1. None: 0, the imaginary
  /// axis.
  std::optional<double> damping_ratio;
};

inline bool is_damping_ratio(double value) {
  return std::abs(value) < 1.0;
}

/// Defaults where the scene has no [events]. Throws InputError with the place of a fault.
EventOptions read_event_options(const Scene& scene);

}  // namespace eigentrail
