// Smooth functions of a block: what is interpolated between points and stored.
//
//   one mode        s
//   two             tau = (s1 + s2)/2 and delta = ((s1 - s2)/2)^2, so that s = tau +- sqrt(delta)
//   three and more  the k^2 entries of Lambda, column by column, in a basis that both ends of a step share
//
// They stay smooth where the eigenvalues meet. tau and delta do not depend on a basis. For larger blocks the
// matrix is kept instead of its characteristic polynomial: where some of its eigenvalues coincide without
// being defective, the polynomial would lose half of their digits and the matrix loses none.
#pragma once

#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// Number of eigenvalues of a block with this many functions.
Eigen::Index block_size(Eigen::Index functions);

/// Functions of a block as series, one row each, from the series of Lambda.
ComplexMatrix block_functions(const std::vector<ComplexMatrix>& Lambda);

/// Eigenvalues from the values of the functions, in no particular order; exactly real or conjugate where all
/// functions are real.
ComplexVector block_roots(const ComplexVector& functions);

/// How far rounding of Lambda moves the functions: an error estimate below it means nothing. Where a block is
/// defective that of delta counts, and the eigenvalues are known to the root of it only.
Vector function_rounding(const ComplexMatrix& Lambda);

/// How far errors of the functions move the eigenvalues, each at most; near a meeting the distance of the
/// roots counts as no less than `least_gap`.
double root_error(const ComplexVector& functions, const Vector& errors, double least_gap);

/// Distance within which no two eigenvalues of a block can be told apart, 1/s: above zero for blocks of three
/// and more all of whose `roots` coincide within rounding, as those of several rigid-body modes do. Their
/// matrix is far from normal, and its eigenvalues are known to the root of its rounding only.
double root_resolution(const ComplexVector& functions, const ComplexVector& roots);

/// Roots of `to` in the order of `from`: the assignment with the least total distance.
ComplexVector in_order_of(const ComplexVector& from, const ComplexVector& to);

/// Smallest distance between two of the values; infinite when there is one.
double least_gap(const ComplexVector& roots);

/// Coefficients of 1 / series; the leading coefficient must not vanish.
ComplexVector reciprocal_series(const ComplexVector& series);

/// Coefficients of the product of two series of one length.
ComplexVector multiply_series(const ComplexVector& a, const ComplexVector& b);

}  // namespace eigentrail
