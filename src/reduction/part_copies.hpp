// Equal parts: of every class of them one stays, the others become its copies (see independent_parts.hpp).
#pragma once

#include <vector>

#include "eigentrail/reduction/independent_parts.hpp"

namespace eigentrail {

/// Sets `like` for parts with the same eigenvalues, and makes parts that are equal up to a change of
/// coordinates copies of the first of them. Freedoms that no force holds stay parts of their own. The
/// matrices are n x n, of about equal norms in balanced coordinates. `magnified`: rounding in units of their
/// own, >= 1.
void settle_copies(const std::vector<Matrix>& all, double magnified, IndependentParts& parts);

/// How far a matrix is from falling apart as the parts do, in units of the terms that the differences are
/// sums of: coupling between parts, and differences between a part and its copies. Cost O(n^3).
double departure_from_parts(const Matrix& A, const IndependentParts& parts);

}  // namespace eigentrail
