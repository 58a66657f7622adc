// The comparisons that `verify` makes. Each is independent of the others.
#pragma once

#include "accuracy/verify/checked_file.hpp"
#include "accuracy/verify/fresh_solver.hpp"

namespace eigentrail {

/// Number of random values, and largest number of stored points that are solved.
std::size_t samples_of(const VerifyOptions& options, const FreshSolver& solver);

/// Eigenvalues at random values of the parameter and at stored points, and at special points, against the
/// spectrum. Changed matrices are told from a wrong file where the stored points are off as well.
Comparison compare_spectra(const CheckedFile& file, const VerifyOptions& options, FreshSolver& solver);

/// The stored equilibria and mode shapes against their equations; not of a large model.
Comparison compare_points(const CheckedFile& file, const VerifyOptions& options, const FreshSolver& solver);

/// The ends of the dense output of each mode against its stored eigenvalues, and both ends of blocks against
/// each other: a label that is exchanged at some point, or between two, is found.
Comparison compare_labels(const CheckedFile& file);

/// Columns that follow from the eigenvalues.
Comparison compare_columns(const CheckedFile& file);

/// Each special point against the spectrum and its own condition.
Comparison compare_events(const CheckedFile& file, FreshSolver& solver);

/// Changes between stored points of the number of growing eigenvalues and of real ones against the special
/// points between them, and the stable ranges against points, special points and the spectrum in their
/// middle.
Comparison compare_stability(const CheckedFile& file, const FreshSolver& solver);

/// Everything against a new trace of the stored scene. Where its arithmetic is the same as in the file, as on
/// the same machine, all numbers must be the same bit for bit; elsewhere labels, special points and ranges.
Comparison compare_new_trace(const CheckedFile& file);

}  // namespace eigentrail
