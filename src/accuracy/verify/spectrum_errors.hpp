// Distances of the eigenvalues of a loci file from a spectrum.
#pragma once

#include <vector>

#include "eigentrail/stability/axis_stretches.hpp"

namespace eigentrail {

/// Distances of the dense output from the exact eigenvalues, |s_dense - s| / max(|s|, reference), in units of
/// what their error may be: beside an exceptional point eigenvalues move by the root of the tolerance,
/// rounding may leave less, and a distance of that size counts as the tolerance.
Vector discrepancies(const RecordedPath& path, const PathPosition& position, const ComplexVector& s,
                     const std::vector<Complex>& exact, const EigenvalueAccuracy& accuracy);

/// Errors of the eigenvalues at a place, 1/s: `level` times max(|s|, reference), at least what rounding
/// leaves at the ends of the step, and of the members of a block also what its functions leave open; at a
/// stored point, that is rounding.
Vector eigenvalue_errors(const RecordedPath& path, const PathPosition& position, const ComplexVector& s,
                         double level, const EigenvalueAccuracy& accuracy);

}  // namespace eigentrail
