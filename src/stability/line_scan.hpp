// What the modes do along one line of the window: changes of stability, and extrema that nearly reach one.
#pragma once

#include <string>
#include <vector>

#include "stability/boundary_mode.hpp"

namespace eigentrail {

/// A line of the window, P or Q constant.
struct ScanLine {
  int along = 0;      ///< the coordinate that changes: 0 for P, 1 for Q
  double held = 0.0;  ///< the other one, scaled
  Place at(double u) const { return along == 0 ? Place(u, held) : Place(held, u); }
};

/// A place where stability changes, to the accuracy of a trace.
struct BoundarySeed {
  Place place;
  Place direction;  ///< in which the boundary is crossed; zero: along the gradient
  BoundaryKind kind = BoundaryKind::flutter;
  Complex s;
  EquilibriumGuess equilibrium;
  bool walked = false;  ///< found beside the lines
};

/// An extremum along a line, on the stable side of zero where it is a maximum.
struct LineExtremum {
  Place place;
  Complex s;
  EquilibriumGuess equilibrium;
  double sign = 1.0;  ///< 1: a maximum below zero, to be climbed from; -1: a minimum above
};

/// What else there is to say, and where it holds.
struct Finding {
  std::string what, where;
};

struct LineScan {
  bool started = false;
  std::vector<BoundarySeed> seeds;
  std::vector<LineExtremum> extrema;
  std::vector<Finding> findings;
  double s_ref = 0.0;
  RunCounts counts;
};

/// Traces a line and samples its dense output.
LineScan scan_line(const Window& window, const BoundaryOptions& options, const ScanLine& line);

/// How far a mode is from the boundary, zero on it; positive where it is unstable, or less damped than asked.
double instability(const BoundaryOptions& options, Complex s);

/// Whether a mode whose instability changes sign here does so by passing zero, and not by a jump: through
/// infinity, or from one mode to another.
bool passes_zero(const BoundaryOptions& options, Complex s, double s_ref);

}  // namespace eigentrail
