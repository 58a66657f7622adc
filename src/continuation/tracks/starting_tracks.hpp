// From a spectrum to what is followed: single modes, and blocks where eigenvalues nearly coincide.
#pragma once

#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/modes/spectrum.hpp"

namespace eigentrail {

/// Which modes of a spectrum are followed together, with their numbers.
struct StartingGroup {
  InvariantPair pair;      ///< not yet corrected
  ComplexVector roots;     ///< as the spectrum has them
  std::vector<int> modes;  ///< mode number of every root, or Track::no_mode, Track::guest
};

/// `least_scale`: magnitude of eigenvalues beside the point, where those of the pencil vanish with its
/// stiffness. Groups of the first `n_modes` modes of the spectrum; later ones join as guests where they are
/// too close.
std::vector<StartingGroup> starting_groups(const ReducedPencil& pencil,
                                           const std::vector<StartingMode>& modes, int n_modes, double s_ref,
                                           double least_scale = 0.0);

}  // namespace eigentrail
