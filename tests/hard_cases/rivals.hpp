// The usual methods, for comparison ("rivals"): full spectra at equally spaced parameters, with labels
// carried from each to the next.
#pragma once

#include "accuracy/grid_loci.hpp"
#include "hard_cases/catalogue.hpp"

namespace eigentrail::test {

enum class Carrier {
  nearest,     ///< every track takes the eigenvalue nearest to its last one, also one that another took
  assignment,  ///< one to one with the least sum of distances
  assurance    ///< one to one with the largest sum of modal assurance criteria
};

/// From one end of a case's range to the other: the spectra of the catalogue carried by distances, or the
/// library's `qz_grid` by modal assurance. All eigenvalues are carried, both members of pairs: the number of
/// pairs changes on the way.
GridLoci loci_on_grid(const HardCase& hard_case, int n_points, Carrier carrier);

/// How many tracks are on another mode somewhere, counted once for each stretch between coincidences.
/// Compares loci with the case's analytic branches, which run through crossings, or where it has none with
/// its reference labels. Conjugates are the same mode. A label counts as wrong where another mode is at least
/// twice as close to it as its own and the two modes are apart.
int count_wrong_tracks(const HardCase& hard_case, const GridLoci& loci);

}  // namespace eigentrail::test
