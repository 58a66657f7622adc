// Points of a trace that are worth a line of their own.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

enum class EventKind {
  flutter,     ///< a complex pair crosses the imaginary axis
  divergence,  ///< a real eigenvalue crosses zero
  collision,   ///< exceptional point: a pair meets or leaves the real axis, or two modes coalesce
  crossing,    ///< modes coincide and keep their own vectors
  veering,     ///< exceptional point beside the real parameter axis: modes come close and part again
  fold,        ///< the equilibrium path turns back
  pitchfork,   ///< another equilibrium path crosses
};

struct Event {
  EventKind kind = EventKind::flutter;
  double p = 0.0;           ///< traced parameter
  Complex s;                ///< the eigenvalue there, the mean of those that meet
  std::vector<int> modes;   ///< from 0, ascending
  double half_width = 0.0;  ///< veering: distance of the exceptional point from the real parameter axis
  /// Collision of m eigenvalues: s = s* + puiseux (p - p*)^(1/m) + ..., with all m-th roots; zero when not
  /// known.
  Complex puiseux = {};
  int retrackings = 0;  ///< points computed to locate it
  int node = 0;         ///< the first path point at or behind it
};

std::string event_name(EventKind kind);

/// "kind,parameter,real,imag,modes", modes separated by ';' and counted from 1.
std::string event_line(const Event& event);

}  // namespace eigentrail
