// Some eigenvalues of a block by themselves: power series of a part of Lambda(h).
//
// In the Schur form of Lambda(0) with the part first, N = U^H Lambda U = [A B; C D] with C(0) = 0, the
// columns [I; Y(h)] span the part's invariant subspace where
//
//     C + D Y - Y A - Y B Y = 0,
//
// and A + B Y is the part of Lambda. Order by order this is one Sylvester equation of the size of the block,
// regular while the part has no eigenvalue in common with the rest (Stewart & Sun 1990, Sect. V.2).
#pragma once

#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// Coefficients of the part of `Lambda` (k x k each) with the eigenvalues `part` at h = 0; empty when they
/// cannot be told from the others. Accurate as long as the part as a whole keeps its distance from the rest,
/// also where its own eigenvalues meet.
std::vector<ComplexMatrix> part_series(const std::vector<ComplexMatrix>& Lambda,
                                       const std::vector<Complex>& part);

/// Mean of the eigenvalues of a part.
ComplexVector mean_series(const std::vector<ComplexMatrix>& Lambda);

/// ((s_a - s_b) / 2)^2 of a part that consists of two eigenvalues s_a and s_b, `count` times the one and the
/// other for the rest: delta when there are two. Smooth where they meet.
ComplexVector discriminant_series(const std::vector<ComplexMatrix>& Lambda, Eigen::Index count);

/// The same from the series of both.
ComplexVector discriminant_series(const ComplexVector& a, const ComplexVector& b);

/// Coefficients of the eigenvalue `root` of a block from those of its functions (invariants.hpp). Empty when
/// the root is not simple.
ComplexVector root_series(const ComplexMatrix& functions, Complex root);

}  // namespace eigentrail
