// The scene's [events] table: what counts as an event beyond stability itself.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "eigentrail/continuation/event.hpp"
#include "eigentrail/scene/scene.hpp"

namespace eigentrail {

/// An event that a scene asks for: a kind whose row in event_kinds.hpp has a key, and its number.
struct WantedEvent {
  EventKind kind;
  double value = 0.0;
};

struct EventOptions {
  std::vector<WantedEvent> wanted = {};  ///< in the order of the kinds; each once
  /// The excitation frequency in rad/s, from the parameters' SI values; there when a multiple of it is
  /// wanted.
  std::optional<Expression> excitation = {};
  bool extrema = true;  ///< extrema of the damping ratio

  /// The numbers wanted of one kind.
  std::vector<double> values(EventKind kind) const;
};

/// Defaults where the scene has no [events]; the excitation frequency is the traced parameter unless the
/// scene says another. `used` collects the parameters that it names. Throws InputError with the place of a
/// fault.
EventOptions read_event_options(const Scene& scene, const std::string& traced, std::set<int>& used);

}  // namespace eigentrail
