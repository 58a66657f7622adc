// Whether a mode whirls with the rotor or against it.
#pragma once

#include <string>

#include "eigentrail/continuation/event.hpp"
#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail::app {

/// "forward" if the bodies that carry the spinning discs of a scene move round the axis of spin in its sense,
/// "backward" if against it, "mixed" if their centres go one way and their axes the other; empty if they move
/// in a plane, if the scene has no disc on an axis of a body ("disc.z"), or if the discs stand still.
///
/// A point with the displacement Re(a e^(i w t)) moves on an ellipse in the sense of -(Re a x Im a) . e about
/// the axis e. The axis is that of the starting guess.
std::string whirl_direction(const TraceSetup& setup, const Event& event);

}  // namespace eigentrail::app
