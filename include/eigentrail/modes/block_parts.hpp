// Power series of some of the eigenvalues of a block: invariant parts of Lambda(h).
//
// In the Schur form of Lambda(0), with the eigenvalues of the part first, N = U^H Lambda U = [A B; C D] with
// C(0) = 0. The columns [I; Y(h)] span the invariant subspace of the part, where
//
//     C + D Y - Y A - Y B Y = 0,
//
// and A + B Y is the matrix of the part. Every order requires one Sylvester equation of the size of the
// block. It is nonsingular as long as the part and the rest have no eigenvalue in common (Stewart & Sun 1990,
// Sect. V.2).
#pragma once

#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

struct OrderedSchur {
  ComplexMatrix T, U;  ///< Lambda = U T U^H, T upper triangular
};

/// Schur form in which the eigenvalues of `Lambda` nearest to `leading` come first on the diagonal, in the
/// order of `leading` (Golub & Van Loan 2013, Sect. 7.6.2).
OrderedSchur ordered_schur(const ComplexMatrix& Lambda, const std::vector<Complex>& leading);

/// Coefficients of the matrix series of a part of `Lambda` (k x k coefficients): the part has the eigenvalues
/// `part` at h = 0. Returns an empty vector if they cannot be separated from the other eigenvalues (distance
/// at most 1e-13 |Lambda|). Accurate as long as the part as a whole is well separated from the rest, even if
/// its own eigenvalues meet.
std::vector<ComplexMatrix> part_series(const std::vector<ComplexMatrix>& Lambda,
                                       const std::vector<Complex>& part);

/// Series of the mean of the eigenvalues of a part.
ComplexVector mean_series(const std::vector<ComplexMatrix>& Lambda);

/// Series of the product of the two eigenvalues of a block, its determinant. Empty if Lambda is.
ComplexVector product_series(const std::vector<ComplexMatrix>& Lambda);

/// Series of ((s_a - s_b) / 2)^2 for a part whose eigenvalues are s_a, `count` times, and s_b otherwise. With
/// two eigenvalues and count = 1 this is delta of invariants.hpp. Smooth where s_a and s_b meet.
ComplexVector discriminant_series(const std::vector<ComplexMatrix>& Lambda, Eigen::Index count);

/// The same from the series of s_a and s_b.
ComplexVector discriminant_series(const ComplexVector& a, const ComplexVector& b);

/// Series of the eigenvalue `root` of a block, from the series of the functions of the block
/// (invariants.hpp). Empty if the root is not simple (relative distance at most 1e-13).
ComplexVector root_series(const ComplexMatrix& functions, Complex root);

}  // namespace eigentrail
