// Bounds of the errors of the eigenvalues of the dense output.
#pragma once

#include "eigentrail/continuation/path_step.hpp"
#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// An eigenvalue as it is shown: zero where it is, or its real part is, within its error by rounding, 1/s.
Complex shown(Complex s, double rounding);

/// Bounds of the errors (1/s) of the eigenvalues of a block of two and more at t in [0, 1] of a step of
/// signed length `length`, in the order of the block's modes. They follow from the estimated errors of its
/// functions, no larger than what a trace promises, and from their rounding: equal eigenvalues that are not
/// defective are as accurate as single ones, those beside an exceptional point are not. `s`: eigenvalues of
/// all modes at t. `at_node`: t is a stored point, where only rounding counts. `tolerance`, `reference`: of
/// the trace.
Vector block_errors(const DenseBlock& block, double length, double t, const ComplexVector& s, bool at_node,
                    double tolerance, double reference);

}  // namespace eigentrail
