// Orthonormal bases by Householder reflections, compiled once: Eigen generates the products with Q anew in
// every file.
#pragma once

#include <Eigen/QR>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// The first `count` columns of Q in A = Q R or A P = Q R.
Matrix columns_of_Q(const Eigen::ColPivHouseholderQR<Matrix>& qr, Eigen::Index count);
ComplexMatrix columns_of_Q(const Eigen::HouseholderQR<ComplexMatrix>& qr, Eigen::Index count);

/// Q of A = Q R, of A P = Q R: n x n.
Matrix whole_Q(const Eigen::HouseholderQR<Matrix>& qr);
Matrix whole_Q(const Eigen::ColPivHouseholderQR<Matrix>& qr);
ComplexMatrix whole_Q(const Eigen::ColPivHouseholderQR<ComplexMatrix>& qr);

/// X with the least |A X - B|, where the columns of A are independent.
ComplexMatrix least_squares(const ComplexMatrix& A, const ComplexMatrix& B);

/// An orthonormal basis of the columns of A if these are independent: the columns of Q that are as many.
Matrix orthonormal(const Matrix& A);
ComplexMatrix orthonormal(const ComplexMatrix& A);

}  // namespace eigentrail
