// Assigns modes at one point to modes at another: length and phase of their shapes, modal assurance criterion
// and optimal assignment.
#pragma once

#include <vector>

#include "eigentrail/core/system_matrix.hpp"

namespace eigentrail {

/// v^H M v, or zero if it is at the rounding level, that is, if the shape moves no mass.
double mass_norm_squared(const ComplexVector& v, const SystemMatrix& M);

/// v scaled to v^H M v = 1 (to v^H v = 1 if the mode moves no mass), with the phase that makes reference^H M
/// v real and positive, so that shapes change smoothly along the path. If the reference is empty or
/// orthogonal to v, the component of largest magnitude is made real and positive.
ComplexVector normalize_shape(const ComplexVector& v, const SystemMatrix& M, const ComplexVector& reference);

/// Modal assurance criterion in physical coordinates, weighted by the mass matrix: |v^H M w|^2 / ((v^H M v)
/// (w^H M w)) for all pairs of a column v of V (rows of the result) and a column w of W (columns). If v or w
/// moves no mass, the identity replaces M.
Matrix modal_assurance(const ComplexMatrix& V, const ComplexMatrix& W, const SystemMatrix& M);

/// One-to-one assignment of rows to columns with the least total cost (Kuhn 1955, in the shortest-path form
/// of Jonker & Volgenant 1987). Returns the column of every row. Cost O(rows^2 columns). Throws
/// std::invalid_argument unless `cost` is finite and has at least as many columns as rows, or if differences
/// of costs overflow.
std::vector<int> optimal_assignment(const Matrix& cost);

}  // namespace eigentrail
