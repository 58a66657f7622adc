// Series of a block at both ends of a step in a common basis, so that they can be interpolated.
#pragma once

#include "eigentrail/continuation/dense_output.hpp"
#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/continuation/path_step.hpp"

namespace eigentrail {

/// T^T V: coordinates of the series V, in physical coordinates, in the tangent basis T of a point; those of
/// one part where the equations fall apart.
std::vector<ComplexMatrix> in_basis_of(const PathNode& node, const std::vector<ComplexMatrix>& physical,
                                       int part = 0);

/// Transforms the series of a block to the basis with W0^H Z + W1^H Z Lambda = I. W = [W0; W1] is 2n x k.
void fix_basis(const ComplexMatrix& W, std::vector<ComplexMatrix>& Z, std::vector<ComplexMatrix>& Lambda);

/// The same for the series of a single vector: z / (w^H z).
void fix_length(const ComplexVector& w, std::vector<ComplexMatrix>& Z);

/// The functions of a track on the step between two points, with all coefficients of its series; the list of
/// modes is empty.
DenseBlock block_on_step(const PathNode& left, const PathNode& right, std::size_t track);

/// The same as an interpolant on the step of that signed length.
HermiteInterpolant functions_on_step(const PathNode& left, const PathNode& right, std::size_t track,
                                     double length);

}  // namespace eigentrail
