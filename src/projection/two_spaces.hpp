// A smaller projection of a pencil P that is not symmetric: on a space V of its right vectors and a space W
// of its left ones (Petrov-Galerkin), W^T P V, in place of Q^T P Q with the sum of both as Q. The error of an
// eigenvalue is that of its right vector in V times that of its left one in W.
//
// W^T P V is as far from singular as the angles between the spaces are from right angles. In the norm of an
// energy E, let v_i and w_i be their principal vectors (Bjorck and Golub, Numerical methods for computing
// angles between linear subspaces, 1973), with v_i^T E w_j = cos(a_i) for i = j, else 0. Where cos(a_i) is
// small each space gets the vector of the other one: there the projection is one onto the sum of both.
#pragma once

#include "projection/projection_space.hpp"

namespace eigentrail {

/// Orthonormal bases in the basis of a space that has both, k x r.
struct TwoSpaces {
  Matrix right, left;
};

/// Spaces that the right and the left vectors of `both` need up to a relative error `accuracy` in the norm of
/// the symmetric part of `energy` (k x k), equally large.
TwoSpaces two_spaces(const ProjectionSpace& both, const Matrix& energy, double accuracy);

}  // namespace eigentrail
