// Events: the special points of a trace.
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
  crossing,       ///< eigenvalues coincide, their eigenvectors stay different
  veering,        ///< exceptional point beside the real parameter axis: eigenvalues approach and separate
  fold,           ///< the equilibrium path turns back
  branch_point,   ///< another equilibrium path crosses
  damping_ratio,  ///< the damping ratio of a complex pair has a requested value
  resonance,      ///< Im s of a complex pair is a requested multiple of the excitation frequency
  extremum,       ///< the damping ratio of a complex pair has a local minimum or maximum
  log_decrement,  ///< the logarithmic decrement of a complex pair has a requested value
  band_edge,      ///< Im s of a complex pair passes an end of the band of frequencies that is followed
  cusp,           ///< two folds in one: the equilibrium path is vertical there and does not turn back
};

/// What differs between an event of a mode and the same event of the equal mode of a copy of its part.
struct EventOfCopy {
  ComplexVector shape, sensitivity;
  Vector shift;
};

struct Event {
  EventKind kind = EventKind::flutter;
  double p = 0.0;               ///< value of the traced parameter, in its unit
  Complex s = {};               ///< the eigenvalue there, 1/s; the mean of all that coincide
  std::vector<int> modes = {};  ///< numbers of the modes, from 0, ascending
  double half_width = 0.0;      ///< veering: distance of the exceptional point from the real parameter axis
  /// Collision of m eigenvalues: s = s* + puiseux (p - p*)^(1/m) + ..., with all m branches of the root; zero
  /// if not known.
  Complex puiseux = {};
  /// Flutter, divergence, damping_ratio, log_decrement, and a collision on the imaginary axis: 1 if the mode
  /// becomes less stable there with growing p, -1 if more stable. Resonance: 1 if Im s grows faster with p
  /// than the multiple of the excitation frequency; band_edge: if it grows with p. Extremum: 1 at a minimum
  /// of the damping ratio, -1 at a maximum. 0: the function touches zero without a change of sign, or the
  /// kind has no direction.
  int direction = 0;
  /// damping_ratio, extremum: the damping ratio -Re s/|s|; log_decrement: the decrement; resonance: the
  /// multiple of the excitation frequency; band_edge: the end of the band, rad/s.
  double value = NAN;
  ComplexVector shape = {};  ///< eigenvector of the first of `modes`, physical coordinates, unit M-norm
  /// ds/dq for every parameter q, the others constant; s is the mean of all that coincide. NaN where it is
  /// not defined, and for parameters that are defined by others.
  ComplexVector sensitivity = {};
  Vector shift = {};    ///< dp*/dq: how the place of the event moves with every parameter; NaN likewise
  int retrackings = 0;  ///< points computed to locate it
  int node = 0;         ///< number of the first path point at or after it
  /// While a trace runs: the same for every copy of the part that the modes belong to. Empty in its result,
  /// where they are events of their own.
  std::vector<EventOfCopy> copies = {};
};

/// The name of a kind in files.
std::string event_name(EventKind kind);

/// A line "kind,p,Re s,Im s,modes", modes separated by ';' and counted from 1.
std::string event_line(const Event& event);

}  // namespace eigentrail
