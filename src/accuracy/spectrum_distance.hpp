// Distances of eigenvalues from those of a spectrum, in the measure to which the tolerance of a trace refers.
#pragma once

#include <vector>

#include "eigentrail/stability/axis_stretches.hpp"

namespace eigentrail {

/// The spectrum with both members of complex pairs, from one with one member of each.
std::vector<Complex> with_conjugates(const std::vector<Complex>& spectrum);

/// Distance of every mode at a place of the dense output from the eigenvalue s of the spectrum that is
/// assigned to it, one to one with the least total distance, relative to max(|s|, reference). Zero for modes
/// that do not exist. Infinite for modes without an eigenvalue, if there are more modes than eigenvalues.
/// `spectrum` contains one member of each complex pair, either of them. Cost O(n^3).
///
/// Where eigenvalues of a block of several modes almost coincide, they are ill-conditioned, and the tolerance
/// of a trace refers to the functions of the block (invariants.hpp). The error of such a mode is therefore
/// multiplied by d / (0.1 max(|s|, reference)) for every other eigenvalue at a distance d for which this
/// factor is below 1. If the error exceeds d, it takes the place of d.
Vector distances_from_spectrum(const RecordedPath& path, const PathPosition& position,
                               const std::vector<Complex>& spectrum, double reference);

/// The same for values of a grid, with all modes taken as in blocks. `both_members`: they contain both
/// members of complex pairs.
Vector distances_from_spectrum(const ComplexVector& values, bool both_members,
                               const std::vector<Complex>& spectrum, double reference);

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
