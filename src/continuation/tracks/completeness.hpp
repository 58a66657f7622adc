// Whether all modes are there, and each once.
#pragma once

#include "continuation/tracks/mode_order.hpp"
#include "eigentrail/modes/spectrum.hpp"

namespace eigentrail {

/// Checksum for a trace that follows every mode: sum s = -tr(M^-1 C) and sum s^2 = tr((M^-1 C)^2) - 2 tr(M^-1
/// K), and the same with M and K exchanged for the sums of 1/s. The first pair sees the high modes, the
/// second the low ones; a matrix that is singular or nearly so leaves its pair out. Sees lost and doubled
/// modes, not exchanged ones. Cost O(n^3), real.
bool checksum_holds(const PathNode& node, const PathProblem& problem);

/// What a full spectrum has that the tracks lack: modes to be added.
std::vector<StartingMode> missing_modes(const PathNode& node, const Spectrum& spectrum, double s_ref);

/// Whether a track has left the spectrum, by its backward error, or two have the same eigenpair: eigenvalues
/// within 1e-8, and a vector of one in the space of the other. Cost O(n) for every two tracks with such
/// eigenvalues.
bool has_doubtful_track(const PathNode& node, const PathProblem& problem);

/// What was found at a point.
struct Completion {
  bool doubtful = false;  ///< as has_doubtful_track
  int added = 0;          ///< modes that were missing
};

/// Checks that no mode is lost or followed twice at a point. Where all modes are followed (`follows_all`) and
/// the checksum does not hold, a full spectrum tells which are missing; they are added to the node with new
/// numbers. At a meeting, where eigenvalues are known to half their digits, nothing is checked. Cost: the
/// checksum; O(n^3) for the spectrum.
Completion complete(const PathProblem& problem, bool follows_all, PathNode& node, ModeNumbers& numbers,
                    RunCounts& counts);

}  // namespace eigentrail
