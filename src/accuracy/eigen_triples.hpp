// All eigenvalues of a model at one value of the parameter, with right and left eigenvectors.
#pragma once

#include <vector>

#include "eigentrail/model/sample_errors.hpp"

namespace eigentrail {

/// The finite eigenvalues of s^2 M + s C + K, both members of complex pairs, by LAPACK's QZ algorithm on the
/// companion form, or on s C + K if M is zero. Eigenvectors of equal eigenvalues are made biorthogonal, and
/// all are scaled to y^H P'(s) z = 1. Empty
/// if the algorithm does not converge. Cost: about 100 m^3, m = 2n or n.
std::vector<EigenTriple> eigen_triples(const Matrix& M, const Matrix& C, const Matrix& K);

}  // namespace eigentrail
