// Modes whose eigenvalue does not move with the parameter: zeros, such as rigid-body motions, integrators and
// placeholder states, and others that are constant.
#pragma once

#include <vector>

#include "eigentrail/stability/axis_stretches.hpp"

namespace eigentrail {

enum class Permanence {
  none,      ///< the eigenvalue moves
  constant,  ///< it stays within the tolerance of a value
  zero       ///< it is zero within rounding, at every point
};

/// The permanence of every mode of the path. A mode that has fewer than three points counts as one that
/// moves.
std::vector<Permanence> permanence_of_modes(const RecordedPath& path, const EigenvalueAccuracy& accuracy);

}  // namespace eigentrail
