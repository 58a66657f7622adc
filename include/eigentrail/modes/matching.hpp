// Assigns modes at one point to modes at another: modal assurance criterion and optimal assignment.
#pragma once

#include <vector>

#include "eigentrail/core/system_matrix.hpp"

namespace eigentrail {

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
