// The scene's [events] table: which events are searched for in addition to those of stability.
#pragma once

#include <optional>
#include <vector>

#include "eigentrail/continuation/event.hpp"
#include "eigentrail/continuation/operating_range.hpp"
#include "eigentrail/scene/scene.hpp"

namespace eigentrail {

/// An event that a scene requests: a kind whose row in event_kinds.hpp has a key, and the requested value.
struct WantedEvent {
  EventKind kind;
  double value = 0.0;
};

struct EventOptions {
  std::vector<WantedEvent> wanted = {};  ///< in the order of the kinds, without repetitions
  /// The excitation frequency in rad/s as a function of the parameters' SI values; present if a multiple of
  /// it is requested.
  std::optional<Expression> excitation = {};
  bool extrema = false;     ///< whether extrema of the damping ratio are searched for
  bool veerings = true;     ///< the same for veerings
  bool other_paths = true;  ///< the same for the paths that cross at a branch point; not an option of a scene
  OperatingRanges operating = {};  ///< from which critical speeds must stay away

  /// The values requested of one kind.
  std::vector<double> values(EventKind kind) const;
};

/// Reads the [events] table; defaults if the scene has none. The excitation frequency is the traced
/// parameter, or the speed of the shafts where that has no unit, unless the table gives another one. The
/// parameters that the table names are added to `used`. Throws InputError with the place of a fault.
EventOptions read_event_options(const Scene& scene, const std::string& traced, std::set<int>& used);

}  // namespace eigentrail
