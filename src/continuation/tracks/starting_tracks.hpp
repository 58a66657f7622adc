// Initial tracks from a spectrum: single modes, and blocks of eigenvalues that nearly coincide.
#pragma once

#include <optional>

#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/modes/spectrum.hpp"

namespace eigentrail {

/// A single mode or a block of a spectrum, or of other tracks, with mode numbers.
struct StartingGroup {
  InvariantPair pair;      ///< not yet corrected
  ComplexVector roots;     ///< eigenvalues as far as they are known
  std::vector<int> modes;  ///< mode number of every root, or Track::no_mode, Track::guard
};

/// Groups that contain the first `n_modes` modes of the spectrum. Later modes are in these groups, as guard
/// modes, where they are too close. Modes of copies of a part are left out. `s_ref`: magnitude below which an
/// eigenvalue counts as zero, 1/s. `least_scale`: lower bound of s_ref, the magnitude of eigenvalues near the
/// point; needed on a branch point, where the pencil may have no other eigenvalues than zero. `close`:
/// relative distance up to which eigenvalues start as a block; QZ gives a double one to 1e-8 at best, a
/// triple one to 1e-5.
std::vector<StartingGroup> starting_groups(const ReducedPencil& pencil,
                                           const std::vector<StartingMode>& modes, int n_modes, double s_ref,
                                           double least_scale = 0.0, double close = 1e-4);

/// The track of a group at a point: corrected and differentiated, with its roots in the order of those of the
/// group and its mode numbers. Empty if that fails.
std::optional<Track> track_of(const PathProblem& problem, const PathNode& node, const StartingGroup& group,
                              RunCounts& counts);

}  // namespace eigentrail
