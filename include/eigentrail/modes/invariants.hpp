// Smooth functions of the eigenvalues of a block. They are interpolated between points and stored.
//
//   one mode        s
//   two             tau = (s1 + s2)/2 and delta = ((s1 - s2)/2)^2, so that s = tau +- sqrt(delta)
//   three and more  the k^2 entries of Lambda, column by column, in a basis that both ends of a step share
//
// They stay smooth where eigenvalues of the block coalesce. tau and delta do not depend on the basis. For
// larger blocks the matrix is used and not its characteristic polynomial: if some eigenvalues coincide
// without being defective, the polynomial loses half of their digits and the matrix loses none.
#pragma once

#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// Number of eigenvalues of a block with this number of functions.
Eigen::Index block_size(Eigen::Index functions);

/// Power series of the functions of a block, one row per function, from the series of Lambda.
ComplexMatrix block_functions(const std::vector<ComplexMatrix>& Lambda);

/// Eigenvalues from the values of the functions, in no particular order. If all functions are real, the
/// eigenvalues are exactly real or exactly conjugate.
ComplexVector block_roots(const ComplexVector& functions);

/// Rounding error of the functions that rounding of Lambda causes; an error estimate below it is meaningless.
/// If a block is defective, the error of delta determines the accuracy: the eigenvalues are known only to its
/// square root.
Vector function_rounding(const ComplexMatrix& Lambda);
/// The same for an error of Lambda of this size (Frobenius norm).
Vector function_rounding(const ComplexMatrix& Lambda, double error);

/// Estimate of the largest error of an eigenvalue for given errors of the functions, 1/s. Near a meeting of
/// eigenvalues a distance smaller than `least_gap` is replaced by `least_gap`.
double root_error(const ComplexVector& functions, const Vector& errors, double least_gap);

/// Bounds of the errors of the eigenvalues of a block for given errors of its functions, 1/s, in the order of
/// `roots`, the eigenvalues that these functions have. Valid also where eigenvalues coincide: those of a
/// defective block are known to a root of the errors only, those of a semisimple one as well as single ones
/// (first order where it holds; Henrici, Numer. Math. 4, 1962, where it does not).
Vector root_errors(const ComplexVector& functions, const ComplexVector& roots, const Vector& errors);

/// Whether any two eigenvalues of a block differ by more than their errors, for given errors of its functions
/// (root_errors).
bool are_told_apart(const ComplexVector& functions, const ComplexVector& roots, const Vector& errors);

/// Distances (1/s) below which the eigenvalues of a block cannot be distinguished, in the order of `roots`:
/// two of them below the lesser one. Nonzero only for those of blocks of three and more that rounding does
/// not separate from another one, for example several rigid-body modes or an exceptional point. A matrix of
/// size k that is far from normal determines its eigenvalues only to the k-th root of its rounding error
/// (Henrici, Numer. Math. 4, 1962); up to six are taken to meet two at a time, with the square root.
Vector root_resolutions(const ComplexVector& functions, const ComplexVector& roots);

/// The values `to` in the order of `from`: the assignment with the least total distance.
ComplexVector in_order_of(const ComplexVector& from, const ComplexVector& to);

/// Smallest distance between two of the values; infinite for a single value.
double least_gap(const ComplexVector& roots);

/// Coefficients of 1 / series; the leading coefficient must not be zero.
ComplexVector reciprocal_series(const ComplexVector& series);

/// Coefficients of the product of two series of equal length, truncated to it.
ComplexVector multiply_series(const ComplexVector& a, const ComplexVector& b);

}  // namespace eigentrail
