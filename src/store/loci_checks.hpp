// Contradictions within a loci file that make all of it useless.
#pragma once

#include "eigentrail/store/loci_file.hpp"

namespace eigentrail {

/// Checks points and steps against each other: steps begin and end at the points and go on along the
/// parameter, and a mode that exists on both sides of a point has an eigenvalue there. Throws InputError with
/// the place.
void check_points_and_steps(const LociFile& loci);

}  // namespace eigentrail
