// Searches one line of the window for changes of stability, and for extrema of the instability from which a
// change of stability beside the line may be reached.
#pragma once

#include <string>
#include <vector>

#include "stability/boundary_mode.hpp"

namespace eigentrail {

/// A line of the window, on which P or Q is constant.
struct ScanLine {
  int along = 0;      ///< the coordinate that varies: 0 for P, 1 for Q
  double held = 0.0;  ///< scaled value of the other coordinate
  Place at(double u) const { return along == 0 ? Place(u, held) : Place(held, u); }
};

/// A starting point for a boundary curve: a place where stability changes, to the accuracy of a trace.
struct BoundarySeed {
  Place place;
  Place direction;  ///< direction in which Newton's method is to correct the place; zero: along grad g
  BoundaryKind kind = BoundaryKind::flutter;
  Complex s;
  EquilibriumGuess equilibrium;
  bool walked = false;  ///< found by walk_to_boundary, not on a line
};

/// A local extremum of the instability of a mode along a line: a maximum below zero or a minimum above.
struct LineExtremum {
  Place place;
  Complex s;
  EquilibriumGuess equilibrium;
  double sign = 1.0;  ///< 1: maximum below zero; -1: minimum above zero
};

/// An observation for the notes of the result, and the place where it was made.
struct Finding {
  std::string what, where;
};

struct LineScan {
  bool started = false;  ///< whether a trace of the line could be started, from either end
  std::vector<BoundarySeed> seeds;
  std::vector<LineExtremum> extrema;
  std::vector<Finding> findings;
  double s_ref = 0.0;
  RunCounts counts;
};

/// Traces a line and samples its dense output. If the trace ends early, the line is traced from the other end
/// as well.
LineScan scan_line(const Window& window, const BoundaryOptions& options, const ScanLine& line);

/// The kind of a boundary on which a mode has the eigenvalue s.
BoundaryKind kind_of(const BoundaryOptions& options, Complex s);

/// Instability of a mode: Re s, or Re s + ratio |s| if a damping ratio is asked for. Zero on the boundary,
/// positive if the mode is unstable or less damped than asked.
double instability(const BoundaryOptions& options, Complex s);

/// Whether the instability of a mode that changes its sign here passes through zero. If not, it jumps: the
/// eigenvalue passes through infinity, or another mode has been taken for this one.
bool passes_zero(const BoundaryOptions& options, Complex s, double s_ref);

}  // namespace eigentrail
