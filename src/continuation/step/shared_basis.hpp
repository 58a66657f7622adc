// A block at both ends of a step in one basis, so that its series can be interpolated between them.
#pragma once

#include "eigentrail/continuation/dense_output.hpp"
#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/continuation/path_step.hpp"

namespace eigentrail {

/// Coordinates of a physical series in the tangent basis of a point.
std::vector<ComplexMatrix> in_basis_of(const PathNode& node, const std::vector<ComplexMatrix>& physical);

/// Fixes the basis of a block's series by W0^H Z + W1^H Z Lambda = I.
void fix_basis(const ComplexMatrix& W, std::vector<ComplexMatrix>& Z, std::vector<ComplexMatrix>& Lambda);

/// The same for the series of a single vector: z / (w^H z).
void fix_length(const ComplexVector& w, std::vector<ComplexMatrix>& Z);

/// The functions of a track on the step between two points, with all coefficients of its series; without
/// modes.
DenseBlock block_on_step(const PathNode& left, const PathNode& right, std::size_t track);

/// The same as functions of t on the step of that length.
HermiteInterpolant functions_on_step(const PathNode& left, const PathNode& right, std::size_t track,
                                     double length);

}  // namespace eigentrail
