// Points of a trace that are worth a line of their own.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

enum class EventKind {
  flutter,        ///< a complex pair crosses the imaginary axis
  divergence,     ///< a real eigenvalue crosses zero
  collision,      ///< exceptional point: a pair meets or leaves the real axis, or two modes coalesce
  crossing,       ///< modes coincide and keep their own vectors
  veering,        ///< exceptional point beside the real parameter axis: modes come close and part again
  fold,           ///< the equilibrium path turns back
  branch_point,   ///< another equilibrium path crosses
  damping_ratio,  ///< the damping ratio of a pair has a value that was asked for
  resonance,      ///< Im s of a pair is a multiple of the excitation frequency
  extremum,       ///< the damping ratio of a pair is least or largest
  log_decrement,  ///< the logarithmic decrement of a pair has a value that was asked for
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
  /// Flutter, divergence, damping_ratio: 1 when the mode gets less stable there with growing p, -1 when more.
  /// Resonance: 1 when the frequency outgrows the excitation. Extremum: 1 where the damping ratio is least,
  /// -1 where it is largest. 0: it touches only, or the kind has no direction.
  int direction = 0;
  double value = NAN;  ///< damping_ratio, extremum: the damping ratio -Re s/|s|; resonance: the harmonic
  ComplexVector shape = {};  ///< of the first of `modes`, physical coordinates, unit M-norm
  /// ds/dq for every parameter q, all others held; of the mean of those that meet. NaN where it is not
  /// defined, or not for a parameter that others define.
  ComplexVector sensitivity = {};
  Vector shift = {};    ///< dp*/dq: how the event moves with every parameter; NaN likewise
  int retrackings = 0;  ///< points computed to locate it
  int node = 0;         ///< the first path point at or behind it
};

std::string event_name(EventKind kind);

/// "kind,parameter,real,imag,modes", modes separated by ';' and counted from 1.
std::string event_line(const Event& event);

}  // namespace eigentrail
