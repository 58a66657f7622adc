// Which mode is which: modal assurance criterion and optimal assignment.
#pragma once

#include <vector>

#include "eigentrail/core/system_matrix.hpp"

namespace eigentrail {

/// Modal assurance criterion in physical coordinates with the mass matrix as weight,
/// |v^H M w|^2 / ((v^H M v) (w^H M w)), for every column pair: rows belong to V, columns to W. Where one
/// of the two moves no mass, the weight is the identity.
Matrix modal_assurance(const ComplexMatrix& V, const ComplexMatrix& W, const SystemMatrix& M);

/// One-to-one assignment of rows to columns with the least total cost (Kuhn 1955, in the shortest-path form
/// of Jonker & Volgenant 1987); O(n^3). `cost` is square and finite, or std::invalid_argument is thrown.
/// Returns the column of every row.
std::vector<int> optimal_assignment(const Matrix& cost);

}  // namespace eigentrail
