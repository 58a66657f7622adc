// Complex parts: one of a conjugate pair that no real coordinates separate, forward and backward whirl of an
// isotropic shaft.
//
// In canonical coordinates the matrices of such a pair, 2m x 2m, are
//
//     [A  -B]                            [ v ]            [ (A + iB) v ]
//     [B   A]     and therefore map      [-iv]     to     [-i(A + iB) v],
//
// so that vectors of this form are a complex part with the matrices A + iB, m x m (sign +1). Vectors
// [v; iv] are its conjugate, with A - iB (sign -1). If the two halves of the coordinates are
// displacements in x and y, the first is forward whirl for Im s > 0 and the second backward whirl.
//
// The pair stays real in matrices, series and vectors. What is solved is restricted to the m dimensions of
// one of the two: the other may have the same eigenvalues, and would make the equations singular.
#pragma once

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// The m complex coordinates q of vectors [q; -iq] / sqrt(2) (sign +1) or [q; iq] / sqrt(2) (-1). Parts of
/// the other sign are dropped. Z: 2m x k. The map back is its adjoint and keeps lengths.
ComplexMatrix complex_coordinates(const ComplexMatrix& Z, int complex_sign);
ComplexMatrix from_complex_coordinates(const ComplexMatrix& q, int complex_sign);

/// A + iB (sign +1) or A - iB (-1) of a real matrix [A -B; B A], or of a complex combination of such.
ComplexMatrix complex_block(const Matrix& canonical, int complex_sign);
ComplexMatrix complex_block(const ComplexMatrix& canonical, int complex_sign);

/// The nearest matrix of the form [A -B; B A]; 2m x 2m.
Matrix canonical_form(const Matrix& matrix);

}  // namespace eigentrail
