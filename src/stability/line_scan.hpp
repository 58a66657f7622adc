// Searches one line of the window for changes of stability, and for extrema of the instability. From these a
// change of stability beside the line may be reached: an extremum is followed over the plane, to one in both
// parameters or to the boundary if it lies on the way.
//
// The instability of a mode is Re s, or Re s + ratio |s| if a damping ratio is asked for. It is zero on the
// boundary, and positive if the mode is unstable or less damped than asked.
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

/// Maximizes (start.sign = 1) or minimizes the instability of a mode over both parameters, by Newton's method
/// with second derivatives in a trust region of at most `radius` (scaled). Returns a seed if the instability
/// changes its sign on the way; empty if an extremum or the edge of the window is reached before, or the
/// mode cannot be computed.
std::optional<BoundarySeed> walk_to_boundary(const Window& window, const BoundaryOptions& options,
                                             const LineExtremum& start, double radius, RunCounts& counts);

}  // namespace eigentrail
