// Whether all modes are there, and each once.
#pragma once

#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/modes/spectrum.hpp"

namespace eigentrail {

/// Checksum for a trace that follows every mode: sum s = -tr(M^-1 C) and sum s^2 = tr((M^-1 C)^2) - 2 tr(M^-1
/// K), and the same with M and K exchanged for the sums of 1/s. The first pair sees the high modes, the
/// second the low ones; a matrix that is singular or nearly so leaves its pair out. Sees lost and doubled
/// modes, not exchanged ones. Cost O(n^3), real.
bool checksum_holds(const PathNode& node, const PathProblem& problem);

/// What a full spectrum has that the tracks lack: modes to be added. `doubled` receives whether two tracks
/// share one eigenvalue.
std::vector<StartingMode> missing_modes(const PathNode& node, const Spectrum& spectrum, double s_ref,
                                        bool& doubled);

}  // namespace eigentrail
